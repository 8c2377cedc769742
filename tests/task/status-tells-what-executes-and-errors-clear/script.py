# SPDX-License-Identifier: GPL-2.0-or-later
# FP-127, FP-128, FP-129, FP-139: units, codes, line and file of status are those of the move that is
# made; an error belongs to the command that caused it; opening twice is no error.
from mill import *

on()
# FP-129, FP-139
open("helper.ngc", "w").write("o<helper> sub\nG1 X0.3\nG1 X0.4\no<helper> endsub\nM2\n")
program("G61 G21\nG1 X5 F120\nG20\nG1 X0.3 F5\no<helper> call\nG21\nG1 X12 F120\nM2\n")
seen = []
c.auto(AUTO_RUN, 0)
while poll().interp_state != INTERP_IDLE or s.queue:
    if s.motion_type == 2 and s.current_vel > 0.5 and s.motion_line:
        now = s.motion_line, s.file.rsplit("/", 1)[-1], s.program_units, s.call_level >= 0, s.settings[0] >= 0
        if not seen or seen[-1] != now:
            seen.append(now)
    sleep(0.004)
for line, file, units, *_ in seen:
    print("line", line, "of", file, "units", {1: "inch", 2: "mm"}[units])
print("at the end", s.program_units, messages())
# FP-128
print(mdi("G1 X[1/0]"), poll().interpreter_errcode, messages())
print(mdi("G0 X1"), poll().interpreter_errcode)
print(run("G999\nM2\n"), poll().interpreter_errcode, messages())
print(run("G0 X2\nM2\n"), poll().interpreter_errcode)
# FP-139
program("G0 X3\nM2\n")
c.program_open(s.file if poll() else "")
print(c.wait_complete(), messages())
c.auto(AUTO_RUN, 0)
print(c.wait_complete(), xyz(1))
print(run("G0 X1\nG1 X Y2 F100\nM2\n"), s.error_line if poll() else 0, s.error_column, s.error_file.rsplit("/", 1)[-1], messages())
# FP-127: lines queue visibly, in order, and an abort drops them.
mode(MODE_MDI)
for line in ("M66 P0 L3 Q1", "G0 X4", "G0 X5"):
    c.mdi(line)
sleep(0.1)
print("queued", poll().queued_mdi_commands)
c.abort()
c.wait_complete()
sleep(1.5)
print("after the abort", poll().queued_mdi_commands, xyz(1))
