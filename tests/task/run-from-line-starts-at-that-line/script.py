# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *

TEXT = "G0 X1\nG0 X2\nM3 S100\nF300\nG0 X3\nG1 Y5\nT1 M6\nM2\n"
on()
program(TEXT)
for line in (0, 1, 2, 3, 5, 6, 99, -1):
    mdi("M5 M61 Q0 G0 X0 Y0 F1")
    mode(MODE_AUTO)
    c.auto(AUTO_RUN, line)
    result = c.wait_complete(30)
    poll()
    print(line, result, xyz(1), "tool", s.tool_in_spindle, "spindle", s.spindle[0]["speed"], messages())
