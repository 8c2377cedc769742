# SPDX-License-Identifier: GPL-2.0-or-later
"""What a machine takes where nobody wrote it down: spindles that run up, tool changes, programs of M1xx codes.

Measured while the machine is used, remembered by machine (preference "waits"), given to the estimate of the run time.
"""
import os

import linuxcnc

KINDS = ("tool", "spindle", "user")      # s, s/rpm, s
KEPT_PART = 0.5                          # of what was known, when a new measurement comes
CHANGE_WORTH_KEEPING = 0.02              # of the value


class Waits:
    """values: kind -> s (spindle: s/rpm) of one machine, those that were measured. pin(name): a HAL value, or None."""

    def __init__(self, prefs, machine, pin):
        self.prefs, self.machine, self.pin = prefs, os.path.realpath(machine), pin
        known = prefs.getpref("waits", {}, repr)
        known = known.get(self.machine) if isinstance(known, dict) else None
        self.values = ({k: float(v) for k, v in known.items() if k in KINDS and isinstance(v, (int, float)) and v >= 0}
                       if isinstance(known, dict) else {})
        self.began = dict.fromkeys(KINDS)    # when a wait began that is under way
        self.speed, self.change = None, 0.0

    def words(self):
        """Options of kerf-time."""
        return ["-t", f"{self.values.get('tool', 0):.6f}", "-a", f"{self.values.get('spindle', 0):.9f}", "-u",
                f"{self.values.get('user', 0):.6f}"]

    def learn(self, kind, value):
        old = self.values.get(kind)
        new = value if old is None else KEPT_PART * old + (1 - KEPT_PART) * value
        if old is not None and abs(new - old) <= CHANGE_WORTH_KEEPING * old:
            return
        self.values[kind] = new
        known = self.prefs.getpref("waits", {}, repr)
        self.prefs.putpref("waits", (known if isinstance(known, dict) else {}) | {self.machine: self.values}, repr)

    def watch(self, now, stat):
        """Once in a cycle; now: the machine's clock, s."""
        if stat.task_state != linuxcnc.STATE_ON:
            self.began, self.speed = dict.fromkeys(KINDS), None
            return
        self.span("tool", now, self.pin("iocontrol.0.tool-change"))
        self.span("user", now, stat.exec_state == linuxcnc.EXEC_WAITING_FOR_SYSTEM_CMD)
        if 960 in stat.gcodes:  # G96: the speed follows the radius, which tells nothing of a run-up
            self.began["spindle"] = self.speed = None
        else:
            self.run_up(now, abs(stat.spindle[0]["speed"]), self.pin("spindle.0.at-speed"))

    def span(self, kind, now, waits):
        began = self.began[kind]
        if waits and began is None:
            self.began[kind] = now
        elif not waits and began is not None:
            self.began[kind] = None
            self.learn(kind, now - began)

    def run_up(self, now, speed, at_speed):
        """From a steady speed to a higher one; a change that is overtaken by another tells nothing."""
        if at_speed is None:
            return
        if self.speed is not None and speed > 1.01 * self.speed and self.began["spindle"] is None:
            self.began["spindle"], self.change = now, speed - self.speed
        elif self.speed is not None and speed != self.speed:
            self.began["spindle"], self.change = now, 0.0
        self.speed = speed
        if at_speed and self.began["spindle"] is not None:
            if self.change > 0:
                self.learn("spindle", (now - self.began["spindle"]) / self.change)
            self.began["spindle"] = None


def rows(counted, values, translate=str):
    """(name, value) lines for the properties: what the run time holds of waits, and what it does not. counted:
    Times.waits."""
    if not counted:
        return []
    tools, starts, users, inputs, stops = counted
    seconds = translate("%.1f s each")
    unknown = translate("not measured yet, not counted")
    out = []
    if tools:
        out.append((translate("Tool changes"),
                    f"{tools}, " + (seconds % values["tool"] if "tool" in values else unknown)))
    if starts:
        known = translate("%.1f s for 1000 rpm") % (1000 * values["spindle"]) if "spindle" in values else unknown
        out.append((translate("Spindle starts"), f"{starts}, {known}"))
    if users:
        out.append((translate("User M codes"),
                    f"{users}, " + (seconds % values["user"] if "user" in values else unknown)))
    if inputs:
        out.append((translate("Waits for inputs (M66)"), f"{inputs}, " + translate("not counted")))
    if stops:
        out.append((translate("Stops (M0, M1)"), f"{stops}, " + translate("not counted")))
    return out
