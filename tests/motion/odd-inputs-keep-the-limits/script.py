# Random sequences with inputs that no sound machine gives: wheels whose counts jump and wrap, scales that change in
# mid-jog or are no numbers, adaptive feeds that go negative and are no numbers, a feed hold in a probe move, an index
# that is never answered, a limit switch in homing, five axes jogged with the tool tilted.
import sys

import kerf_motion as km
from fuzz import WEIGHTS, Sequence, check

ODD = (float("nan"), float("inf"), -float("inf"), 1e300, -1e300)


class Odd(Sequence):
    def wheel(self):
        """Counts that jump and wrap; the scale changes while the wheel's jog goes on."""
        pin = self.rng.choice([f"joint.{j}" for j in range(self.m.joints)] + [f"axis.{a}" for a in self.m.axes])
        self.m.set(f"{pin}.jog-enable", 1)
        self.m.set(f"{pin}.jog-vel-mode", self.rng.choice([0, 1]))
        self.m.set(f"{pin}.jog-accel-fraction", self.rng.choice([1.0, 0.01, -1.0, float("nan")]))
        for _ in range(self.rng.randint(2, 12)):
            self.m.set(f"{pin}.jog-scale", self.rng.choice([0.01, -0.01, 1.0, 0.0, -100.0, self.rng.choice(ODD)]))
            counts = self.wheels.get(pin, 0) + self.rng.choice([1, -1, 7, -2000, 2 ** 31 - 1, -2 ** 31, 2 ** 30])
            self.wheels[pin] = (counts + 2 ** 31) % 2 ** 32 - 2 ** 31
            self.m.set(f"{pin}.jog-counts", self.wheels[pin])
            self.m.sleep(self.rng.choice([0.001, 0.002, 0.01, 0.05]))
        self.m.set(f"{pin}.jog-scale", 0.01)

    def adaptive(self):
        self.m.send(km.AF_ENABLE, flags=1)
        for _ in range(self.rng.randint(1, 6)):
            self.m.set("motion.adaptive-feed", self.rng.choice([-1.0, -0.2, 0.0, 1.0, 3.0, self.rng.choice(ODD)]))
            self.m.sleep(self.rng.choice([0.001, 0.01, 0.2]))
        self.m.set("motion.adaptive-feed", 1.0)

    def probe(self):
        """Held in the move, tripped while it is held or brakes."""
        self.m.send(km.PROBE, pos=self.pose(), vel=self.rng.uniform(1, 30), ini_maxvel=self.m.path_vel,
                    acc=self.m.path_acc, ini_maxjerk=self.m.path_jerk, id=self.id, motion_type=5,
                    probe_type=self.rng.randrange(4))
        self.m.sleep(self.rng.uniform(0, 0.3))
        self.m.set("motion.feed-hold", 1)
        self.m.sleep(self.rng.uniform(0, 0.1))
        super().probe()
        self.m.set("motion.feed-hold", 0)

    def sync(self):
        """A move that waits for an index which does not come, or comes from a count that jumps."""
        self.m.send(km.SET_SPINDLESYNC, spindle=0, spindlesync=self.rng.choice([1.0, -1.0, 50.0]), flags=0)
        self.queue_lines()
        self.m.send(km.SET_SPINDLESYNC, spindle=0, spindlesync=0, flags=0)
        self.m.sleep(self.rng.uniform(0, 0.3))
        self.m.set("spindle.0.revs", self.rng.choice([0.0, 1.5, 1e9, self.rng.choice(ODD)]))
        if self.rng.random() < 0.5:
            self.m.set("spindle.0.index-enable", 0)
            for n in range(self.rng.randint(0, 60)):
                self.m.set("spindle.0.revs", 0.01 * n * self.rng.choice([1, 1, 1, 30]))
                self.m.sleep(0.001)
        self.m.send(km.ABORT)

    def home(self):
        """With a limit switch that trips meanwhile."""
        super().home()
        j = self.rng.randrange(self.m.joints)
        pin = f"joint.{j}.{self.rng.choice(['pos', 'neg'])}-lim-sw-in"
        self.m.set(pin, 1)
        self.m.sleep(self.rng.uniform(0.001, 0.3))
        self.m.set(pin, 0)
        self.m.enable()
        if not all(self.m.status()["joint"][k]["homed"] for k in range(self.m.joints)):
            self.m.send(km.ABORT)
            self.m.mode(km.FREE)
            self.m.home()

    def tilt(self):
        """Five axes: the tool is tilted, then jogged."""
        self.m.send(km.TELEOP)
        self.m.sleep(0.3)
        for letter in self.m.axes:
            self.m.send(km.JOG_INCR, joint=-1, axis="xyzabcuvw".index(letter), vel=self.rng.choice([-50.0, 20.0, 50.0]),
                        offset=self.rng.choice([3, 30]))
        self.m.sleep(self.rng.uniform(0, 1))


weights = dict(WEIGHTS, wheel=12, adaptive=8, probe=8, sync=6, home=3, tilt=6)
if len(sys.argv) > 1:
    first, last = (int(word) for word in sys.argv[1].split("-"))
    check(("xyz", "gantry", "delta", "five"), range(first, last + 1), Odd, weights, ratios=(0.0,))
else:
    check(("xyz", "gantry", "delta"), range(2), Odd, weights, ratios=(0.0,))
    # the last one turns its joints round at a limit
    check(("five",), range(4, 17), Odd, weights, jerks=(0.0,), ratios=(0.0,))
