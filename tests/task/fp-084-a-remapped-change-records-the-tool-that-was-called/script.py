# SPDX-License-Identifier: GPL-2.0-or-later
# T, M6 and M61 remapped by the glue library, with pockets that are neither tool numbers nor places of the table:
# status, pin, parameters, length and table name the tool that was called, by MDI and in a program.
from mill import *

random = linuxcnc.ini("mill.ini").find("EMCIO", "RANDOM_TOOLCHANGER") == "1"


def show(what, result):
    told = messages()
    mdi("G43")
    mdi("(debug,%d#5400 %d#<_current_tool> %.1f#5403)")
    where = f" table {tools_in_pockets('mill.tbl')}" if random else ""
    print(f"{what:10} {result} T{poll().tool_in_spindle} pin {getp('iocontrol.0.tool-number')} length "
          f"{s.tool_offset[2]:g} parameters {messages()}{where}", told)


on()
for line in ("T12 M6", "T3 M6", "T30", "M6", "M61 Q12", "T3", "M61 Q30", "T0 M6", "T3 M6", "M6", "T99 M6"):
    show(line, mdi(line))
show("program", run("T12 M6\nT3\nG0 X1\nM6\nT30\nG0 X2\nM2\n"))
show("then M6", mdi("M6"))
