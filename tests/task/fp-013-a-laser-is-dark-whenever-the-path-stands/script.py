# SPDX-License-Identifier: GPL-2.0-or-later
# laserpower on a machine whose spindle is the laser: power follows the path's velocity, is zero in feed hold at each
# of many moments, comes back with motion, and is zero in every jog though M3 is still in force.
import random

import hal
from mill import *

R = random.Random(13)


def power():
    return hal.get_value("laserpower.0.power")


on()
program("G21 G90 G64 P0.01 F1800\nM3 S1000\n" + "".join(f"G1 X{10 * (n % 2)} Y{n}\n" for n in range(1, 40)) + "M2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[1] > 0.1, "motion")
dark = lit = wrong = 0
for n in range(30):
    sleep(R.uniform(0.05, 0.4))
    need(lambda s: s.current_vel > 5, "motion")
    lit += power() > 0
    c.auto(AUTO_PAUSE)
    need(lambda s: s.current_vel == 0, "standstill")
    sleep(R.choice((0.002, 0.05, 0.5)))
    dark += power() == 0
    wrong += poll().spindle[0]["enabled"] == 0
    c.auto(AUTO_RESUME)
print("lit in motion", lit, "dark in feed hold", dark, "M3 lost", wrong)
print("end:", c.wait_complete(200), power(), poll().spindle[0]["enabled"], messages())
mdi("M3 S1000")
for joints in (0, 1):
    mode(MODE_MANUAL)
    c.teleop_enable(1 - joints)
    c.wait_complete()
    seen = []
    c.jog(JOG_CONTINUOUS, joints, 1, -20)
    for _ in range(20):
        sleep(0.01)
        seen.append((hal.get_value("motion.current-vel") > 1, power()))
    c.jog(JOG_STOP, joints, 1)
    until(lambda s: hal.get_value("motion.current-vel") == 0)
    print("jog of", "joints" if joints else "axes", "M3 in force", s.spindle[0]["enabled"], "moves",
          any(m for m, _ in seen), "power", max(p for _, p in seen))
c.abort()
c.wait_complete()
print("after an abort:", power(), poll().spindle[0]["enabled"])
