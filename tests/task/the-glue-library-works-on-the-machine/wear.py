# SPDX-License-Identifier: GPL-2.0-or-later
"""T by index_lathe_tool_with_wear: Txxyy loads tool xx with the wear of entry 10000 + yy."""
from mill import *

on()
mdi("G21 G90 G49")
for word in "T0101", "T3", "T102", "T7", "T0":
    result = mdi(word)
    print(word, result, "tool", poll().tool_in_spindle, "offset", [round(v, 3) for v in s.tool_offset[:3]], messages(),
          "pins", getp("remapStat.tool"), getp("remapStat.wear"))
print(run("T0201\nG0 X0\nM2\n"), "tool", poll().tool_in_spindle, [round(v, 3) for v in s.tool_offset[:3]], messages())
