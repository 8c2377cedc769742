# SPDX-License-Identifier: GPL-2.0-or-later
"""M6 by tool_probe_m6: the change, then the tool is measured on the sensor."""
from mill import *

on()
for line in ("G21 G90 G49", "#5000=7", "G0 X5 Y6 Z-3", "G91 F123"):
    mdi(line)
for tool, trip in (2, -50), (3, -42.5):
    setp("sensor.max", trip)
    print(mdi(f"T{tool}"), mdi("M6", 200), messages())
    print("tool", poll().tool_in_spindle, "offset", round(s.tool_offset[2], 2), "table",
          round(s.tool_table[0].zoffset, 2), "at", xyz(2),
          "modes kept", 910 in s.gcodes, 210 in s.gcodes, round(s.settings[1], 1))
    print(mdi("(debug,%.3f#4999 %.3f#4998 %.3f#4997)"), messages())
setp("sensor.max", -500)
print("no contact:", mdi("T1"), mdi("M6", 200), messages(), "tool", poll().tool_in_spindle)
mdi("G20 G90 G49")
mdi("#5000=[7/25.4]")
setp("sensor.max", -50)
print("inch:", mdi("T2"), mdi("M6", 200), messages(), "offset", round(poll().tool_offset[2], 2), xyz(2),
      200 in s.gcodes)
mdi("G21 G90 G49")
mdi("#5000=7")
print("again:", run("G21 G90\nT1 M6\nG0 Z10\nM2\n", 300), messages(), "tool", poll().tool_in_spindle,
      round(s.tool_offset[2], 2), xyz(1))
