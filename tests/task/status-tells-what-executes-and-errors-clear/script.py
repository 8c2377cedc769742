# SPDX-License-Identifier: GPL-2.0-or-later
# FP-128, FP-129, FP-139: units, codes, line and file of status are those of the move that is
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
        now = s.motion_line, s.file.rsplit("/", 1)[-1], s.program_units, s.call_level, s.settings[0] >= 0
        if not seen or seen[-1] != now:
            seen.append(now)
    sleep(0.004)
for line, file, units, level, _ in seen:
    print("line", line, "of", file, "depth", level, "units", {1: "inch", 2: "mm"}[units])
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
print(run("G0 X1\nG1 X Y2 F100\nM2\n"), s.error_line if poll() else 0, s.error_column,
      s.error_file.rsplit("/", 1)[-1], messages())
# A jog shows its speed. In joint mode the status is EXEC while it goes on, in teleop mode it is DONE, as documented.
mode(MODE_MANUAL)
for teleop in (1, 0):
    c.teleop_enable(teleop)
    need(lambda s: s.motion_mode == (TRAJ_MODE_TELEOP if teleop else TRAJ_MODE_FREE), "jog mode")
    c.jog(JOG_CONTINUOUS, 1 - teleop, 0, 5)
    print("jog:", c.wait_complete(0.5), poll().state, s.inpos, round(s.current_vel, 3), getp("motion.current-vel"))
    c.jog(JOG_STOP, 1 - teleop, 0)
    sleep(1)
    print("over:", poll().state, s.inpos, s.current_vel)

# Codes of a block (G of group 0, M of groups 4 and 6) are those of the block that is made, also while it moves,
# when it fails and when it ends the program.
program("G21 G90 G0 X0 F300\nG53 G1 X1\nG1 X2\nG92 X0\nG1 X1\nG92.1\nT1 M6\nG1 X0\nG4 P0.1\nG1 X1\nM2\n")
seen = []
c.auto(AUTO_RUN, 0)
while poll().interp_state != INTERP_IDLE or s.queue:
    if s.current_vel > 0.5 and s.motion_line:
        now = s.motion_line, s.gcodes[2], s.gcodes[16], s.mcodes[1], s.mcodes[3]
        if not seen or seen[-1] != now:
            seen.append(now)
    sleep(0.004)
print(seen)
print("M2:", poll().gcodes[2], s.mcodes[1])
for line in "G4 P0", "G1 X1 F0", "G4 P0", "G1 X[1/0]", "T2 M6", "G2 X3 F10", "M6 G2 X4":
    mdi(line)
    print(line, poll().gcodes[1:3], s.mcodes[3], messages())
# A drilling cycle shows its code from its first move on. It ends its moves exactly, but the path mode is that of the
# program, which stays in force after an abort.
for path in "G64 P0.05", "G61.1":
    program(f"G21 G90 G0 X0 Y0 Z1 F600\n{path}\nG83 X1 Y1 Z-4 R0.5 Q1\nX2\nG80\nM2\n")
    seen = []
    c.auto(AUTO_RUN, 0)
    while s.motion_line < 4 or len(seen) < 2:
        if poll().current_vel > 0.5 and s.motion_line > 2:
            now = s.motion_line, s.gcodes[1], s.gcodes[11], round(s.settings[3], 3)
            if now not in seen:
                seen.append(now)
        sleep(0.004)
    c.abort()
    c.wait_complete()
    need(lambda s: s.interp_state == INTERP_IDLE and s.inpos, "end")
    print(path, seen, "aborted:", s.gcodes[11], round(s.settings[3], 3))
    print("a mistake:", run("G83 X3 Z-4 R0.5\nM2\n"), messages(), poll().gcodes[1])
