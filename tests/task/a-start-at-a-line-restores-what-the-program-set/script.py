# SPDX-License-Identifier: GPL-2.0-or-later
# FP-008: a start at a line shows first what it will do, does nothing before it is confirmed, and
# then stands as a run from the top stood before that line: compared for each line of a program.
from mill import *

TEXT = """G21 G90 G17 G94 G64 P0.05
#1 = 3
o100 sub
G1 X[#1] F[#2]
o100 endsub
T2 M6
G43
G10 L2 P2 X10 Y5
G55
M3 S1200
M8
G0 Z60
G0 X1 Y1
G1 Z55 F600
o100 call [4] [480]
G20
G1 X0.2
G21
G92 Y2
o101 while [#1 GT 0]
#1 = [#1 - 1]
G91 G1 X0.5
G90
o101 endwhile
#<_kept> = 7
M7
G61
G1 Y6 F300
T3 M6
G43
M4 S900
G0 Z70
G2 X[#5420 + 2] Y8 R2
M9
M5
G92.1
G1 X[#<_kept>] Y9
M2
"""
LINES = TEXT.splitlines()
START = ("M61 Q0 G49 G54 G92.1 M5 M9", "G10 L2 P1 X0 Y0 Z0 R0", "G10 L2 P2 X0 Y0 Z0 R0",
         "G21 G90 G64 P0.01 G17 G94 F100 S0", "G0 X0 Y0 Z100")


def state():
    poll()
    return {
        "place": tuple(round(v, 4) + 0.0 for v in s.position[:3]), "tool": s.tool_in_spindle,
        "spindle": s.spindle[0]["speed"], "flood": s.flood, "mist": s.mist,
        "g5x": (s.g5x_index, s.g5x_offset[:2]), "g92": s.g92_offset[:2], "length": round(s.tool_offset[2], 4),
        "units": s.program_units, "codes": tuple(g for g in s.gcodes[1:] if g not in (-1, 0, 10, 20)),
        "feed": round(s.settings[1], 3), "path": round(s.settings[3], 4)}


def prepare():
    for line in START:
        if mdi(line) != 1:
            raise SystemExit(f"{line} {messages()}")
    mode(MODE_AUTO)


on()
# What a run from the top has when a line's turn comes: the program with an M0 in its place.
for number in range(6, len(LINES) + 1):
    prepare()
    program("\n".join(LINES[:number - 1] + ["M0", "M2"]) + "\n")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.interp_state == INTERP_PAUSED and s.queue == 0 and s.inpos, f"M0 before {number}")
    want = state()
    c.abort()
    idle()
    prepare()
    program("\n".join(LINES[:number - 1] + ["M0", "M2"]) + "\n")
    before = state()
    c.restore(number)
    if c.wait_complete() != 1 or poll().restore_line == 0:
        if number in (4,):
            continue
        print("line", number, "not shown", messages())
        continue
    sleep(0.2)
    if state() != before:
        print("line", number, "changed before the confirmation", before, state())
    text = s.restore_text
    line = s.restore_line
    c.restore_confirm(line)
    need(lambda s: s.interp_state == INTERP_PAUSED and s.queue == 0 and s.inpos, f"M0 of {number}")
    got = state()
    for key in want:
        if want[key] != got[key]:
            print("line", number, LINES[number - 1], key, "from the top", want[key], "restored", got[key])
    if number in (28, 34):
        print(text.replace(s.file, "PROGRAM"))
    c.abort()
    idle()
    messages()
# Refusals.
program(TEXT)
c.restore_confirm(28)
print(c.wait_complete(), messages())
for number in (0, 99):
    c.restore(number)
    print(c.wait_complete(), messages(), poll().restore_line)
prepare()
program(TEXT)
c.restore(28)
c.wait_complete()
messages()
open("test.ngc", "a").write("\n")
c.restore_confirm(28)
print(c.wait_complete(), [m.rsplit("/", 1)[-1] for m in messages()], poll().restore_line, xyz(1))
program(TEXT)
c.restore(28)
c.wait_complete()
messages()
mdi("G10 L2 P2 X1")
mode(MODE_AUTO)
c.restore_confirm(28)
print(c.wait_complete(), messages())
for stop in (lambda: c.abort(), lambda: c.state(STATE_OFF), lambda: c.state(STATE_ESTOP)):
    if poll().task_state != STATE_ON:
        on()
    mode(MODE_AUTO)
    program(TEXT)
    c.restore(28)
    c.wait_complete()
    shown = poll().restore_line
    stop()
    c.wait_complete()
    print(shown, poll().restore_line, s.spindle[0]["speed"], s.flood)
on()
# The whole rest of the program runs.
prepare()
program(TEXT)
c.restore(12)
c.wait_complete()
c.restore_confirm(12)
print(c.wait_complete(60), xyz(3), poll().tool_in_spindle, s.spindle[0]["speed"])
prepare()
print(run(TEXT), xyz(3), poll().tool_in_spindle, s.spindle[0]["speed"])
