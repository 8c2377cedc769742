# SPDX-License-Identifier: GPL-2.0-or-later
# FP-008. Programs of other kinds, each started at each of its lines: what the rest visits, and where it ends with
# which tool, is what the whole program does; nothing moves or starts before the confirmation.
from mill import *

PROGRAMS = {
    "g52": "G0 Z80\nG52 X2\nG1 X3 F900\nG52 X0 Y1\nG1 Y3\nG52 X0 Y0\nG1 X1\n",
    "tools": "T1 M6\nG43\nG0 Z60\nG1 X2 F900\nT2 M6\nG43\nG0 Z70\nG1 Y2\nG49\nG0 Z90\nT3\nG1 X1\nM6\nG1 X0\n",
    "arcs": "G0 Z80\nG1 X0 F900\nG2 X4 Y4 I4 J0\nG3 X8 Y0 R4\nG18\nG2 X10 Z80 R1\nG19\nG3 Y3 Z80 R3\nG17\nG1 X0\n",
    "comp": "T4 M6\nG43\nG0 Z60\nG0 X-5 Y-5\nG41 D4\nG1 X0 Y0 F900\nG1 Y30\nG1 X30\nG1 Y0\nG1 X0\nG40\nG1 X-5 Y-5\n",
    "cycles": "G0 Z80\nG81 X1 Y1 Z75 R79 F900\nX2\nX3 Y2\nG83 X4 Z76 R79 Q2\nY4\nG80\nG99\nG82 X1 Y1 Z77 R79 P0.1\n"
              "X3\nG98\nX4\nG80\nG1 X0\n",
    "css": "G0 Z80\nG7\nG0 X20\nG96 D2000 S100 M3\nG1 X10 F900\nG1 X8\nG97 S500\nG1 X6\nM5\nG8\nG1 X0\n",
    "m70": "G0 Z80\nG1 X1 F900\nM70\nG20 G91\nG1 X0.1\nM72\nG1 X4\nM73\nG91\nG1 X1\nG90\nG1 X0\n",
    "rotation": "G10 L2 P1 R45\nG0 Z80\nG1 X5 F900\nG1 Y5\nG10 L2 P1 R0\nG1 X1\nG1 Y0\n",
    "g28": "G0 Z80\nG1 X3 F900\nG28.1\nG1 X5\nG28 Z85\nG1 X1\nG30.1\nG1 X4\nG30\nG1 X0\n",
    "coolant": "M8\nG0 Z80\nG1 X1 F900\nM7\nG1 X2\nM9\nG1 X3\nM4 S300\nG1 X4\nS700\nG1 X5\nM3\nG1 X0\n",
    "g5": "G0 Z80\nG1 X0 Y0 F900\nG5 I0 J3 P0 Q-3 X4 Y4\nG1 X6\nG5.1 X8 Y0 I1 J1\nG1 X0\n",
}
START = ("M61 Q0 G49 G54 G92.1 M5 M9", "G10 L2 P1 X0 Y0 Z0 R0", "G10 L2 P2 X0 Y0 Z0 R0",
         "G21 G90 G61 G17 G94 G97 G98 G8 G80 G40 M48 F100 S0", "G0 X0 Y0 Z100",
         "G28.1", "G30.1")


def prepare(text):
    for line in START:
        if mdi(line) != 1:
            raise SystemExit(f"{line} {messages()}")
    program(text)


def outputs():
    poll()
    return xyz(), s.spindle[0]["speed"], s.flood, s.mist, s.tool_in_spindle


def follow():
    """Line -> where its move ended; how it all ended."""
    ends = {}
    while poll().interp_state != INTERP_IDLE:
        if s.motion_line:
            ends[s.motion_line] = xyz(3)
        sleep(0.002)
    return ends, outputs(), messages()


def near(a, b):
    return all(abs(x - y) < 0.1 for x, y in zip(a, b))


on()
for name, text in PROGRAMS.items():
    text = "G61\n" + text + "M2\n"
    lines = text.splitlines()
    prepare(text)
    c.auto(AUTO_RUN, 0)
    ends, last, told = follow()
    starts = [n for n in range(2, len(lines)) if not lines[n - 1].startswith(("o1", "#"))]
    for n in starts:
        prepare(text)
        before = outputs()
        c.restore(n)
        c.wait_complete()
        sleep(0.1)
        if outputs() != before or s.restore_line != n or not messages():
            print(name, n, lines[n - 1], "not shown, or something was done", outputs())
            continue
        c.restore_confirm(n)
        ends_now, last_now, told_now = follow()
        for line, place in ends.items():
            if line > n and not near(ends_now.get(line, (1e9, 0, 0)), place):
                print(name, n, lines[n - 1], "line", line, lines[line - 1], "ends at", place, "restored",
                      ends_now.get(line))
        if last_now != last or told_now != told:
            print(name, n, lines[n - 1], "ends", last, "restored", last_now, told_now)
    print(name, len(starts), "starts", last, told)
