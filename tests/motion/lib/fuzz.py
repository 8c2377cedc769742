# SPDX-License-Identifier: GPL-2.0-or-later
"""Random sequences of commands, overrides and inputs on a bench machine, under limitcheck.

fuzz(machine, seed) runs one sequence and returns a list of texts, empty when every
promise held: no joint over velocity, acceleration (and jerk where set) by more than
0.1 %, no position outside the limits by more than 1e-6, every stop reached, joint
positions consistent with feedback. The sequence depends on the seed alone.
"""

import random

import kerf_motion as km
from motion_bench import AXES, Machine


class Sequence:
    def __init__(self, machine, seed, extent=40.0, events=60, rotary=(), log=None,
                 trace=False):
        self.m, self.rng, self.extent, self.rotary = machine, random.Random(seed), extent, rotary
        self.events, self.log, self.trace = events, log, trace
        self.id = 0
        self.wheels = {}
        self.beyond = []

    def note(self, text):
        if self.log is not None:
            self.log.append(f"{self.m.now():.3f} {text}")

    def pose(self):
        out = [0.0] * 9
        for letter in self.m.axes:
            limit = 60.0 if letter in "abc" else self.extent
            out[AXES.index(letter)] = self.rng.uniform(-limit, limit)
        return out

    # ---- events: each does one thing now ----

    def mode(self):
        code = self.rng.choice([km.FREE, km.TELEOP, km.COORD, km.COORD])
        self.note(f"mode {code}")
        self.m.send(code)

    def queue_lines(self):
        for _ in range(self.rng.randint(1, 8)):
            self.id += 1
            v = self.rng.choice([self.rng.uniform(1, 50), 50.0])
            self.note("line")
            self.m.send(km.SET_LINE, pos=self.pose(), vel=v, ini_maxvel=max(v, self.m.path_vel),
                        acc=self.m.path_acc, ini_maxjerk=self.m.path_jerk, id=self.id,
                        motion_type=self.rng.choice([1, 2, 2]), turn=-1)

    def term(self):
        self.m.send(km.SET_TERM_COND, termCond=self.rng.choice([0, 1, 2, 2]), tolerance=self.rng.choice([0, 0.05, 1.0]))

    def jog(self):
        kind = self.rng.choice([km.JOG_CONT, km.JOG_CONT, km.JOG_INCR, km.JOG_ABS])
        vel = self.rng.choice([-1, 1]) * self.rng.choice([self.rng.uniform(0.1, 60), 1000])
        vel = max(-self.m.path_vel, min(self.m.path_vel, vel))
        offset = self.rng.uniform(-50, 50) if kind == km.JOG_ABS else self.rng.choice([0.01, 1, 10, 50])
        if self.m.status()["teleop"]:
            axis = AXES.index(self.rng.choice(self.m.axes))
            self.note(f"jog {kind} axis {axis} {vel:.3f} {offset:.3f}")
            self.m.send(kind, joint=-1, axis=axis, vel=vel, offset=offset)
        else:
            j = self.rng.randrange(self.m.joints)
            self.note(f"jog {kind} joint {j} {vel:.3f} {offset:.3f}")
            self.m.send(kind, joint=j, axis=-1, vel=vel, offset=offset)

    def jog_abort(self):
        self.note("jog abort")
        self.m.send(km.JOG_ABORT, joint=self.rng.randrange(self.m.joints),
                    axis=AXES.index(self.rng.choice(self.m.axes)))

    def wheel(self):
        pins = [f"joint.{j}" for j in range(self.m.joints)] + [f"axis.{a}" for a in self.m.axes]
        pin = self.rng.choice(pins)
        self.m.set(f"{pin}.jog-enable", self.rng.choice([0, 1, 1, 1]))
        self.m.set(f"{pin}.jog-vel-mode", self.rng.choice([0, 1]))
        self.m.set(f"{pin}.jog-scale", self.rng.choice([0.01, 0.1, 1.0, -0.1]))
        self.m.set(f"{pin}.jog-accel-fraction", self.rng.choice([1.0, 0.3, 0.0, 7.0]))
        for _ in range(self.rng.randint(1, 20)):
            self.wheels[pin] = self.wheels.get(pin, 0) + self.rng.choice([1, 1, 4, -1, -30, 30, 1000])
            self.m.set(f"{pin}.jog-counts", self.wheels[pin])
            self.m.sleep(self.rng.choice([0.001, 0.002, 0.01]))
        self.note(f"wheel {pin} {self.wheels[pin]}")

    def override(self):
        self.m.send(km.FEED_SCALE, scale=self.rng.choice([0, 0.1, 0.5, 1, 1, 1.5, 2]))
        self.m.send(km.RAPID_SCALE, scale=self.rng.choice([0, 0.25, 1, 1]))

    def hold(self):
        pin = self.rng.choice(["motion.feed-hold", "motion.feed-inhibit"])
        self.m.set(pin, 1)
        self.m.sleep(self.rng.uniform(0, 0.3))
        self.m.set(pin, 0)

    def adaptive(self):
        self.m.send(km.AF_ENABLE, flags=self.rng.choice([0, 1]))
        self.m.set("motion.adaptive-feed", self.rng.choice([1.0, 0.5, 0.0, -0.5, 2.0]))

    def pause(self):
        self.m.send(self.rng.choice([km.PAUSE, km.RESUME, km.RESUME, km.STEP]))

    def abort(self):
        self.note("abort")
        self.m.send(km.ABORT)

    def stop_pin(self):
        self.m.set("motion.jog-stop", 1)
        self.m.sleep(0.01)
        self.m.set("motion.jog-stop", 0)

    def inhibit(self):
        self.m.set("motion.jog-inhibit", 1)
        self.m.sleep(self.rng.uniform(0, 0.2))
        self.m.set("motion.jog-inhibit", 0)

    def switch_off(self):
        self.note("off")
        self.m.send(km.DISABLE)
        self.m.sleep(self.rng.uniform(0.001, 0.05))
        self.m.send(km.ABORT)
        self.m.enable()

    def fault(self):
        """An amplifier, the spindle, the enable input or a hard limit stops the machine; it is switched on again."""
        j = self.rng.randrange(self.m.joints)
        pin, bad = self.rng.choice([(f"joint.{j}.amp-fault-in", 1), ("spindle.0.amp-fault-in", 1),
                                    ("motion.enable", 0)])
        self.note(f"fault {pin}")
        self.m.set(pin, bad)
        self.m.sleep(self.rng.uniform(0.001, 0.02))
        self.m.set(pin, 1 - bad)
        self.m.enable()

    def limit(self):
        """A hard limit trips; sometimes it is overridden and the joint jogged."""
        j = self.rng.randrange(self.m.joints)
        pin = f"joint.{j}.{self.rng.choice(['pos', 'neg'])}-lim-sw-in"
        self.note(f"limit {pin}")
        self.m.set(pin, 1)
        self.m.sleep(self.rng.uniform(0.001, 0.1))
        if self.rng.random() < 0.5:
            self.m.send(km.OVERRIDE_LIMITS, joint=j)
            self.m.enable()
            for _ in range(self.rng.randint(1, 4)):
                self.jog()
                self.m.sleep(self.rng.uniform(0, 0.3))
        self.m.set(pin, 0)
        self.m.send(km.OVERRIDE_LIMITS, joint=-1)
        self.m.enable()

    def queue_arcs(self):
        """Arcs, helices and probe moves; what leaves the limits is refused."""
        for _ in range(self.rng.randint(1, 4)):
            self.id += 1
            end, centre = self.pose(), [self.rng.uniform(-20, 20) for _ in range(3)]
            self.note("arc")
            common = dict(pos=end, vel=self.rng.uniform(1, 50), ini_maxvel=self.m.path_vel, acc=self.m.path_acc,
                          ini_maxjerk=self.m.path_jerk, id=self.id)
            if self.rng.random() < 0.2:
                self.m.send(km.PROBE, motion_type=5, probe_type=self.rng.randrange(4), **common)
            else:
                self.m.send(km.SET_CIRCLE, center=centre, normal=[0, 0, 1], turn=self.rng.choice([-1, 0, 0, 1]),
                            motion_type=3, **common)

    def probe(self):
        self.m.set("motion.probe-input", 1)
        self.m.sleep(self.rng.uniform(0.001, 0.05))
        self.m.set("motion.probe-input", 0)

    def home(self):
        self.m.send(km.FREE)
        self.m.sleep(0.2)
        self.m.send(km.JOINT_HOME, joint=-1)
        self.m.sleep(self.rng.uniform(0.0, 0.5))

    def eoffset(self):
        letter = self.rng.choice(self.m.axes)
        pin = f"axis.{letter}"
        self.m.set(f"{pin}.eoffset-enable", self.rng.choice([0, 1, 1, 1]))
        self.m.set(f"{pin}.eoffset-scale", self.rng.choice([0.01, 0.1]))
        self.m.set(f"{pin}.eoffset-clear", self.rng.choice([0, 0, 0, 1]))
        key = pin + "e"
        self.wheels[key] = self.wheels.get(key, 0) + self.rng.choice([1, 10, -10, 200, -200])
        self.m.set(f"{pin}.eoffset-counts", self.wheels[key])

    def run(self, weights):
        names, counts = zip(*weights.items())
        for _ in range(self.events):
            name = self.rng.choices(names, counts)[0]
            getattr(self, name)()
            told = self.m.errors()
            self.beyond += [t.strip() for t in told if t.startswith("Exceeded")]
            if self.trace:
                s = self.m.status()
                self.note(f"after {name}: state {s['motion_state']} inpos {s['inpos']} depth {s['depth']} "
                          f"joints {[round(x, 4) for x in self.m.joints_at()]} {self.m.violations()} {told[-2:]}")
                if self.m.violations():
                    break
            self.m.sleep(self.rng.choice([0.0, 0.001, 0.003, 0.02, 0.1, 0.5]))
        return self.settle()

    def settle(self):
        """Everything released: the machine must come to rest."""
        problems = []
        for pin in ("motion.feed-hold", "motion.feed-inhibit", "motion.jog-inhibit", "motion.probe-input"):
            self.m.set(pin, 0)
        self.m.set("motion.adaptive-feed", 1.0)
        self.m.send(km.AF_ENABLE, flags=0)
        self.m.send(km.ABORT)
        self.m.send(km.FEED_SCALE, scale=1)
        self.m.send(km.RAPID_SCALE, scale=1)
        try:
            self.m.mode(km.FREE, 60)
            self.m.rest(60)
        except AssertionError as e:
            problems.append(f"no rest: {e}")
        before = self.m.joints_at()
        self.m.sleep(0.05)
        if self.m.joints_at() != before:
            problems.append("joints move at rest")
        for j in range(self.m.joints):
            error = abs(self.m.get(f"joint.{j}.f-error"))
            if error > 1e-9:
                problems.append(f"joint {j} position lost: {error}")
        told = self.m.errors()
        problems += self.m.violations() + self.beyond + [t.strip() for t in told if t.startswith("Exceeded")]
        return problems


