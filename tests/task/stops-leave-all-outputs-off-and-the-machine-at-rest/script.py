# SPDX-License-Identifier: GPL-2.0-or-later
# FP-001, FP-002, FP-009, FP-011, FP-118: a program of short segments with spindle, coolant and
# a tool change is stopped at 200 instants, running and paused, by abort, machine off and emergency
# stop. The machine then only comes to rest on its path; nothing is queued, nothing is on, and
# nothing rises later, not when another program is opened either.
import math
import os
import random
import hal
from mill import *

seed = 20
STOPS_MOST, PAUSES = int(os.environ.get("STOPS", "200")), int(os.environ.get("PAUSES", "1000"))
R = random.Random(seed)
BEFORE = 8
TEXT = "G21 G90 G64 P0.02 F3000\nG0 X20 Y0\nM3 S2000\nM7\nM8\nG1 X20\n"
TEXT += "".join(f"G1 X{20 * math.cos(a / 50):.4f} Y{20 * math.sin(a / 50):.4f}\n" for a in range(1, 315))
TEXT += "M9\nT1 M6\nM3 S1500\nM8\n"
TEXT += "".join(f"G1 X{20 * math.cos(a / 50):.4f} Y{20 * math.sin(a / 50):.4f}\n" for a in range(1, 315)) + "M2\n"
OUTPUTS = ("spindle.0.on", "iocontrol.0.coolant-flood", "iocontrol.0.coolant-mist", "iocontrol.0.tool-change",
           "iocontrol.0.tool-prepare")


def high():
    poll()
    return [p for p, on in (("spindle", s.spindle[0]["enabled"]), ("flood", s.flood), ("mist", s.mist)) if on]


def pins():
    return [p for p in OUTPUTS if hal.get_value(p)]


print("at power-up", pins())
on()
print("turned on", pins())
STOPS = {"abort": c.abort, "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP)}
wrong = 0
mdi("F1000 G0 X20 Y0")
mode(MODE_AUTO)
program(TEXT)
for n in range(STOPS_MOST):
    name = R.choices(list(STOPS), [8, 1, 1])[0]
    c.auto(AUTO_RUN, 0)
    sleep(R.uniform(0.05, 3.5))
    paused = R.random() < 0.4
    if paused:
        c.auto(AUTO_PAUSE)
        sleep(R.choice((0.01, 0.3)))
    poll()
    speed = s.current_vel
    at = s.position[:2]
    STOPS[name]()
    c.wait_complete()
    positions = []
    for _ in range(40):
        sleep(0.01)
        positions.append(poll().position[:2])
    travelled = sum(math.dist(a, b) for a, b in zip([at] + positions, positions))
    off_path = max(abs(math.hypot(*p) - 20) for p in positions) if math.hypot(*at) > 19.9 else 0
    rest = positions[-1] == positions[-10] and s.queue == 0 and s.inpos and s.interp_state == INTERP_IDLE
    if not rest or travelled > 1 + speed ** 2 / 1600 or off_path > 0.1 or high():
        wrong += 1
        print("stop", n, name, "paused" if paused else "",
              f"speed {speed:.1f} went {travelled:.3f} off the path by {off_path:.3f}", rest, high())
    if name != "abort":
        on(home=not all(poll().homed[:3]))
    if n % 20 == 0:
        sleep(2)
        if pins() or poll().position[:2] != positions[-1]:
            print("stop", n, "later", pins(), s.position[:2], positions[-1])
        program("G0 X1\nM2\n", "other.ngc")
        sleep(1)
        if poll().position[:2] != positions[-1] or s.queue or pins():
            print("opening another program moved the machine")
    if poll().task_mode != MODE_AUTO:
        mode(MODE_AUTO)
    if poll().file.endswith("other.ngc") or name != "abort":
        program(TEXT)
print(STOPS_MOST, "stops,", wrong, "wrong")
# Pauses and resumes change nothing of the path and of where the program ends (FP-009).
mdi("M61 Q0 G0 X20 Y0")
program(TEXT.replace("M2\n", "".join(l + "\n" for l in TEXT.splitlines() if l.startswith("G1")) * 4 + "M2\n"))
c.auto(AUTO_RUN, 0)
for n in range(PAUSES):
    sleep(R.uniform(0.005, 0.05))
    c.auto(AUTO_PAUSE)
    sleep(R.uniform(0.001, 0.1))
    p = poll().position[:2]
    if abs(math.hypot(*p) - 20) > 0.03:
        print("pause", n, "left the path", p)
    if s.interp_state == INTERP_IDLE:
        print("at its end after", n)
    c.auto(AUTO_RESUME)
c.wait_complete(200)
print(poll().state, xyz(4), (round(20 * math.cos(314 / 50), 4), round(20 * math.sin(314 / 50), 4)), messages(), pins())
