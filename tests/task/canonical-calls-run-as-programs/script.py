# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *


def told():
    return [t[:100] for t in messages()]


def at():
    poll()
    return [round(v, 3) + 0.0 for v in s.position[:3]]


PART = """; a slot
    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)
    2 N..... SET_G5X_OFFSET(2, 10.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)
    3 N..... USE_TOOL_LENGTH_OFFSET(0 0 1.5 0 0 0 0 0 0)
SELECT_TOOL(1)
CHANGE_TOOL()
SET_SPINDLE_SPEED(0, 1000)
START_SPINDLE_CLOCKWISE(0)
FLOOD_ON()
STRAIGHT_TRAVERSE(0, 0, 0, 0, 0, 0)
SET_FEED_RATE(1200)
STRAIGHT_FEED(20, 0, 0, 0, 0, 0)
ARC_FEED(20, 20, 20, 10, 1, 0, 0, 0, 0)
SET_MOTION_OUTPUT_BIT(0)
STRAIGHT_FEED(0, 20, 0, 0, 0, 0)
"""
END = "FLOOD_OFF()\nSTOP_SPINDLE_TURNING(0)\nSET_G5X_OFFSET(1,0,0,0,0,0,0)\nUSE_TOOL_LENGTH_OFFSET(0 0 0 0 0 0 0 0 0)\nPROGRAM_END()\nON_RESET()\n"
print("at start:", told())
on()
print("run", run(PART + END), at(), "tool", s.tool_in_spindle, "spindle", s.spindle[0]["enabled"], "flood",
      s.flood, told())
print("without PROGRAM_END", run("SET_FEED_RATE(600)\nSTRAIGHT_FEED(5,0,0,0,0,0)\nSTRAIGHT_FEED(5,0.01,0,0,0,0)\n"),
      at(), told())

print("mdi", mdi("SET_G5X_OFFSET(1, 0, 3, 0, 0, 0, 0)"), mdi("STRAIGHT_TRAVERSE(1, 2, 3, 0, 0, 0)"), at(),
      s.g5x_index, told())
print("mdi that is G-code", mdi("G0 X0"), at(), told(), s.interpreter_errcode)
print("mdi beyond the limits", mdi("STRAIGHT_TRAVERSE(1000, 2, 3, 0, 0, 0)"), at(), told())
print("mdi again", mdi("SET_G5X_OFFSET(1, 0, 0, 0, 0, 0, 0)"), mdi("STRAIGHT_TRAVERSE(0, 0, 0, 0, 0, 0)"), at(), told())

program(PART + END)
c.auto(AUTO_RUN, 10)
print("from line 10", c.wait_complete(60), at(), "tool", s.tool_in_spindle, told())

program(PART + "DWELL(100)\n" + END)
c.auto(AUTO_RUN, 0)
need(lambda s: s.motion_line == 13, "arc")
print("in the arc:", [g for g in s.gcodes[1:] if g in (20, 30, 210, 550, 430)], s.settings[1], "line", s.motion_line,
      s.spindle[0]["enabled"], s.flood)
c.abort()
c.wait_complete()
idle()
print("aborted: spindle", s.spindle[0]["enabled"], "flood", s.flood, "system", s.g5x_index,
      [round(v, 3) for v in s.g5x_offset[:3]], told())
print("run after it", run(PART + END), at(), told())

for mistake in ("STRAIGHT_FED(1,0,0,0,0,0)", "SET_FEED_RATE(0)\nSTRAIGHT_FEED(1,0,0,0,0,0)"):
    run("STRAIGHT_TRAVERSE(4, 4, 0, 0, 0, 0)\n" + mistake + "\nSTRAIGHT_TRAVERSE(9, 9, 0, 0, 0, 0)\nPROGRAM_END()\n")
    idle()
    print("mistake", at(), told(), "line", s.error_line, "column", s.error_column, s.error_fix[:40])
print("a parameter file:", Path("none.var").exists())
