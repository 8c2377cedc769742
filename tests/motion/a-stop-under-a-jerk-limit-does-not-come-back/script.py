# SPDX-License-Identifier: GPL-2.0-or-later
# A jog that is released goes to where it can stop and no way back, also while it brakes for a lower speed that
# it was given; a jog that only slows down gets no slower than that.
import random

import kerf_motion as km
from motion_bench import Machine, eq

m = Machine(joints=3, vel=60.0, acc=[600.0, 300.0, 60.0], jerk=[8000.0, 3000.0, 300.0], low=-1000, high=1000, traj_jerk=8000.0)
rng = random.Random(1)
for n in range(24):
    teleop, j = n % 2, n % 3
    m.mode(km.TELEOP if teleop else km.FREE)
    which = dict(joint=-1, axis=j) if teleop else dict(joint=j, axis=-1)
    speed, sign = rng.uniform(2, 60), rng.choice([-1, 1])
    m.send(km.JOG_CONT, vel=sign * speed, **which)
    m.sleep(rng.uniform(0.01, 1.5) if n % 8 != 3 else 3)
    lowered = n % 4 >= 2
    if lowered:
        m.send(km.JOG_CONT, vel=sign * 0.3 * speed, **which)
        if n % 8 == 3:  # slows down only
            v = m.get(f"joint.{j}.vel-cmd") * sign
            while v > 0.3 * speed * 1.0001:
                m.sleep(0.001)
                v = m.get(f"joint.{j}.vel-cmd") * sign
            slowest = v
            for _ in range(300):
                m.sleep(0.001)
                slowest = min(slowest, m.get(f"joint.{j}.vel-cmd") * sign)
            eq(slowest >= 0.2999 * speed, True, f"jog {n}: {slowest} of {0.3 * speed}")
        else:
            m.sleep(rng.uniform(0.001, 0.1))
    m.send(km.JOG_ABORT, **which)
    farthest, at = -1e9, 0.0
    for _ in range(4000):
        m.sleep(0.001)
        at = m.get(f"joint.{j}.pos-cmd") * sign
        farthest = max(farthest, at)
        if m.get(f"joint.{j}.in-position") and m.get(f"joint.{j}.vel-cmd") == 0:
            break
    eq(farthest - at < 1e-5, True, f"jog {n} of {'axis' if teleop else 'joint'} {j}: {farthest - at} back")
    eq(m.violations(), [], f"jog {n}")
m.close()
print("stops come to rest without a way back")
