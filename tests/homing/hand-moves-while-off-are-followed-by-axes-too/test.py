# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-057 with kinematics: slides of a delta, of a five-axis mill and of a gantry are pushed while the
machine is off, in each mode. The next machine-on neither jumps nor fails, axes and joints agree, and a
move from there goes where it should."""
import random

import kerf_motion as km
from rig import Report, Rig

r = Report()
MACHINES = [
    ("lineardeltakins", 3, "xyz", [235.0] * 3, 15.0),
    ("xyzac-trt-kins", 5, "xyzac", [1.0, 2.0, 3.0, 10.0, 20.0], 30.0),
    ("trivkins coordinates=xyyz kinstype=both", 4, "xyz", [0.0] * 4, 0.8),
]
for kins, joints, axes, start, extent in MACHINES:
    m = Rig(joints, kins=kins, axes=axes, low=-1000.0, high=1000.0,
            home={j: dict(offset=q, home=q) for j, q in enumerate(start)})
    m.enable()
    seen, ok = m.run_home()
    r.check(ok, f"{kins}: not homed")
    rng = random.Random(7)
    for mode in (km.FREE, km.TELEOP, km.COORD):
        m.mode(mode)
        for n in range(4):
            m.disable()
            for j in range(joints):
                m.hw(j, hand_vel=rng.uniform(-extent, extent) / 0.05)
            m.sleep(0.05)
            for j in range(joints):
                m.hw(j, hand_vel=0)
            m.sleep(0.005)
            where = [m.at(j) for j in range(joints)]
            m.errors()
            m.reset_limits()
            m.enable()
            m.sleep(1.0)
            name = f"{kins.split()[0]} mode {mode} push {n}"
            told = m.errors()
            s = m.status()
            r.check(s["enabled"] and not told, f"{name}: {told}")
            if "xyyz" not in kins:  # a racked gantry is brought square within limits
                moved = max(abs(m.at(j) - where[j]) for j in range(joints))
                r.check(moved < 1e-6, f"{name}: jumps by {moved}")
            r.check(not m.violations(), f"{name}: {m.violations()}")
            back = [a - b for a, b in zip([m.get(f"joint.{j}.pos-cmd") for j in range(joints)],
                                          [m.get(f"joint.{j}.pos-fb") for j in range(joints)])]
            r.check(max(map(abs, back)) < 1e-9, f"{name}: command and feedback differ by {back}")
        if mode == km.COORD:
            target = list(m.status()["carte_pos_cmd"])
            target[0] += 3
            m.line(*target, vel=20)
            m.rest()
            end = m.status()["carte_pos_cmd"]
            r.check(max(abs(a - b) for a, b in zip(target, end)) < 1e-6 and not m.errors(),
                    f"{kins}: then moves to {end}")
    m.close()
r.finish()
