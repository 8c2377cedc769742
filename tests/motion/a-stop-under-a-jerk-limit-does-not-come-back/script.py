# SPDX-License-Identifier: GPL-2.0-or-later
# A jog that is released goes to where it can stop and no way back, also while it brakes for a lower speed that
# it was given; a jog that only slows down gets no slower than that. One that is released while it turns round, its
# brake higher than its speed needs, lets the brake off: it rests as soon as the jerk limit allows.
import math
import random

import kerf_motion as km
from motion_bench import Machine, eq

m = Machine(joints=3, vel=60.0, acc=[600.0, 300.0, 60.0], jerk=[8000.0, 3000.0, 300.0], low=-1000, high=1000,
            traj_jerk=8000.0)
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
LIMITS = ((600.0, 6400.0), (300.0, 2400.0), (60.0, 240.0))      # stops are planned with 0.8 of the jerk
turned = 0
for n in range(40):
    j, sign = n % 3, rng.choice([-1, 1])
    acc, jerk = LIMITS[j]
    m.mode(km.FREE)
    m.send(km.JOG_CONT, vel=sign * rng.uniform(5, 60), joint=j, axis=-1)
    m.sleep(rng.uniform(0.1, 0.6))
    m.send(km.JOG_CONT, vel=-sign * 60, joint=j, axis=-1)
    v, a = m.get(f"joint.{j}.vel-cmd"), 0.0
    for _ in range(3000):                       # until the brake is to turn it round, shortly before it does
        m.sleep(0.001)
        before, v = v, m.get(f"joint.{j}.vel-cmd")
        a = (v - before) / 0.001
        if v * sign > 0 > a * sign and 0.5 * a * a / jerk > abs(v) * rng.uniform(1.1, 3):
            break
    if not v * sign > 0:
        continue
    turned += 1
    m.send(km.JOG_ABORT, joint=j, axis=-1)
    side = math.copysign(1, v + a * abs(a) / (2 * jerk))
    peak = math.sqrt(jerk * v * side + 0.5 * a * a)
    soonest, began = (a * side + 2 * peak) / jerk, m.now()
    m.wait(lambda s: m.get(f"joint.{j}.vel-cmd") == 0 and s["inpos"], "rest")
    eq(m.now() - began < 1.1 * soonest + 0.01, True,
       f"joint {j} rests {m.now() - began} s after {v} {a}, not {soonest}")
    eq(m.violations(), [], f"turn {n}")
eq(turned > 20, True, turned)
m.close()
print("stops come to rest without a way back")
