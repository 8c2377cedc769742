# SPDX-License-Identifier: GPL-2.0-or-later
# FP-149: the realtime thread stands still for tens of ms to seconds, under a program, a jog, and at rest.
import math
import re
from pathlib import Path

import hal

from mill import *


def stall(seconds):
    """Virtual seconds that passed, and servo cycles that ran, from a stall to 20 ms after it."""
    time, before = clock.now(), hal.get_value("stall.cycles")
    hal.set_p("stall.seconds", str(seconds))
    sleep(seconds + 0.02)
    return clock.now() - time, hal.get_value("stall.cycles") - before


def said():
    return [re.sub(r"^\d\d:\d\d:\d\d|load [\d.]+ on \d+", "#", m) for m in messages()]


def position():
    return poll().position[0]


ACCELERATION = float(linuxcnc.ini("mill.ini").find("JOINT_0", "MAX_ACCELERATION"))
on()
Path("part.ngc").write_text("G21 G90 G64 P0.01 F3000\nG0 X0 Y0 Z60\n"
                            + "".join(f"G1 X{n / 2} Y{n % 2 / 100}\n" for n in range(1, 161)) + "G1 Y0\nM2\n")
mode(MODE_AUTO)
c.program_open(str(Path("part.ngc").resolve()))
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[0] > 5 and s.current_vel > 45, "feed")
stall(0.005)
print("5 ms: goes on", poll().paused, said())
for seconds in (0.05, 2.5):
    print(f"== {seconds} s under a program at 50 mm/s")
    before = position()
    time, cycles = stall(seconds)
    print("missed cycles are not made up:", cycles < 60, cycles if cycles >= 60 else "")
    need(lambda s: s.current_vel == 0, "standstill")
    print("comes to rest on its way:", 0 < position() - before < 6, s.interp_state == INTERP_PAUSED, s.paused,
          s.task_paused)
    held = position()
    sleep(1)
    print("stays:", position() == held, said())
    c.auto(AUTO_RESUME)
    need(lambda s: s.current_vel > 45, "motion again")
need(lambda s: s.interp_state == INTERP_IDLE, "end")
print("the program ends where it should:", [round(p, 4) for p in poll().position[:3]], s.interpreter_errcode, said())

print("== task stands still for 9 s, under motion that it has given before")
Path("part.ngc").write_text("G21 G90 G64 P0.01 F3000\nG0 X0 Y0\n"
                            + "".join(f"G1 X{n / 10} Y{math.sin(n / 8):.4f}\n" for n in range(1, 2501)) + "M400\nG1 X260\nM2\n")
mode(MODE_AUTO)
c.program_open(str(Path("part.ngc").resolve()))
mode(MODE_MDI)
c.mdi("G0 X0")
c.wait_complete()
mode(MODE_AUTO)
c.auto(AUTO_RUN, 0)
begin, changes, rests = clock.now(), [], 0
while hal.get_value("joint.0.pos-cmd") < 259.9 and clock.now() < begin + 40:
    sleep(0.001)
    speed = hal.get_value("joint.0.vel-cmd")
    changes.append(abs(hal.get_value("joint.0.acc-cmd")))
    rests += speed == 0 and hal.get_value("joint.0.pos-cmd") > 0.5
print("it rests at the end of what it was given:", 1000 < rests < 9000 or rests)
print("within its acceleration:", max(changes) < 1.001 * ACCELERATION or max(changes))
need(lambda s: s.interp_state == INTERP_IDLE, "end")
print("and goes on by itself to the end:", round(position(), 4), said())

print("== a jog")
mode(MODE_MANUAL)
c.teleop_enable(1)
c.wait_complete()
c.jog(JOG_CONTINUOUS, 0, 1, 50)
need(lambda s: s.axis[1]["velocity"] > 40, "jog")
stall(0.3)
need(lambda s: s.axis[1]["velocity"] == 0 and s.inpos, "standstill")
print("ends:", said())
print("== at rest")
stall(0.3)
print(said(), poll().task_state == STATE_ON)
print("== threads that are stopped on purpose are no stall")
for command in ("stop", "start"):
    clock.run(["halcmd", command])
    sleep(1)
print(said())
print("== a function before motion takes too long")
clock.run(["halcmd", "delf", "stall", "servo-thread"])
clock.run(["halcmd", "addf", "stall", "servo-thread", "1"])
stall(0.3)
print(said())
mode(MODE_MDI)
c.mdi("G0 X3")
c.wait_complete()
print("goes on:", round(position(), 4))
