# SPDX-License-Identifier: GPL-2.0-or-later
# Moves before the mistake are done, then the operator is told; half a second later, or with the next
# command, spindle and coolant go off.
from mill import *

on()


def place():
    poll()
    return s.interpreter_errcode, s.error_line, s.error_file.rsplit("/", 1)[-1]


print(run("G0 X1\nG0 X2\nG1 X[1/0]\nG0 X5\nM2\n"), xyz(1), messages(), place())
print(run("F100\nG0 X1\nG0 X2\nG2 X10 Y0 R1\nG0 X5\nM2\n"), xyz(1), messages(), place())
print(run("M3 S100\nM8\nG0 X3\nG999\nM2\n"), xyz(1), messages(), place(), s.spindle[0]["speed"], s.flood)
sleep(1)
poll()
print(s.spindle[0]["speed"], s.flood, s.spindle[0]["enabled"])
print(run("M3 S100\nM8\nG999\nM2\n"), messages(), poll().spindle[0]["speed"])
mode(MODE_MANUAL)
sleep(0.01)
poll()
print(s.spindle[0]["speed"], s.flood)
print(run("G0 X1\nM2\n"), place())
c.program_open("/nonexistent.ngc")
print(c.wait_complete(), messages(), poll().file.rsplit("/", 1)[-1])
print(run("G0 X1000\nM2\n"), messages(), poll().interp_state)