WEIGHTS = dict(mode=8, queue_lines=10, term=3, jog=12, jog_abort=4, wheel=5, override=6, hold=4, adaptive=2, pause=4,
               abort=4, stop_pin=2, inhibit=2, switch_off=2, probe=1, home=1, fault=1, limit=1, queue_arcs=4)


JOG_WEIGHTS = {name: weight for name, weight in WEIGHTS.items() if not name.startswith("queue_")}


class Jogs(Sequence):
    """The same without coordinated mode."""

    def mode(self):
        code = self.rng.choice([km.FREE, km.TELEOP, km.TELEOP])
        self.note(f"mode {code}")
        self.m.send(code)


def machine(name, jerk=0.0, ratio=0.0):
    """One of the machines of the property tests: jerk limit (0 none), share of external offsets."""
    options = dict(jerk=jerk, eoffset_ratio=ratio, traj_jerk=jerk or 1e9)
    if name == "xyz":
        return Machine(**options)
    if name == "gantry":
        return Machine(joints=4, kins="trivkins coordinates=xyyz kinstype=both", axes="xyz",
                       home_params={1: dict(home_sequence=-1), 2: dict(home_sequence=-1)}, **options)
    if name == "delta":
        return Machine(kins="lineardeltakins", low=-1000, high=1000, **options)
    return Machine(joints=6, kins="5axiskins", axes="xyzbcw", **options)


def check(names, seeds, sequence, weights, jerks=(0.0, 5000.0), ratios=(0.0, 0.3), told=str, prepare=None):
    """Runs seeds on each machine; ends with what went wrong, in words of told(problem) that are not empty.
    prepare(machine): settings more."""
    for name, jerk, ratio in [(n, j, r) for n in names for j in jerks for r in ratios]:
        m = machine(name, jerk, ratio)
        if prepare:
            prepare(m)
        w = dict(weights, eoffset=10) if ratio else weights
        for seed in seeds:
            problems, _ = fuzz(m, seed, w, sequence)
            if any(told(p) for p in problems):
                raise SystemExit(f"{name} jerk {jerk} offsets {ratio}: {problems}")
        m.close()
        print(f"{name} jerk {jerk:g} offsets {ratio:g}: {len(seeds)} sequences within limits")


def fuzz(machine, seed, weights=None, sequence=Sequence, **options):
    machine.reset_limits()
    log = []
    problems = sequence(machine, seed, log=log, **options).run(weights or WEIGHTS)
    return [f"seed {seed}: {p}" for p in problems], log
