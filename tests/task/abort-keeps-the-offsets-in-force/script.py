# SPDX-License-Identifier: GPL-2.0-or-later
# FP-006: a program that changes offsets is aborted in the middle of each of its moves, while
# reading is at its end. Status, interpreter and machine must agree on what that move had.
import math
from mill import *

TEXT = """G54 G61 G90 G21 G17 G94 F600
G0 X0 Y0
G1 X2
G10 L2 P2 X10 Y5
G55
G1 X13
G92 X1
G1 X4
G91
G1 X2
G90
T2 M6
G43
G1 Z-60
G52 X3
G1 X5
G92.1
G1 X9
G10 L2 P1 R10
G54
G1 X10
G49
G1 X13
M2
"""
LINES = TEXT.splitlines()


def offsets():
    poll()
    return s.g5x_index, s.g5x_offset[:3], s.g92_offset[:3], s.tool_offset[2], s.rotation_xy


on()
for number, text in enumerate(LINES, 1):
    if not text.startswith("G1 "):
        continue
    for line in ("M61 Q0 G49 G54 G92.1 G10 L2 P1 X0 Y0 Z0 R0", "G10 L2 P2 X0 Y0 Z0", "G90 G0 X0 Y0 Z0"):
        mdi(line)
    program(TEXT)
    messages()
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == number and s.motion_type == 2, f"move of line {number}")
    sleep(0.05)
    before = offsets()
    c.abort()
    idle()
    sleep(0.1)
    after = offsets()
    if before != after:
        print("line", number, "had", before, "now", after)
    mode(MODE_MDI)
    if offsets() != after:
        print("line", number, "before MDI", after, "in MDI", offsets())
    mdi("(debug,#5220 #5420 #5421 #5422)")
    system, *here = map(float, messages()[-1].split())
    x, y, z = (a - b for a, b in zip(s.position[:3], s.g5x_offset))
    turn = math.radians(-s.rotation_xy)
    x, y = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
    shown = [v - o - t for v, o, t in zip((x, y, z), s.g92_offset, s.tool_offset)]
    ok = system == s.g5x_index and all(abs(a - b) < 1e-4 for a, b in zip(shown, here))
    print(number, text, f"G5x {s.g5x_index} G92 {s.g92_offset[0]:g} tool {s.tool_offset[2]:g} R {s.rotation_xy:g}",
          "agrees" if ok else f"status {shown} interpreter {system} {here}")
# Feed and speed of the move that was made are in force again, to the digit.
for words in "G21 G94\nF123.456 S77.5", "G20 G94\nF2.36 S100", "G21 G95\nF0.05 S600":
    program(f"{words} M3\nG90 G1 X0.01\nG1 X5\nF900 S5 G94\nG1 X6\nM2\n")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == 4, "move")
    c.abort()
    c.wait_complete()
    need(lambda s: s.interp_state == INTERP_IDLE, "end")
    print(words.replace("\n", " "), [round(v, 3) for v in s.settings[1:3]], s.gcodes[7], messages())
