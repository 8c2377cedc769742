# SPDX-License-Identifier: GPL-2.0-or-later
# With [TASK]RUN_FROM_LINE = restore AUTO_RUN at a line shows first too; the user's tool change routine
# runs once, for the tool that is needed (FP-008).
from mill import *

on()
mdi("G0 X0 Y0 Z100")
program("T1 M6\nG43\nG0 X1\nM3 S500\nT2 M6\nG43\nG0 X2\nG1 X3 F600\nM2\n")
c.auto(AUTO_RUN, 8)
print(c.wait_complete(), poll().restore_line, xyz(1), messages()[0].split(".")[0])
sleep(1)
print(xyz(1), poll().spindle[0]["speed"], s.tool_in_spindle)
c.restore_confirm(8)
print(c.wait_complete(60), xyz(1), poll().tool_in_spindle, s.spindle[0]["speed"], messages())
c.auto(AUTO_RUN, 0)
print(c.wait_complete(60), xyz(1), messages())
