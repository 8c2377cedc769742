# SPDX-License-Identifier: GPL-2.0-or-later
"""A bench machine whose joints are sim_joint components, for tests of homing.

Rig(joints, home={j: {...}}, hw={j: {...}}): home are the homing parameters of a joint (names
of motion's command), hw pins and parameters of its sim-joint. Limits are checked on the true
positions of the motors, which no change of coordinates touches. Units: machine units, s.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "motion", "lib"))
import kerf_motion as km  # noqa: E402
from motion_bench import Machine  # noqa: E402

IGNORE_LIMITS, USE_INDEX, IS_SHARED, UNLOCK_FIRST = 1, 2, 4, 8
ABSOLUTE, NO_REHOME, NO_FINAL_MOVE, NO_ENCODER_RESET = 16, 32, 64, 128

STATES = ("IDLE START UNLOCK UNLOCK_WAIT BACKOFF_START BACKOFF_WAIT SEARCH_START SEARCH_WAIT COARSE "
          "FINAL_BACKOFF_START FINAL_BACKOFF_WAIT RISE_START RISE_WAIT FALL_START FALL_WAIT SWITCH_POSITION "
          "INDEX_ONLY_START INDEX_START INDEX_WAIT INDEX_POSITION FINAL_START FINAL_WAIT LOCK LOCK_WAIT "
          "FINISHED ABORT").split()


class Rig(Machine):
    def __init__(self, joints=1, home=None, hw=None, axes=None, vel=50.0, acc=500.0, hal_lines=(), kins=None, motmod="",
                 check=True, homemod="homemod", **options):
        axes = axes or "xyzabcuvw"[:joints]
        lines = [f"loadrt sim_joint count={joints}"]
        for j in range(joints):
            lines += [f"addf sim-joint.{j}.read servo-thread 1", f"unlinkp limitcheck.{j}.pos-cmd",
                      f"net at{j} sim-joint.{j}.motor-position => limitcheck.{j}.pos-cmd",
                      f"net cmd{j} => sim-joint.{j}.cmd", f"net amp{j} => sim-joint.{j}.enable",
                      f"net fb{j} sim-joint.{j}.fb => joint.{j}.motor-pos-fb",
                      f"net home{j} sim-joint.{j}.home-sw => joint.{j}.home-sw-in",
                      f"net neg{j} sim-joint.{j}.neg-lim-sw => joint.{j}.neg-lim-sw-in",
                      f"net pos{j} sim-joint.{j}.pos-lim-sw => joint.{j}.pos-lim-sw-in",
                      f"net index{j} sim-joint.{j}.index-enable joint.{j}.index-enable"]
            for name, value in (hw or {}).get(j, (hw or {}).get("all", {})).items():
                lines.append(f"setp sim-joint.{j}.{name.replace('_', '-')} {value}")
        lines += list(hal_lines)
        for j in range(joints):
            lines.append(f"addf sim-joint.{j}.write servo-thread")
            lines.append(f"delf limitcheck.{j} servo-thread")
            lines.append(f"addf limitcheck.{j} servo-thread")
        self.params = {j: (home or {}).get(j, (home or {}).get("all", {})) for j in range(joints)}
        super().__init__(joints=joints, kins=kins or f"trivkins coordinates={axes}", axes=axes, vel=vel, acc=acc,
                         hal_lines=lines, loop=False, home=False, home_params=self.params, check=check,
                         motmod=motmod, homemod=homemod, **options)
        self.sleep(0.01)

    def set_home(self, joint, **params):
        """Other homing parameters; those not named have their default."""
        full = dict(offset=0.0, home=0.0, home_final_vel=-1.0, search_vel=0.0, latch_vel=0.0, flags=0,
                    home_sequence=0, volatile_home=0)
        full.update(params)
        self.send(km.SET_JOINT_HOMING_PARAMS, joint=joint, **full)

    def hw(self, joint, **pins):
        for name, value in pins.items():
            self.set(f"sim-joint.{joint}.{name.replace('_', '-')}", value)

    def at(self, joint):
        """Where the slide truly is."""
        return self.get(f"sim-joint.{joint}.position")

    def state(self, joint):
        return STATES[self.get(f"joint.{joint}.home-state")]

    def homed(self, joint=None):
        joints = range(self.joints) if joint is None else [joint]
        return all(self.get(f"joint.{j}.homed") for j in joints)

    def homing(self):
        return any(self.get(f"joint.{j}.homing") for j in range(self.joints))

    def ask_home(self, joint=-1):
        self.send(km.JOINT_HOME, joint=joint)

    def run_home(self, joint=-1, timeout=60.0, watch=None):
        """Homes and follows the states: returns {joint: [state, ...]} and whether it ended homed.
        watch(self) is called every cycle."""
        self.ask_home(joint)
        seen = {j: [] for j in range(self.joints)}
        end = self.now() + timeout
        started = False
        while self.now() < end:
            for j in range(self.joints):
                s = self.state(j)
                if not seen[j] or seen[j][-1] != s:
                    seen[j].append(s)
            if watch:
                watch(self)
            active = self.homing() or any(self.state(j) != "IDLE" for j in range(self.joints))
            if started and not active:
                break
            started = started or active
            if not started and self.now() > end - timeout + 0.02:
                break
            self.sleep(0.001)
        self.sleep(0.005)
        self.wait(lambda s: s["inpos"], "at rest after homing")
        for j in seen:
            seen[j] = [s for i, s in enumerate(seen[j]) if i == 0 or seen[j][i - 1] != s]
        return seen, self.homed(None if joint < 0 else joint)

    def until(self, condition, what, timeout=30.0):
        """Waits for something that pins show; cheaper than wait, which reads the whole status."""
        end = self.now() + timeout
        while not condition():
            if self.now() > end:
                raise AssertionError(f"not {what} after {timeout} s: {self.errors()}")
            self.sleep(0.001)

    def free(self):
        if self.status()["motion_state"] > 1:
            self.mode(km.FREE)

    def unhome(self, joint=-1):
        self.free()
        self.send(km.JOINT_UNHOME, joint=joint)
        self.sleep(0.003)

    def place(self, joint, where):
        """The slide is moved by hand, while off."""
        self.disable()
        self.set(f"sim-joint.{joint}.hand-vel", (where - self.at(joint)) / 0.1)
        self.sleep(0.1)
        self.set(f"sim-joint.{joint}.hand-vel", 0)
        self.sleep(0.01)
        self.reset_limits()
        self.enable()


class Report:
    """Collects what was wrong; finish() prints it and the count of checks."""

    def __init__(self):
        self.checks = 0
        self.bad = []

    def check(self, ok, text):
        self.checks += 1
        if not ok:
            self.bad.append(text)

    def near(self, value, wanted, text, tolerance=1e-6):
        self.check(abs(value - wanted) <= tolerance, f"{text}: {value:.9g} instead of {wanted:.9g}")

    def finish(self):
        for text in self.bad[:20]:
            print(text)
        print(f"{len(self.bad)} of {self.checks} checks failed" if self.bad else "all as promised")
        sys.stdout.flush()
