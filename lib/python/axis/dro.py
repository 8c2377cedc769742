# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts of the position display; no widgets here. Formats: GUI reference, section 8.4."""

import math

from kerf.position import relative

from .settings import LETTERS, MM_PER_INCH

SYSTEMS = ("G53", "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")


def checked_format(text, default, say=print):
    """A printf format that takes one number, else the default."""
    if text is None:
        return default
    try:
        text % 1.0
    except (TypeError, ValueError):
        say(f"axis: '{text}' is no format for a number; {default} is used")
        return default
    return text


class Readout:
    """Lines of the display. Positions of the status are machine units."""

    def __init__(self, settings):
        self.s = settings
        inch = settings.find("DISPLAY", "DRO_FORMAT_IN")
        self.mm = checked_format(settings.find("DISPLAY", "DRO_FORMAT_MM"), "% 9.3f")
        self.inch = checked_format(inch, "% 9.4f")
        self.wrapped = {c for c in "ABC" if settings.flag(f"AXIS_{c}", "WRAPPED_ROTARY")}

    def shown(self, values, metric):
        """Nine values in the units shown: lengths in mm or inch, angles in degrees."""
        scale = (1.0 if metric else 1 / MM_PER_INCH) / self.s.units_per_mm
        return [v if c in "ABC" else v * scale for c, v in zip(LETTERS, values)]

    def position(self, stat, view):
        """Nine values as they are shown: view has relative, commanded, metric."""
        position = stat.position if view.commanded else stat.actual_position
        p = relative(stat, position) if view.relative else list(position)
        for c in self.wrapped:
            i = LETTERS.index(c)
            p[i] = math.fmod(p[i], 360.0)
        return self.shown(p, view.metric)

    def lines(self, stat, view):
        """Lines of the display, the short or (view.offsets) the long list."""
        if view.joints:
            p = stat.joint_position if view.commanded else stat.joint_actual_position
            return [f"  {j}:" + "% 9.4f" % p[j] for j in range(self.s.joints)]
        fmt = self.mm if view.metric else self.inch
        p = self.position(stat, view)
        dtg = self.shown(stat.dtg, view.metric)
        out = []
        if view.offsets:
            self.long_lines(out, stat, view, p, dtg, fmt)
        else:
            for c in self.s.axes:
                v = p[LETTERS.index(c)]
                if self.s.lathe and c == "X":
                    out += ["% 6s:" % "Rad" + fmt % v, "% 6s:" % "Dia" + fmt % (2 * v)]
                else:
                    out.append("% 6s:" % c + fmt % v)
        if view.speed:
            scale = (1.0 if view.metric else 1 / MM_PER_INCH) / self.s.units_per_mm
            out.append("% 6s:" % "Vel" + fmt % (stat.current_vel * 60 * scale))
        if view.distance_to_go and not view.offsets:
            scale = (1.0 if view.metric else 1 / MM_PER_INCH) / self.s.units_per_mm
            out.append("% 6s:" % "DTG" + fmt % (stat.distance_to_go * scale))
        if view.extra_joints and not view.offsets:
            out.append("Extra Joints:")
            first = self.s.joints - view.extra_joints
            out += [f"   EJ{j}:" + "% 9.4f" % stat.joint_actual_position[j] for j in range(first, self.s.joints)]
        return out

    def long_lines(self, out, stat, view, p, dtg, fmt):
        label = SYSTEMS[stat.g5x_index] if 0 <= stat.g5x_index < len(SYSTEMS) else "G5x"
        g5x, g92 = self.shown(stat.g5x_offset, view.metric), self.shown(stat.g92_offset, view.metric)
        tlo = self.shown(stat.tool_offset, view.metric)
        for c in self.s.axes:
            i = LETTERS.index(c)
            if self.s.lathe and c == "X":
                out.append(" % 6s:" % "Rad" + fmt % p[i] + "  DTG R:" + fmt % dtg[i])
                out.append(" % 6s:" % "Dia" + fmt % (2 * p[i]))
            else:
                out.append(" % 6s:" % c + fmt % p[i] + f"  DTG {c}:" + fmt % dtg[i])
        out.append("")
        for c in self.s.axes:
            i = LETTERS.index(c)
            out.append("% 5s %s:" % (label, c) + fmt % g5x[i] + f"  G92 {c}:" + fmt % g92[i])
        out.append("% 5s %s:" % (label, "R") + fmt % stat.rotation_xy)
        out.append("")
        out += ["% 5s %s:" % ("TLO", c) + fmt % tlo[LETTERS.index(c)] for c in self.s.axes]


def tool_text(stat, lathe, translate):
    """The tool cell of the status bar."""
    number = stat.tool_in_spindle
    if number in (0, -1):
        return translate("No tool")
    entry = stat.tool_table[0]
    if entry.id != number:
        entry = next((t for t in stat.tool_table if t.id == number), None)
    if entry is None:
        return translate("Unknown tool %d") % number
    if entry.xoffset == 0 and not lathe:
        return translate("Tool %d, offset %g, diameter %g") % (number, entry.zoffset, entry.diameter)
    return translate("Tool %d, zo %g, xo %g, dia %g") % (number, entry.zoffset, entry.xoffset, entry.diameter)


def active_codes(stat):
    """G and M codes, feed and speed in force, joined by blanks."""
    def g(code):
        return f"G{code // 10}.{code % 10}" if code % 10 else f"G{code // 10}"
    words = [g(c) for c in stat.gcodes[1:] if c != -1]
    words += [f"M{m}" for m in stat.mcodes[1:] if m != -1]
    feed = f"F{stat.settings[1]:.1f}"
    words += [feed[:-2] if feed.endswith(".0") else feed, f"S{stat.settings[2]:.0f}"]
    return " ".join(words)
