# SPDX-License-Identifier: GPL-2.0-or-later
"""The data items, and their values from the status of the controller."""

import math
import os
import time
from dataclasses import dataclass

import linuxcnc

from .settings import LETTERS, LINEAR

LOOK_AGAIN_S = 5.0
SYSTEMS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")
MODES = {linuxcnc.MODE_MANUAL: "MANUAL", linuxcnc.MODE_AUTO: "AUTOMATIC", linuxcnc.MODE_MDI: "MANUAL_DATA_INPUT"}
EXECUTION = {linuxcnc.INTERP_IDLE: "READY", linuxcnc.INTERP_READING: "ACTIVE", linuxcnc.INTERP_WAITING: "ACTIVE",
             linuxcnc.INTERP_PAUSED: "INTERRUPTED"}


@dataclass(frozen=True)
class Item:
    """One data item; `component` is the id of the component that has it."""
    id: str
    category: str
    type: str
    component: str
    subtype: str = ""
    units: str = ""
    native: str = ""       # unit of the machine, where it is another
    name: str = ""
    table: bool = False

    @property
    def element(self):
        """Name of its element in a stream."""
        prefix, plain = ("x:", self.type[2:]) if self.type.startswith("x:") else ("", self.type)
        return prefix + "".join(word.capitalize() for word in plain.split("_")) + ("Table" if self.table else "")


def all_items(settings):
    """Those of the device, in the order of the probe document."""
    inch = "INCH" if abs(settings.mm - 1) > 1e-9 else ""
    items = [Item("avail", "EVENT", "AVAILABILITY", settings.id),
             Item("assetchg", "EVENT", "ASSET_CHANGED", settings.id),
             Item("assetrm", "EVENT", "ASSET_REMOVED", settings.id),
             Item("estop", "EVENT", "EMERGENCY_STOP", "ctrl"), Item("mode", "EVENT", "CONTROLLER_MODE", "ctrl"),
             Item("execution", "EVENT", "EXECUTION", "path"), Item("program", "EVENT", "PROGRAM", "path"),
             Item("line", "EVENT", "LINE_NUMBER", "path", "ACTUAL"),
             Item("pathfeed", "SAMPLE", "PATH_FEEDRATE", "path", "", "MILLIMETER/SECOND", inch and "INCH/SECOND"),
             Item("feedovr", "SAMPLE", "PATH_FEEDRATE", "path", "OVERRIDE", "PERCENT"),
             Item("toolnum", "EVENT", "TOOL_NUMBER", "path"), Item("toolasset", "EVENT", "TOOL_ASSET_ID", "path"),
             Item("workoffset", "EVENT", "WORK_OFFSET", "path", table=True),
             Item("tooloffset", "EVENT", "TOOL_OFFSET", "path", table=True),
             Item("xyrotation", "SAMPLE", "x:COORDINATE_ROTATION", "path", "", "DEGREE")]
    for letter in settings.axes:
        low, linear = letter.lower(), letter in LINEAR
        for prefix, subtype in (("pos_", "ACTUAL"), ("poscmd_", "COMMANDED")):
            items.append(Item(prefix + low, "SAMPLE", "POSITION" if linear else "ANGLE", f"axis_{low}", subtype,
                              "MILLIMETER" if linear else "DEGREE", inch if linear else ""))
    items += [Item("spdl_speed", "SAMPLE", "ROTARY_VELOCITY", "spindle", "ACTUAL", "REVOLUTION/MINUTE"),
              Item("spdl_speed_cmd", "SAMPLE", "ROTARY_VELOCITY", "spindle", "COMMANDED", "REVOLUTION/MINUTE"),
              Item("spdl_mode", "EVENT", "ROTARY_MODE", "spindle"),
              Item("spdl_dir", "EVENT", "DIRECTION", "spindle", "ROTARY"),
              Item("coolant_flood", "EVENT", "x:FLOOD", "coolant"), Item("coolant_mist", "EVENT", "x:MIST", "coolant")]
    items += [Item(h.id, "SAMPLE", h.type, h.component, h.subtype, h.units, name=h.name) for h in settings.hal_items]
    return items


