# SPDX-License-Identifier: GPL-2.0-or-later
"""Property test (FP-036 with a jerk limit): machines with random homing settings, places, switches that bounce and
read wrongly, play in the drives, with and without a jerk limit. No motor goes beyond its limits of speed, acceleration
and jerk; homing ends; it ends homed with the right zero when the hardware is good, else homed or with a message; an
abort at a random time stops everything."""
import random

import kerf_motion as km
from rig import IGNORE_LIMITS, IS_SHARED, USE_INDEX, Report, Rig

r = Report()
SEEDS, N = 24, 3
for jerk in (0.0, 8000.0):
    vel, acc = 60.0, 600.0
    m = Rig(N, low=-150.0, high=150.0, vel=vel, acc=acc, jerk=jerk, traj_jerk=jerk or 1e9, ferror=20.0)
    m.enable()
    for seed in range(SEEDS):
        rng = random.Random(seed)
        for j in range(N):
            m.hw(j, pos_lim_at=1e9, neg_lim_at=-1e9, noise=0)
        m.sleep(0.01)
        m.enable()
        m.unhome()
        gaps = random.Random(seed * 7 + 1)
        for j in range(N):
            gap = gaps.choice([0, 0, 0.01, 0.1, 0.5, 1.0])
            m.hw(j, backlash=gap)
            m.send(km.SET_JOINT_BACKLASH, joint=j, backlash=gap)
        groups = rng.choice([(0, 1, 2), (0, 0, 0), (1, 1, 1), (0, -1, -1), (-1, -1, -1), (1, 0, 1)])
        noisy = rng.random() < 0.3
        zero, home = [], []
        for j in range(N):
            kind = rng.choice(["switch", "switch", "switch", "index", "both", "at once"])
            if groups[j] < 0:
                kind = "switch"
            sign = rng.choice([-1, 1])
            at, pitch = sign * rng.uniform(10, 40), rng.uniform(2, 8)
            latch = rng.choice([-1, 1]) * rng.uniform(1, 4)
            p = dict(home_sequence=groups[j], offset=rng.uniform(-30, 30), home_final_vel=rng.choice([-1, 0, 5, 500]))
            p["home"] = p["offset"] + rng.uniform(-10, 10)
            hw = dict(home_from=1e9, home_to=1e9, index_pitch=0,
                      bounce_ms=rng.choice([0, 0, 5]) if kind == "switch" else 0,
                      hysteresis=0.02, noise=rng.choice([0.002, 0.05]) if noisy else 0, pos_lim_at=1e9, neg_lim_at=-1e9)
            start = rng.uniform(-30, 30)
            flags = 0
            if kind in ("switch", "both"):
                p.update(search_vel=sign * rng.uniform(5, 80), latch_vel=latch)
                hw.update(home_from=at if sign > 0 else -1e9, home_to=1e9 if sign > 0 else at)
                if rng.random() < 0.3 and not noisy:
                    flags |= IGNORE_LIMITS
                    hw.update({"pos_lim_at" if sign > 0 else "neg_lim_at": at})
                    start = 0.0
                elif rng.random() < 0.2 and abs(start) < 9:
                    flags |= IS_SHARED
            if kind in ("index", "both"):
                p.update(latch_vel=latch)
                hw.update(index_pitch=pitch, index_at=rng.uniform(0, pitch))
                flags |= USE_INDEX
            p["flags"] = flags
            m.place(j, start)
            m.hw(j, **hw)
            m.set_home(j, **p)
            zero.append(at - p["offset"] if kind == "switch" and not noisy else None)
            home.append(p["home"])
        m.sleep(0.02)
        m.reset_limits()
        m.errors()
        name = f"jerk {jerk} seed {seed}"
        abort = rng.uniform(0, 4) if rng.random() < 0.3 else None
        if abort is None:
            seen, ok = m.run_home(-1, 120)
            m.sleep(0.4)  # the last of the backlash
            told = m.errors()
            r.check(not m.homing(), f"{name}: does not end")
            r.check(ok or (noisy and told), f"{name}: not homed, {told}")
            for j in range(N):
                if ok:
                    r.near(m.get(f"joint.{j}.pos-cmd"), home[j], f"{name}: joint {j} home")
                if ok and zero[j] is not None:
                    r.near(m.at(j) - m.get(f"joint.{j}.pos-cmd"), zero[j], f"{name}: joint {j} zero", 0.06)
        else:
            m.ask_home()
            m.sleep(abort)
            m.send(km.ABORT)
            m.sleep(0.5)
            r.check(not m.homing() and all(m.get(f"joint.{j}.vel-cmd") == 0 for j in range(N)), f"{name}: abort")
        r.check(not m.violations(), f"{name}: {m.violations()}")
    m.close()
r.finish()
