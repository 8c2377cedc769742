# SPDX-License-Identifier: GPL-2.0-or-later
# A tool change routine in Python is looked through, and run once after the confirmation; a long
# program is looked through in slices while task keeps its beat.
from mill import *

on()
mdi("G0 X0 Y0 Z100")
program("T1 M6\nG43\nG0 X1\nM3 S500\nT2 M6\nG43\nG0 X2\nG1 X3 F600\nM2\n")
c.restore(8)
print(c.wait_complete(), poll().restore_line, xyz(1), len(messages()))
c.restore_confirm(8)
print(c.wait_complete(60), xyz(1), poll().tool_in_spindle, messages())
c.auto(AUTO_RUN, 0)
print(c.wait_complete(60), xyz(1), poll().tool_in_spindle, messages())
program("G1 F1000\n" + "G1 X1\nG1 X2\n" * 50000 + "M2\n")
before = poll().taskbeat
c.restore(100000)
print(c.wait_complete(100), poll().restore_line, s.taskbeat - before > 30)
