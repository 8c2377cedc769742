# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *


def put(pin, value):
    hal.set_p(f"ini.{pin}", str(value))
    sleep(0.02)
    poll()


def highest(target):
    """Highest velocity, acceleration and jerk of joint 0 on the way to X target, of all its cycles."""
    for value in ("1", "0"):
        hal.set_p("limitcheck.0.reset", value)
        sleep(0.01)
    mdi(f"G0 X{target}")
    return [hal.get_value(f"limitcheck.0.worst-{name}") for name in ("vel", "acc", "jerk")]


on()
print("begin with the file:", [hal.get_value(f"ini.{p}") for p in
      ("0.max_limit", "1.min_limit", "2.max_velocity", "0.max_acceleration", "0.max_jerk", "1.home_sequence",
       "2.home_sequence", "z.max_velocity", "x.max_jerk", "traj_max_velocity", "traj_max_jerk",
       "traj_default_acceleration", "traj_planner_type")])

put("0.max_limit", 350)
put("0.min_limit", -340)
put("0.ferror", 0.9)
put("0.min_ferror", 0.1)
put("0.backlash", 0.01)
print("joint:", {k: s.joint[0][k]
                 for k in ("max_position_limit", "min_position_limit", "max_ferror", "min_ferror", "backlash")})
put("0.backlash", 0)
put("x.max_limit", 30)
put("x.min_limit", -20)
print("axis:", s.axis[0]["max_position_limit"], s.axis[0]["min_position_limit"])
messages()
mdi("G0 X31")
print("beyond:", messages()[:1])
put("x.max_limit", 400)
put("x.min_limit", -400)
put("traj_default_velocity", 11)  # of the planner: no status shows it
put("traj_max_velocity", 180)
put("traj_max_acceleration", 1400)
put("traj_default_acceleration", 1300)
print("trajectory:", s.max_velocity, s.acceleration, s.max_acceleration)
put("traj_default_acceleration", 9999)
print("default beyond the maximum:", s.acceleration)

print("plain:", round(highest(100)[0], 3))
put("x.max_velocity", 50)
print("axis velocity:", round(highest(0)[0], 3))
put("0.max_velocity", 40)
print("joint velocity:", round(highest(100)[0], 3))
put("traj_max_velocity", 30)
print("trajectory velocity:", round(highest(0)[0], 3))
for pin, v in (("x.max_velocity", 100), ("0.max_velocity", 100), ("traj_max_velocity", 200)):
    put(pin, v)
put("x.max_acceleration", 200)
print("axis acceleration:", round(highest(100)[1], 2))
put("0.max_acceleration", 100)
print("joint acceleration:", round(highest(0)[1], 2))
put("x.max_acceleration", 1000)
put("0.max_acceleration", 1000)

put("traj_planner_type", 1)
print("S-curve, jerk below that of the axis:", highest(100)[2] < 40100)
put("x.max_jerk", 20000)
print("axis jerk:", highest(0)[2] < 20100)
put("0.max_jerk", 10000)
print("joint jerk:", highest(100)[2] < 10100)
put("traj_max_jerk", 0.5)
print("no jerk, no S-curve:", highest(0)[2] > 1e5)
put("traj_max_jerk", 60000)
put("traj_planner_type", 7)
print("an unknown planner is the plain one:", highest(100)[2] > 1e5)

mode(MODE_MANUAL)
c.teleop_enable(0)
c.wait_complete()
c.unhome(-1)
need(lambda s: not any(s.homed[:3]), "unhome")
put("0.home", 12)
put("1.home_offset", 3)
put("2.home_sequence", 2)
c.home(-1)
order = []
while len(order) < 3:
    poll()
    order += [j for j in range(3) if s.homed[j] and j not in order]
    sleep(0.001)
print("homed in the order", order[-1:], "last; X is", s.joint_actual_position[0])
