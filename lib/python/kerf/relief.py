# SPDX-License-Identifier: GPL-2.0-or-later
"""Cuts a grey picture as a relief: light is high (Z0), dark is deep.

Heights are one number a pixel. The tool may stand as low as nothing of its shape enters the surface (the tool
map); passes follow rows or columns of that map.
"""
import math
from dataclasses import dataclass

import numpy

from rs274.author import Gcode

from .language import _, N_

UNITS = ("G20", "G21")
BORDERS = (N_("None"), N_("White"), N_("Black"))
PATTERNS = (N_("Rows"), N_("Columns"), N_("Rows then Columns"), N_("Columns then Rows"))
CONVERTERS = (N_("Positive"), N_("Negative"), N_("Alternating"), N_("Up Milling"), N_("Down Milling"))
TOOLS = (N_("Ball End"), N_("Flat End"), N_("30 Degree"), N_("45 Degree"), N_("60 Degree"))
BOUNDED = (N_("None"), N_("Secondary"), N_("Full"))
MAX_TOOL_PIXELS = 400
OUTSIDE = -1e30  # height of what is beside the picture: in nobody's way


class Mistake(ValueError):
    """A setting that makes no sense; the text names it."""


@dataclass
class Settings:
    """Lengths in the units, feeds in units/min, angles in degrees; choices by their place in the lists above."""
    units: int = 0
    invert: bool = False
    normalize: bool = False
    expand: int = 0
    tolerance: float = 0.001
    pixel_size: float = 0.006
    feed_rate: float = 12.0
    plunge_feed_rate: float = 12.0
    spindle_speed: float = 1000.0
    pattern: int = 0
    converter: int = 0
    depth: float = 0.25
    pixelstep: int = 8
    tool_diameter: float = 0.0625
    safety_height: float = 0.012
    tool_type: int = 0
    bounded: int = 0
    contact_angle: float = 45.0
    roughing_offset: float = 0.0
    roughing_depth: float = 0.25

    def check(self):
        for name in ("tolerance", "pixel_size", "feed_rate", "plunge_feed_rate", "depth", "tool_diameter",
                     "safety_height"):
            if not (0 < getattr(self, name) < 1e6):
                raise Mistake(_("%s must be more than 0, not %s") % (name, getattr(self, name)))
        for name in ("spindle_speed", "roughing_offset", "roughing_depth"):
            if not (0 <= getattr(self, name) < 1e6):
                raise Mistake(_("%s must not be negative") % name)
        if self.pixelstep < 1:
            raise Mistake(_("%s must be 1 or more, not %s") % ("pixelstep", self.pixelstep))
        if not 0 < self.contact_angle < 90:
            raise Mistake(_("%s must be between 0 and 90, not %s") % ("contact_angle", self.contact_angle))
        for name, choices in CHOICES.items():
            if not 0 <= getattr(self, name) < len(choices):
                raise Mistake(_("%s must be one of %s") % (name, ", ".join(choices)))
        if self.tool_pixels() > MAX_TOOL_PIXELS:
            raise Mistake(_("the tool covers %.0f pixels; at most %d: is pixel_size right?")
                          % (self.tool_pixels(), MAX_TOOL_PIXELS))

    def tool_pixels(self):
        return self.tool_diameter / self.pixel_size


CHOICES = {"units": UNITS, "expand": BORDERS, "pattern": PATTERNS, "converter": CONVERTERS, "tool_type": TOOLS,
           "bounded": BOUNDED}


def heights(grey, settings):
    """Heights (0 to -depth) of a picture with values from 0 to 1, with its border."""
    v = 1 - grey if settings.invert else grey
    if settings.normalize and v.max() > v.min():
        v = (v - v.min()) / (v.max() - v.min())
    if settings.expand:
        v = numpy.pad(v, math.ceil(settings.tool_pixels()),
                      constant_values=1.0 if BORDERS[settings.expand] == "White" else 0.0)
    return (v - 1) * settings.depth


