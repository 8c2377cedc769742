# SPDX-License-Identifier: GPL-2.0-or-later
"""A machine made of motmod and simulated motors, driven without task.

Machine() loads kinematics, planner, homing and motmod in this instance, one
limitcheck per joint on motor-pos-cmd, and loops commands back as feedback. Run
it in virtual time (KERF_CLOCK=virtual, set by run.sh). Units: machine units, s.
"""

import atexit
import os
import shutil
import subprocess
import sys
import tempfile

import hal
import kerf_motion as km
from kerf import clock

AXES = "xyzabcuvw"


def eq(got, wanted, what):
    """Ends the test when the two differ (numbers: by more than 1e-6 of it); eq.checks counts."""
    eq.checks += 1
    same = abs(got - wanted) <= 1e-6 * max(1, abs(wanted)) if isinstance(wanted, float) else got == wanted
    if not same:
        raise SystemExit(f"{what}: {got!r}, not {wanted!r}")


eq.checks = 0


class Machine:
    """joints: number; axes: letters of coordinates; limits as keyword arguments, per joint lists allowed."""

    def __init__(self, joints=3, kins="trivkins coordinates=xyz", axes="xyz", vel=50.0, acc=500.0, jerk=0.0,
                 low=-100.0, high=100.0, motmod="", hal_lines=(), loop=True, home=True, home_params=None,
                 traj_jerk=1e9, axis_vel=None, axis_acc=None, eoffset_ratio=0.0, check=True, kins_setup=(),
                 extra_functs=(), homemod="homemod", ferror=1.0):
        self.joints, self.axes = joints, axes
        self.per = lambda v, j: v[j] if isinstance(v, (list, tuple)) else v
        lines = [f"loadrt {kins}", "loadrt tpmod", f"loadrt {homemod}", f"loadrt motmod num_joints={joints} {motmod}",
                 f"loadrt limitcheck count={joints}", *kins_setup,
                 "addf motion-command-handler servo-thread", "addf motion-controller servo-thread"]
        for j in range(joints):
            lines.append(f"net cmd{j} joint.{j}.motor-pos-cmd => limitcheck.{j}.pos-cmd"
                         + (f" joint.{j}.motor-pos-fb" if loop else ""))
            lines.append(f"net amp{j} joint.{j}.amp-enable-out => limitcheck.{j}.enable")
            lines.append(f"addf limitcheck.{j} servo-thread")
            if check:
                lines += [f"setp limitcheck.{j}.max-vel {self.per(vel, j)}",
                          f"setp limitcheck.{j}.max-acc {self.per(acc, j)}",
                          f"setp limitcheck.{j}.max-jerk {self.per(jerk, j)}"]
        lines += list(hal_lines)
        self.limits = dict(vel=vel, acc=acc, jerk=jerk, low=low, high=high)
        clock.join("motion-bench", 900)
        refuse_used_instance()
        run_realtime("start")
        atexit.register(self.close)
        halcmd(lines)
        km.connect()
        km.quiet(True)
        self.comp = hal.component(f"bench{os.getpid()}")
        self.comp.ready()
        halcmd(["start"])
        self.configure(vel, acc, jerk, low, high, traj_jerk, axis_vel, axis_acc, eoffset_ratio, home_params, ferror)
        if home:
            self.enable()
            self.home()

    def configure(self, vel, acc, jerk, low, high, traj_jerk, axis_vel, axis_acc, ratio, home_params, ferror):
        per = self.per
        send = self.send
        send(km.SET_NUM_JOINTS, joint=self.joints)
        send(km.SET_NUM_SPINDLES, spindle=1)
        send(km.SET_VEL, vel=0, ini_maxvel=per(vel, 0))
        send(km.SET_VEL_LIMIT, vel=1e9)
        send(km.SET_ACC, acc=1e99)
        send(km.SET_JERK, jerk=traj_jerk)
        send(km.SET_PLANNER_TYPE, planner_type=1 if per(jerk, 0) > 0 else 0)
        send(km.SETUP_ARC_BLENDS, arcBlendEnable=1, arcBlendOptDepth=50, arcBlendGapCycles=4, arcBlendRampFreq=100,
             arcBlendTangentKinkRatio=0.1)
        send(km.SET_MAX_FEED_OVERRIDE, maxFeedScale=2.0)
        for j in range(self.joints):
            send(km.SET_JOINT_POSITION_LIMITS, joint=j, minLimit=per(low, j), maxLimit=per(high, j))
            send(km.SET_JOINT_MAX_FERROR, joint=j, maxFerror=ferror)
            send(km.SET_JOINT_MIN_FERROR, joint=j, minFerror=ferror)
            params = dict(offset=0.0, home=0.0, home_final_vel=-1.0, search_vel=0.0, latch_vel=0.0, flags=0,
                          home_sequence=0, volatile_home=0)
            params.update((home_params or {}).get(j, (home_params or {}).get("all", {})))
            send(km.SET_JOINT_HOMING_PARAMS, joint=j, **params)
            send(km.SET_JOINT_VEL_LIMIT, joint=j, vel=per(vel, j))
            send(km.SET_JOINT_ACC_LIMIT, joint=j, acc=per(acc, j))
            send(km.SET_JOINT_JERK_LIMIT, joint=j, jerk=per(jerk, j))
            send(km.JOINT_ACTIVATE, joint=j)
        for letter in self.axes:
            a = AXES.index(letter)
            j = self.axes.index(letter)
            v = per(axis_vel, j) if axis_vel else per(vel, min(j, self.joints - 1))
            ac = per(axis_acc, j) if axis_acc else per(acc, min(j, self.joints - 1))
            send(km.SET_AXIS_POSITION_LIMITS, axis=a, minLimit=per(low, min(j, self.joints - 1)),
                 maxLimit=per(high, min(j, self.joints - 1)))
            send(km.SET_AXIS_VEL_LIMIT, axis=a, vel=v * (1 - ratio), ext_offset_vel=v * ratio)
            send(km.SET_AXIS_ACC_LIMIT, axis=a, acc=ac * (1 - ratio), ext_offset_acc=ac * ratio)
            send(km.SET_AXIS_LOCKING_JOINT, axis=a, joint=-1)
            send(km.SET_AXIS_JERK_LIMIT, axis=a, jerk=per(jerk, min(j, self.joints - 1)))

        self.path_vel, self.path_acc, self.path_jerk = per(vel, 0), per(acc, 0), per(jerk, 0) or 1e9

    # ---- commands ----

    def send(self, code, **fields):
        return km.send(code, **fields)

    def enable(self):
        self.send(km.ENABLE)
        self.wait(lambda s: s["enabled"], "enabled")

    def disable(self):
        self.send(km.DISABLE)
        self.wait(lambda s: not s["enabled"], "disabled")

    def home(self, joint=-1, timeout=100.0):
        self.send(km.JOINT_HOME, joint=joint)
        self.wait(lambda s: all(s["joint"][j]["homed"] for j in range(self.joints)), "homed", timeout)
        # home-all asks for teleop mode; settle in free mode
        clock.sleep(0.01)
        self.mode(km.FREE)

    def mode(self, code, timeout=20.0):
        state = {km.FREE: 1, km.TELEOP: 2, km.COORD: 3}[code]
        self.send(code)
        self.wait(lambda s: s["motion_state"] == state, f"motion state {state}", timeout)

    def line(self, *xyz, vel=10.0, max_vel=None, acc=None, jerk=1e9, id=1, kind=2, **more):
        pos = list(xyz) + [0.0] * (9 - len(xyz))
        return self.send(km.SET_LINE, pos=pos, vel=vel, ini_maxvel=max_vel or vel, acc=acc or 500.0,
                         ini_maxjerk=jerk, id=id, motion_type=kind, turn=-1, **more)

    def rest(self, timeout=100.0):
        """Waits until in position with an empty queue."""
        return self.wait(lambda s: s["inpos"] and s["depth"] == 0, "at rest", timeout)

    def wait(self, condition, what, timeout=20.0):
        end = clock.now() + timeout
        while True:
            s = km.status()
            if condition(s):
                return s
            if clock.now() > end:
                raise AssertionError(f"not {what} after {timeout} s; state {s['motion_state']} errors {self.errors()}")
            clock.sleep(0.001)

    def sleep(self, seconds):
        clock.sleep(seconds)

    def now(self):
        return clock.now()

    def status(self):
        return km.status()

    def errors(self):
        out = []
        while (e := km.error()) is not None:
            out.append(e)
        return out

    # ---- pins ----

    def get(self, pin):
        return hal.get_value(pin)

    def set(self, pin, value):
        hal.set_p(pin, str(value))

    def joints_at(self):
        return [self.get(f"joint.{j}.pos-cmd") for j in range(self.joints)]

    # ---- limits ----

    def worst(self):
        return {j: tuple(self.get(f"limitcheck.{j}.worst-{k}") for k in ("vel", "acc", "jerk"))
                for j in range(self.joints)}

    def violations(self):
        """What went over a limit since the last reset: list of texts, empty when nothing."""
        out = []
        for j in range(self.joints):
            for k in ("vel", "acc", "jerk", "pos"):
                if self.get(f"limitcheck.{j}.{k}-violation"):
                    t = self.get(f"limitcheck.{j}.violation-time")
                    worst = self.get(f"limitcheck.{j}.worst-{k}") if k != "pos" else \
                        self.get(f"limitcheck.{j}.violation-value")
                    limit = self.get(f"limitcheck.{j}.max-{k}")
                    out.append(f"joint {j} {k} {worst:.6g} of {limit:.6g}, first at {t:.3f}")
        return out

    def reset_limits(self):
        for j in range(self.joints):
            self.set(f"limitcheck.{j}.reset", 1)
        clock.sleep(0.002)
        for j in range(self.joints):
            self.set(f"limitcheck.{j}.reset", 0)
        clock.sleep(0.005)

    def close(self):
        atexit.unregister(self.close)
        try:
            km.disconnect()
            self.comp.exit()
        finally:
            run_realtime("stop")


def halcmd(lines):
    with tempfile.NamedTemporaryFile("w", suffix=".hal") as f:
        f.write("\n".join(lines) + "\n")
        f.flush()
        done = clock.run(["halcmd", "-f", f.name], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise RuntimeError(f"halcmd: {done.stdout}")
    return done.stdout


def refuse_used_instance():
    """Two machines in one instance would take each other's pins away."""
    if clock.run(["realtime", "status"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                 stderr=subprocess.DEVNULL).returncode == 0:
        raise SystemExit(f"instance {os.environ.get('KERF_INSTANCE') or '(default)'} is in use: end its session, or "
                         "set KERF_INSTANCE")


def run_realtime(word):
    log = os.environ.get("MOTION_BENCH_LOG", os.devnull)
    with open(log, "a") as out:
        under = os.environ.get("MOTION_BENCH_UNDER", "").split()  # a program that runs the realtime host
        command = [*under, shutil.which("rtapi_app"), "start"] if under and word == "start" else ["realtime", word]
        done = clock.run(command, stdin=subprocess.DEVNULL, stdout=out, stderr=out)
    if done.returncode and word == "start":
        raise RuntimeError("realtime start failed")


def finish(text="ok"):
    print(text)
    sys.stdout.flush()
