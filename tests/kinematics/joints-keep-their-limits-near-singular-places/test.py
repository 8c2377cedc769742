# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-091: programs whose axes ask for more than the joints can give, near the centres of rotary tables,
the edge of deltas, the shoulder and the wrist of arms: joints keep their limits of speed and
acceleration, nothing stops with a following error, every program ends at its end. Lines and arcs that
would take a joint out of its range on the way are refused, the others stay inside."""
import random

import kerf_motion as km
from motion_bench import AXES, Machine

bad = []


def program(title, kins, axes, start, box, vel, acc, path_vel, path_acc, setp=(), seed=(0,) * 9, moves=12, seeds=2,
            tolerance=0.05):
    """box: range of each axis letter, absolute, or relative to the pose of the start when its value is one number."""
    m = Machine(joints=len(start), axes=axes, kins=kins, vel=vel, acc=acc, low=-1e5, high=1e5,
                kins_setup=setp, home=False, home_params={j: dict(offset=q, home=q) for j, q in enumerate(start)},
                ferror=0.05)
    m.send(km.SET_WORLD_HOME, pos=seed)
    m.enable()
    m.home()
    m.mode(km.COORD)
    m.sleep(0.02)
    first = list(m.status()["carte_pos_cmd"])
    m.send(km.SET_TERM_COND, termCond=2, tolerance=tolerance)
    m.errors()
    for s in range(seeds):
        rng = random.Random(s)
        m.reset_limits()
        for n in range(moves):
            pose = list(first)
            for letter, r in box.items():
                at = AXES.index(letter)
                pose[at] = rng.uniform(*r) if isinstance(r, tuple) else first[at] + rng.uniform(-r, r)
            while m.status()["queueFull"]:
                m.sleep(0.05)
            m.send(km.SET_LINE, pos=pose, vel=path_vel, ini_maxvel=path_vel, acc=path_acc, ini_maxjerk=1e9, id=n + 1,
                   motion_type=rng.choice([1, 2]), turn=-1)
        name = f"{title} seed {s}"
        try:
            m.rest(300)
        except AssertionError as e:
            bad.append(f"{name}: {e}")
        told, end = m.errors(), m.status()["carte_pos_cmd"]
        if told or not m.status()["enabled"]:
            bad.append(f"{name}: {told}")
        elif max(abs(a - b) for a, b in zip(pose, end)) > 1e-6:
            bad.append(f"{name}: ends at {end}")
        if m.violations():
            bad.append(f"{name}: {m.violations()}")
        if told:
            break
    m.close()


program("table-table through the centre", "xyzac-trt-kins", "xyzac", [10.0, 5.0, 20.0, 0.0, 0.0],
        dict(x=(-5, 5), y=(-5, 5), z=(10, 30), a=(-60, 60), c=(-400, 400)), [50, 50, 50, 60, 90],
        [500, 500, 500, 400, 700], 200.0, 4000.0, ["setp xyzac-trt-kins.z-rot-point -30"])
program("tilting head", "5axiskins", "xyzbcw", [0.0, 0.0, 100.0, 0.0, 0.0, 0.0],
        dict(x=(-50, 50), y=(-50, 50), z=(80, 120), b=(-80, 80), c=(-300, 300), w=(-5, 5)), [150, 150, 100, 60, 90, 30],
        [1200, 1200, 800, 400, 700, 300], 300.0, 5000.0)
program("linear delta near its edge", "lineardeltakins", "xyz", [235.0] * 3,
        dict(x=(-60, 60), y=(-125, -95), z=(-20, 20)), 200.0, 2000.0, 400.0, 8000.0)
program("rotary delta", "rotarydeltakins", "xyz", [10.0] * 3, dict(x=(-3, 3), y=(-3, 3), z=(-18, -10)), 200.0,
        3000.0, 100.0, 5000.0)
program("scara near its reach", "scarakins", "xyzabc", [30.0, 60.0, 0.0, 0.0, 0.0, 0.0],
        dict(x=(380, 560), y=(0, 80), z=(380, 420), c=(0, 90)), 180.0, 1200.0, 500.0, 5000.0, ["setp scarakins.D6 0"])
program("arm with its wrist nearly straight", "pumakins", "xyzabc", [20.0, -50.0, 20.0, 10.0, 12.0, 15.0],
        dict(x=30.0, y=30.0, z=30.0, a=3.0, b=3.0, c=3.0), 180.0, 1200.0, 500.0, 5000.0)
program("general arm", "genserkins", "xyzabcuvw", [20.0, -30.0, 60.0, 10.0, 40.0, 15.0, 0, 0, 0],
        dict(x=20.0, y=20.0, z=20.0, a=5.0, u=(-5, 5)), 180.0, 1200.0, 500.0, 5000.0, moves=10, seeds=2)
program("hexapod", "genhexkins", "xyzabc", [34.0] * 6,
        dict(x=(-3, 3), y=(-3, 3), z=1.0, a=(-10, 10), b=(-10, 10), c=(-10, 10)),
        15.0, 150.0, 60.0, 1000.0, seed=(0, 0, 30, 0, 0, 0), tolerance=0.005)


def ranges(title, kins, axes, start, box, low, high, arcs=False, setp=(), moves=60):
    """Single moves on a machine whose joints' ranges are narrow; both endings have to occur."""
    m = Machine(joints=len(start), axes=axes, kins=kins, vel=400.0, acc=20000.0, low=low, high=high, kins_setup=setp,
                home_params={j: dict(offset=q, home=q) for j, q in enumerate(start)})
    for letter in axes:
        m.send(km.SET_AXIS_POSITION_LIMITS, axis=AXES.index(letter), minLimit=-1e5, maxLimit=1e5)
    m.mode(km.COORD)
    m.sleep(0.02)
    rng, ended, refused = random.Random(1), 0, 0
    for n in range(moves):
        here = list(m.status()["carte_pos_cmd"])
        pose = list(here)
        for letter, r in box.items():
            pose[AXES.index(letter)] = rng.uniform(*r)
        arc = arcs and n % 2
        center = [(here[0] + pose[0]) / 2, (here[1] + pose[1]) / 2, pose[2]]
        m.send(km.SET_CIRCLE if arc else km.SET_LINE, pos=pose, center=center, normal=[0, 0, 1], vel=300,
               ini_maxvel=300, acc=5000, ini_maxjerk=1e9, id=n + 1, motion_type=3 if arc else 2, turn=0 if arc else -1)
        m.sleep(0.002)
        if m.status()["commandStatus"]:
            told = m.errors()
            refused += 1
            if not any("would exceed joint" in t for t in told) or not m.status()["enabled"]:
                bad.append(f"{title}: move {n} refused for {told}")
            m.send(km.ABORT)
            continue
        ended += 1
        while not (m.status()["inpos"] and m.status()["depth"] == 0):
            m.sleep(0.004)
            for j, q in enumerate(m.joints_at()):
                if not m.per(low, j) - 1e-6 <= q <= m.per(high, j) + 1e-6:
                    bad.append(f"{title}: move {n} takes joint {j} to {q}")
        if told := m.errors():
            bad.append(f"{title}: move {n}: {told}")
        if len(bad) > 5:
            break
    if min(ended, refused) < moves // 6:
        bad.append(f"{title}: {ended} moves ended, {refused} were refused")
    m.close()


ranges("table-table", "xyzac-trt-kins", "xyzac", [10.0, 5.0, 20.0, 0.0, 0.0],
       dict(x=(-40, 40), y=(-40, 40), z=(10, 30), a=(-60, 60), c=(-200, 200)), [-45, -45, -10, -90, -1e4],
       [45, 45, 60, 90, 1e4], arcs=True, setp=["setp xyzac-trt-kins.z-rot-point -30"])
ranges("linear delta", "lineardeltakins", "xyz", [235.0] * 3, dict(x=(-60, 60), y=(-60, 60), z=(-40, 20)), 190.0,
       300.0, arcs=True)
print("\n".join(b[:300] for b in bad[:16]) if bad else "limits hold")