def disc(radius_px):
    """(dy, dx, distance) of the pixels within a radius."""
    reach = int(radius_px)
    return [(dy, dx, math.hypot(dx, dy)) for dy in range(-reach, reach + 1)
            for dx in range(-reach, reach + 1) if math.hypot(dx, dy) <= radius_px]


def tool_shape(settings):
    """(dy, dx, height of the cutting edge above the tip) for each pixel that the tool covers."""
    kind, size = TOOLS[settings.tool_type], settings.pixel_size
    radius = settings.tool_diameter / 2
    if kind == "Ball End":
        edge = lambda d: radius - math.sqrt(max(0.0, radius * radius - d * d))
    elif kind == "Flat End":
        edge = lambda d: 0.0
    else:  # the angle between the two sides of the cone
        slope = 1 / math.tan(math.radians(float(kind.split()[0]) / 2))
        edge = lambda d: d * slope
    return [(dy, dx, edge(d * size)) for dy, dx, d in disc(radius / size)]


def ball(radius, size):
    """A ball below each point, for a surface at a distance from another one."""
    return [(dy, dx, -math.sqrt(max(0.0, radius * radius - (d * size) ** 2))) for dy, dx, d in disc(radius / size)]


def lowest(surface, shape, progress=lambda part: None):
    """How low the tip may stand over each pixel."""
    reach = max(max(abs(dy), abs(dx)) for dy, dx, _ in shape)
    padded = numpy.pad(surface, reach, constant_values=OUTSIDE)
    rows, columns = surface.shape
    result = numpy.full(surface.shape, OUTSIDE)
    for n, (dy, dx, edge) in enumerate(shape):
        part = padded[reach + dy:reach + dy + rows, reach + dx:reach + dx + columns]
        numpy.maximum(result, part - edge, out=result)
        progress((n + 1) / len(shape))
    return result


def runs(keep):
    """(first, last) of the stretches of True with at least two points, or of a lone one."""
    found, begin = [], None
    for n, good in enumerate(keep):
        if good and begin is None:
            begin = n
        if begin is not None and (not good or n == len(keep) - 1):
            found.append((begin, n if good else n - 1))
            begin = None
    return found


def monotonic(z):
    """(first, last, rises) of the stretches along which z only rises or only falls."""
    found, begin, direction = [], 0, 0
    for n in range(1, len(z)):
        step = (z[n] > z[n - 1]) - (z[n] < z[n - 1])
        if step and direction and step != direction:
            found.append((begin, n - 1, direction > 0))
            begin, direction = n - 1, step
        direction = direction or step
    found.append((begin, len(z) - 1, direction >= 0))
    return found


class Cutter:
    """Writes the passes over one tool map."""

    def __init__(self, writer, settings, tool_map, keep):
        self.g, self.settings, self.map, self.keep = writer, settings, tool_map, keep
        self.plunged, self.at = False, None

    def place(self, row, column):
        size = self.settings.pixel_size
        return column * size, (self.map.shape[0] - 1 - row) * size, float(self.map[row, column])

    def cut(self, points):
        """A run of (row, column); comes down at its first point unless it stands there."""
        if self.at != points[0]:
            self.lift()
            x, y, z = self.place(*points[0])
            self.g.rapid(x, y)
            self.g.set_feed(self.settings.plunge_feed_rate)
            self.g.cut(z=z)
            self.g.set_feed(self.settings.feed_rate)
        for point in points[1:]:
            self.g.cut(*self.place(*point))
        self.at = points[-1]

    def lift(self):
        if self.at is not None:
            self.g.safety()
            self.at = None

    def one_pass(self, line, forward):
        """Along a row or column, given as its points."""
        keep = [bool(self.keep[point]) for point in line]
        kind = CONVERTERS[self.settings.converter]
        pieces = runs(keep)
        if not forward:
            pieces.reverse()
        for first, last in pieces:
            stretch = line[first:last + 1]
            if kind in ("Up Milling", "Down Milling"):
                for begin, end, rises in monotonic([float(self.map[point]) for point in stretch]):
                    part = stretch[begin:end + 1]
                    self.cut(part if rises == (kind == "Up Milling") else part[::-1])
            else:
                self.cut(stretch if forward else stretch[::-1])

    def passes(self, by_rows, progress):
        rows, columns = self.map.shape
        count, length = (rows, columns) if by_rows else (columns, rows)
        point = (lambda line, n: (line, n)) if by_rows else (lambda line, n: (rows - 1 - n, line))
        step = self.settings.pixelstep
        lines = list(range(0, count, step))
        if lines[-1] != count - 1:
            lines.append(count - 1)
        if by_rows:
            lines.reverse()  # from the bottom of the picture
        kind = CONVERTERS[self.settings.converter]
        forward = kind != "Negative"
        before = None
        for n, line in enumerate(lines):
            if kind == "Alternating" and before is not None and self.at is not None:
                # over to the next line on the surface of the tool map
                sign = 1 if line > before else -1
                end = self.at[1] if by_rows else rows - 1 - self.at[0]
                way = [point(between, end) for between in range(before, line + sign, sign)]
                if all(self.keep[p] for p in way):
                    self.cut(way)
            self.one_pass([point(line, k) for k in range(length)], forward)
            if kind == "Alternating":
                forward = not forward
            before = line
            progress((n + 1) / len(lines))
        self.lift()


