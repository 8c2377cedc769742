# SPDX-License-Identifier: GPL-2.0-or-later
"""Program moves through motmod on machines of several kinematics, with random overrides, holds,
pauses, steps, reversals and aborts: no joint over its velocity, acceleration or jerk by more than
0.1 % (limitcheck on motor-pos-cmd), every program ends where it should, no position is lost."""
import random
import sys

import kerf_motion as km
from motion_bench import AXES, Machine, finish

XYZ = dict(x=60, y=60, z=40)
bad = []


class Program:
    """Random moves on one machine. box: half widths around the middle, by axis."""

    def __init__(self, m, name, seed, middle, box, jerk):
        self.m, self.name, self.rng = m, f"{name} seed {seed}", random.Random(seed)
        self.middle, self.box, self.jerk = middle, box, jerk
        self.id, self.at, self.sent = 0, dict(middle), None

    def fail(self, text):
        bad.append(f"{self.name}: {text}")

    def pose(self, at):
        out = [0.0] * 9
        for letter, value in at.items():
            out[AXES.index(letter)] = value
        return out

    def queue(self, n):
        r = self.rng
        span = r.choice([1.0, 0.2, 0.02])
        self.m.send(km.SET_TERM_COND, termCond=r.choice([0, 1, 2, 2, 2]), tolerance=r.choice([0, 0.01, 0.5]))
        for _ in range(n):
            to = {a: self.middle[a] + max(-w, min(w, self.at[a] - self.middle[a] + r.uniform(-w, w) * span))
                  for a, w in self.box.items()}
            self.id += 1
            self.m.send(km.SET_LINE, pos=self.pose(to), vel=r.uniform(5, 120), ini_maxvel=150.0, acc=1500.0,
                        ini_maxjerk=self.jerk or 1e9, id=self.id, motion_type=r.choice([1, 2, 2, 2]), turn=-1)
            self.at = to

    def event(self):
        r, m = self.rng, self.m
        what = r.choice(["scale", "scale", "hold", "pause", "step", "reverse", "nothing", "abort"])
        if what == "scale":
            m.send(km.FEED_SCALE, scale=r.choice([0, 0.1, 0.5, 1, 2]))
            m.send(km.RAPID_SCALE, scale=r.choice([0.25, 1]))
        elif what == "hold":
            m.set("motion.feed-hold", 1)
            m.sleep(r.uniform(0, 0.2))
            m.set("motion.feed-hold", 0)
        elif what == "pause":
            m.send(km.PAUSE)
            m.sleep(r.uniform(0, 0.3))
            m.send(km.RESUME)
        elif what == "step":
            m.send(km.PAUSE)
            m.sleep(0.3)
            m.send(km.STEP)
            m.sleep(r.uniform(0, 0.3))
            m.send(km.RESUME)
        elif what == "reverse":
            m.send(km.AF_ENABLE, flags=1)
            m.set("motion.adaptive-feed", -0.7)
            m.sleep(r.uniform(0.1, 0.5))
            m.set("motion.adaptive-feed", 1.0)
        elif what == "abort" and r.random() < 0.3:
            m.send(km.ABORT)
            m.rest(30)
            p = m.status()["carte_pos_cmd"]
            self.at = {a: p[AXES.index(a)] for a in self.box}

    def run(self):
        m = self.m
        m.reset_limits()
        m.errors()
        for _ in range(6):
            self.queue(self.rng.randint(2, 8))
            for _ in range(self.rng.randint(0, 4)):
                m.sleep(self.rng.choice([0.0, 0.02, 0.2]))
                self.event()
        m.set("motion.feed-hold", 0)
        m.set("motion.adaptive-feed", 1.0)
        m.send(km.AF_ENABLE, flags=0)
        m.send(km.FEED_SCALE, scale=1)
        m.send(km.RAPID_SCALE, scale=1)
        m.send(km.RESUME)
        m.rest(600)
        p = m.status()["carte_pos_cmd"]
        off = max(abs(p[AXES.index(a)] - v) for a, v in self.at.items())
        if off > 1e-6:
            self.fail(f"ends {off:g} from where it should")
        for text in m.violations() + m.errors():
            self.fail(text)


def try_machine(name, kins, start, middle, box, seeds, jerks=(0.0, 30000.0), axes="xyz", setp=(), **limits):
    for jerk in jerks:
        m = Machine(joints=len(start), kins=kins, axes=axes, low=-1e4, high=1e4, kins_setup=setp, home=False,
                    home_params={j: dict(offset=q, home=q) for j, q in enumerate(start)}, jerk=jerk,
                    axis_vel=[150.0] * len(axes), axis_acc=[1500.0] * len(axes), **limits)
        m.send(km.SET_WORLD_HOME, pos=[0.0] * 9)
        m.enable()
        m.home()
        m.mode(km.COORD)
        m.line(*Program(m, name, 0, middle, box, jerk).pose(middle), vel=50.0, max_vel=50.0, acc=500.0)
        m.rest()
        for seed in seeds:
            Program(m, f"{name} jerk {jerk:g}", seed, middle, box, jerk).run()
            m.mode(km.COORD)
        m.close()


seeds = range(1, 1 + int(sys.argv[1]) if len(sys.argv) > 1 else 3)
origin = dict(x=0, y=0, z=0)
try_machine("gantry", "trivkins coordinates=xyyz kinstype=both", [0.0] * 4, origin, XYZ, seeds,
            vel=[100.0, 80.0, 60.0, 50.0], acc=[800.0, 1000.0, 600.0, 500.0])
try_machine("corexy", "corexykins", [0.0] * 3, origin, XYZ, seeds, vel=[100.0, 80.0, 60.0], acc=[900.0, 700.0, 500.0])
try_machine("delta", "lineardeltakins", [235.0] * 3, origin, XYZ, seeds, vel=[90.0, 100.0, 80.0],
            acc=[700.0, 900.0, 800.0])
try_machine("five-axis", "xyzac-trt-kins", [0.0] * 5, dict(x=10, y=5, z=-20, a=0, c=0),
            dict(x=60, y=60, z=40, a=50, c=120), seeds, axes="xyzac", vel=[100.0, 90.0, 80.0, 60.0, 70.0],
            acc=[800.0, 700.0, 900.0, 500.0, 600.0])
for text in bad:
    print(text)
finish("ok" if not bad else "FAIL")
