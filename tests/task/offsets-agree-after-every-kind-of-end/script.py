# SPDX-License-Identifier: GPL-2.0-or-later
# FP-006, FP-010, FP-016: a program that changes offsets and modes is ended in the middle of each of
# its moves, while reading is at its end, by each kind of stop. Display, parameters, active codes
# and machine then have what that move had; homing and the path mode stay; the next absolute move
# goes where the display says.
import math
import hal
from mill import *

TEXT = """G54 G61 G90 G21 G17 G94 F600
G1 X2
G10 L2 P2 X10 Y5
G55
G1 X1
G92 X1
G1 X4
G20 G64 P0.004
G91 G1 X0.1
G90 G21
T2 M6
G43
G1 X3
G52 X3
G1 X5
G92.1
G18
G10 L2 P1 R10
G54
G1 X10
G49 G17 G61
G1 X13
M2
"""
LINES = TEXT.splitlines()


def modes():
    poll()
    return {"offsets": (s.g5x_index, s.g5x_offset, s.g92_offset, s.tool_offset, s.rotation_xy),
            "path": (round(s.settings[3], 5),),
            "codes": tuple(g for g in s.gcodes[1:]
                           if g in (170, 180, 190, 200, 210, 540, 550, 610, 640, 430, 490, 900, 910)),
                           "units": s.program_units}


def agreed():
    mdi("(debug,#5220 #5420 #5421 #5422 #5221 #5222 #5230 #5403)")
    line = messages()[-1].split()
    system, *here = map(float, line[:4])
    poll()
    unit = 25.4 if s.program_units == 1 else 1
    x, y, z = (a - b for a, b in zip(s.position[:3], s.g5x_offset))
    turn = math.radians(-s.rotation_xy)
    x, y = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
    shown = [(v - o) / unit for v, o in zip((x - s.tool_offset[0], y - s.tool_offset[1], z - s.tool_offset[2]),
                                            s.g92_offset)]
    if system != s.g5x_index or any(abs(a - b) > 1e-3 for a, b in zip(shown, here)):
        return f"status {s.g5x_index} {shown} interpreter {line}"
    target = shown[0] + 0.5 / unit
    mdi(f"G90 G0 X{target:.5f}")
    mdi("(debug,#5420)")
    moved = float(messages()[-1])
    return "" if abs(moved - target) < 1e-3 else f"a move to {target} ended at {moved}"


def chain():
    halcmd("unlinkp", "iocontrol.0.emc-enable-in")
    hal.set_p("iocontrol.0.emc-enable-in", "0")


def limit():
    hal.set_p("joint.0.neg-lim-sw-in", "1")


STOPS = {"abort": c.abort, "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP), "chain": chain,
         "limit": limit, "enable": lambda: hal.set_p("motion.enable", "0")}
count = 0
on()
for name, stop in STOPS.items():
    for number, text in enumerate(LINES, 1):
        if "G1 " not in text:
            continue
        for line in ("M61 Q0 G49 G54 G92.1 G21 G17 G10 L2 P1 X0 Y0 Z0 R0", "G10 L2 P2 X0 Y0 Z0", "G90 G0 X0 Y0 Z0"):
            mdi(line)
        program(TEXT)
        messages()
        c.auto(AUTO_RUN, 0)
        need(lambda s: s.motion_line == number and s.motion_type == 2 and s.current_vel > 1, f"move of line {number}")
        sleep(0.02)
        before = modes()
        stop()
        idle()
        sleep(0.1)
        after = modes()
        for key in before:
            if before[key] != after[key]:
                print(name, "line", number, text, key, "was", before[key], "is", after[key])
        if not all(poll().homed[:3]):
            print(name, "line", number, "unhomed")
        if name == "chain":
            hal.set_p("iocontrol.0.emc-enable-in", "1")
        if name == "limit":
            hal.set_p("joint.0.neg-lim-sw-in", "0")
        if name == "enable":
            hal.set_p("motion.enable", "1")
        if poll().task_state != STATE_ON:
            on(home=False)
        if modes()["offsets"] != after["offsets"]:
            print(name, "line", number, "turning it on changed", after["offsets"], modes()["offsets"])
        if wrong := agreed():
            print(name, "line", number, text, wrong)
        count += 1
# M2 and an error in the program end in the same agreement.
for end in ("M2", "G1 X[1/0]", "G2 X1 Y1 R0.1"):
    for number in (5, 9, 13, 16, 20):
        mdi("M61 Q0 G49 G54 G92.1 G21 G17 G10 L2 P1 X0 Y0 Z0 R0")
        mdi("G90 G0 X0 Y0 Z0")
        run("\n".join(LINES[:number]) + f"\n{end}\n")
        idle()
        sleep(1)
        messages()
        if wrong := agreed():
            print(end, number, wrong)
        count += 1
print(count, "ends")
