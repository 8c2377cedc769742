# SPDX-License-Identifier: GPL-2.0-or-later
# What a Python handler has executed before it waits is made, the last line too; a handler that it called goes on first.
from mill import *

on()
for how in ("mdi", "auto"):
    for line in ("M6", "M400", "o<fetch> call [3]"):
        for before in ("M61 Q0 G49 G90 G21", "G53 G0 X0 Y0 Z0", "T3"):
            mdi(before)
        result = mdi(line) if how == "mdi" else run(line + "\nM2\n")
        idle()
        print(how, line, result, "tool", poll().tool_in_spindle, xyz(3), messages())
        mdi("(debug,#<_value> level %d#<_call_level> %d#<_remap_level>)")
        print("   ", messages())
