# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *


def wheel(axis, counts):
    """Selects an axis, turns the wheel to a count and lets the machine come to rest."""
    hal.set_s("wheel-axis", str(axis))
    sleep(0.1)
    hal.set_s("wheel-counts", str(counts))
    sleep(2)
    return [round(p, 3) for p in poll().actual_position[:3]]


def press(button, seconds=0.3):
    hal.set_s(f"button-{button}", "1")
    sleep(seconds)
    hal.set_s(f"button-{button}", "0")
    sleep(0.2)


press("estop-reset")
press("machine-on")
print("on:", poll().task_state == STATE_ON, hal.get_value("lamp-machine-on"))
c.teleop_enable(0)
c.wait_complete()
press("home-all")
print("homed:", until(lambda s: all(s.homed[:3])))

# The wheel: joints before teleop, then axes; one at a time, by the selected step.
print("joint 1 by 5 steps of 1 mm:", wheel(2, 5))
c.teleop_enable(1)
c.wait_complete()
hal.set_s("wheel-step-0", "1")
print("Z by -30 steps of 0.1 mm:", wheel(3, -25))
print("off:", wheel(0, 100))

press("to-zero")
print("to zero:", until(lambda s: s.inpos and abs(s.actual_position[1]) < 1e-6),
      [round(p, 3) for p in s.actual_position[:2]])
program("G21 G90 G1 X50 F600\nG1 X0\nM2\n")
press("run")
sleep(1)
print("runs:", poll().interp_state != INTERP_IDLE, hal.get_value("lamp-running"))
press("pause")
sleep(0.5)
x = poll().actual_position[0]
sleep(1)
print("paused:", poll().paused, 0 < x < 50 and x == poll().actual_position[0])
press("pause")
sleep(1)
print("goes on:", not poll().paused, poll().actual_position[0] != x)
press("stop")
print("stopped:", until(lambda s: s.interp_state == INTERP_IDLE and s.inpos), messages())
