# SPDX-License-Identifier: GPL-2.0-or-later
# FP-087: with the feature RETAIN_G43 the core puts the new length on with the change, in sequence.
from mill import *

on()
print(mdi("T1 M6 G43"), poll().tool_offset[2])
print(mdi("T2 M6"), poll().tool_offset[2])
program("T3 M6\nG0 Z90\nM2\n")
c.auto(AUTO_RUN, 0)
print(c.wait_complete(30), poll().tool_offset[2], xyz(1), messages())
print(mdi("G49 T1 M6"), poll().tool_offset[2])