def steep(tool_map, settings, by_rows):
    """Where the surface slopes strongly along the rows (or columns)."""
    slope = (numpy.abs(numpy.gradient(tool_map, settings.pixel_size, axis=1 if by_rows else 0))
             if min(tool_map.shape) > 1 else numpy.zeros(tool_map.shape))
    strong = slope > math.tan(math.radians(settings.contact_angle))
    return lowest(strong.astype(float), [(dy, dx, 0.0) for dy, dx, _ in disc(max(1.0, settings.pixelstep))]) > 0.5


def directions(settings, tool_map):
    """(by rows, which points) of each direction in turn."""
    everything = numpy.ones(tool_map.shape, bool)
    name = PATTERNS[settings.pattern]
    if name in ("Rows", "Columns"):
        return [(name == "Rows", everything)]
    first = name.startswith("Rows")
    strong = steep(tool_map, settings, not first)
    bounded = BOUNDED[settings.bounded]
    return [(first, ~strong if bounded == "Full" else everything),
            (not first, strong if bounded != "None" else everything)]


def convert(grey, settings, target, progress=lambda percent: None):
    """Gives the program's lines to target. grey: 2-D array from 0 (dark) to 1 (light). Raises Mistake."""
    settings.check()
    surface = heights(numpy.asarray(grey, float), settings)
    shape = tool_shape(settings)
    finish = lowest(surface, shape, lambda part: progress(part * 30))
    levels = []
    if settings.roughing_depth > 0 and settings.roughing_offset > 0:
        over = lowest(surface, ball(settings.roughing_offset, settings.pixel_size))
        rough = lowest(over, shape, lambda part: progress(30 + part * 20))
        level = -settings.roughing_depth
        while level > rough.min() and settings.roughing_depth * (len(levels) + 1) < settings.depth:
            levels.append(numpy.maximum(rough, level))
            level -= settings.roughing_depth
        levels.append(rough)
    levels.append(finish)
    writer = Gcode(safetyheight=settings.safety_height, tolerance=settings.tolerance,
                   units=UNITS[settings.units], target=target, spindle_speed=settings.spindle_speed)
    writer.begin()
    writer.continuous(settings.tolerance)
    for n, tool_map in enumerate(levels):
        for by_rows, keep in directions(settings, tool_map):
            writer.set_plane(18 if by_rows else 19)
            Cutter(writer, settings, tool_map, keep).passes(by_rows,
                                                            lambda part: progress(50 + 50 * (n + part) / len(levels)))
    writer.set_plane(17)
    writer.flush()
    writer.safety()
    if settings.spindle_speed > 0:
        writer.write("M5")
    writer.write("M2")
    progress(100)
