# SPDX-License-Identifier: GPL-2.0-or-later
# What the INI file's homing settings become, seen through task: positions, homed, modes.
import hal
from mill import *

print("homemod", [n for n in ("homemod", "homecomp") if hal.component_exists(n)])
on(home=False)
c.teleop_enable(0)
c.wait_complete()
c.home(-1)
sleep(0.002)
c.home(0)
need(lambda s: all(s.homed[:3]), "homing")
until(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, 1)
print("mode", poll().motion_mode, "homed", s.homed[:3], "told", messages())
sleep(0.3)
print("position", [round(j["output"], 3) for j in poll().joint[:3]], "slide",
      [round(hal.get_value(f"sim-joint.{j}.position"), 2) for j in range(3)])
c.state(STATE_OFF)
need(lambda s: s.task_state != STATE_ON, "machine off")
sleep(0.05)
print("off: homed", poll().homed[:3])
c.state(STATE_ON)
need(lambda s: s.task_state == STATE_ON, "machine on")
sleep(0.2)
print("on again: homed", poll().homed[:3], "moves", any(abs(j["velocity"]) > 1e-9 for j in s.joint[:3]))
c.teleop_enable(0)
c.wait_complete()
if hal.component_exists("homemod"):
    hal.set_p("ini.0.home_offset", "9")
    hal.set_p("ini.0.home", "2")
    sleep(0.2)
    for j in range(3):
        c.home(j)
        sleep(0.05)
        need(lambda s: s.homed[j] and not s.joint[j]["homing"], f"homing of {j}")
        sleep(0.1)
        c.teleop_enable(0)
        c.wait_complete()
    sleep(0.3)
    print("by ini pins", round(poll().joint[0]["output"], 3), "switch at",
          round(10 - (hal.get_value("sim-joint.0.position") - s.joint[0]["output"]), 2))
    c.unhome(-1)
    c.wait_complete()
    sleep(0.05)
    print("unhomed", poll().homed[:3], messages())