def agent_items(settings):
    agent = f"agent_{settings.plain_name}"
    return [Item("agent_avail", "EVENT", "AVAILABILITY", agent),
            Item("agent_device_added", "EVENT", "DEVICE_ADDED", agent),
            Item("agent_device_removed", "EVENT", "DEVICE_REMOVED", agent),
            Item("agent_device_changed", "EVENT", "DEVICE_CHANGED", agent)]


def rounded(value, digits=6):
    return str(round(value, digits) + 0.0)


class Reader:
    """Takes the values of all items. An item without a value is not in the result."""

    def __init__(self, settings, hal):
        self.settings, self.hal = settings, hal
        self.stat, self.tool = linuxcnc.stat(), None
        self.seen_tools, self.known_tools, self.look_again = None, [], 0.0

    def poll(self):
        """True while the controller is there."""
        try:
            self.stat.poll()
        except linuxcnc.error:
            self.stat = linuxcnc.stat()  # connects to the next controller
            return False
        return self.stat.linear_units > 0

    def cells(self, pose):
        return {letter: rounded(self.settings.scaled(letter, pose[LETTERS.index(letter)]))
                for letter in self.settings.axes}

    def values(self):
        there = self.poll()
        found = self.machine() if there else {}
        if self.hal:
            for item in self.settings.hal_items:
                try:
                    value = self.hal.get_value(item.pin)
                except RuntimeError:
                    continue
                if math.isfinite(value):
                    found[item.id] = str(int(value)) if isinstance(value, (bool, int)) else rounded(value)
        return found

    def machine(self):
        s, settings = self.stat, self.settings
        spindle = s.spindle[0]
        tool = f"tool-{s.tool_in_spindle}" if s.tool_in_spindle > 0 else ""
        found = {
            "avail": "AVAILABLE", "estop": "TRIGGERED" if s.task_state == linuxcnc.STATE_ESTOP else "ARMED",
            "mode": MODES.get(s.task_mode), "execution": EXECUTION.get(s.interp_state),
            "program": os.path.basename(s.file), "line": str(s.motion_line),
            "pathfeed": rounded(s.current_vel / settings.mm), "feedovr": rounded(s.feedrate * 100, 1),
            "toolnum": str(s.tool_in_spindle), "toolasset": tool,
            "workoffset": {SYSTEMS[s.g5x_index - 1]: self.cells(s.g5x_offset)}
            if 1 <= s.g5x_index <= len(SYSTEMS) else None,
            "tooloffset": {f"T{s.tool_in_spindle}" if tool else "G43": self.cells(s.tool_offset)},
            "xyrotation": rounded(s.rotation_xy), "spdl_speed": rounded(spindle["speed"] * spindle["override"], 3),
            "spdl_speed_cmd": rounded(spindle["speed"], 3), "spdl_mode": "SPINDLE",
            "spdl_dir": {1: "CLOCKWISE", -1: "COUNTER_CLOCKWISE"}.get(spindle["direction"]),
            "coolant_flood": "ON" if s.flood else "OFF", "coolant_mist": "ON" if s.mist else "OFF"}
        if found["workoffset"] and any(s.g92_offset):
            found["workoffset"]["G92"] = self.cells(s.g92_offset)
        for letter in settings.axes:
            at = LETTERS.index(letter)
            found[f"pos_{letter.lower()}"] = rounded(settings.scaled(letter, s.actual_position[at]))
            found[f"poscmd_{letter.lower()}"] = rounded(settings.scaled(letter, s.position[at]))
        if self.tool is not None and tool and tool != self.tool:
            found["assetchg"] = tool
        self.tool = tool
        return {key: value for key, value in found.items() if value}

    def tools(self):
        """The tool table as dicts with what a CuttingTool needs; the tool in the spindle is USED. Looks again at what
        changed, and at everything now and then (pockets and comments are not in the status)."""
        seen, now = (self.stat.tool_table, self.stat.tool_in_spindle), time.monotonic()
        if seen == self.seen_tools and now < self.look_again:
            return self.known_tools
        self.seen_tools, self.look_again, found = seen, now + LOOK_AGAIN_S, []
        for entry in seen[0][1:]:
            if entry.id > 0:
                try:
                    info = self.stat.toolinfo(entry.id)
                except ValueError:  # taken out of the table meanwhile
                    continue
                info["used"] = entry.id == self.stat.tool_in_spindle
                found.append(info)
        self.known_tools = found
        return found
