# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-053, FP-059: abort, machine off, a cancelled jog and a probe contact in every state of homing,
in the middle of home-all. Joints stop within their limits, nothing goes on by itself after the next
machine-on, homing of one joint afterwards moves that joint alone, status is clear at once."""
import kerf_motion as km
from rig import UNLOCK_FIRST, USE_INDEX, Report, Rig

r = Report()
m = Rig(3, axes="xyz", low=-200.0, high=200.0, motmod="unlock_joints_mask=2", ferror=5.0,
        hw={"all": dict(home_from=10, hysteresis=0.05, index_pitch=4.0)},
        hal_lines=["loadrt timedelay", "addf timedelay.0 servo-thread", "setp timedelay.0.on-delay 0.01",
                   "setp timedelay.0.off-delay 0.01", "net unlock joint.1.unlock => timedelay.0.in",
                   "net unlocked timedelay.0.out => joint.1.is-unlocked"])
SWITCH = dict(search_vel=40.0, latch_vel=4.0, home=-2.0)
KINDS = [
    (SWITCH, 0.0), (SWITCH, 15.0), (dict(SWITCH, latch_vel=-4.0), 0.0), (dict(SWITCH, flags=USE_INDEX), 0.0),
    (dict(latch_vel=4.0, flags=USE_INDEX, home=-2.0), 0.0), (dict(SWITCH, flags=UNLOCK_FIRST), 0.0),
]
WAYS = ["abort", "off", "jog abort", "probe"]
m.enable()


def stop(way):
    if way == "abort":
        m.send(km.ABORT)
    elif way == "off":
        m.send(km.DISABLE)
    elif way == "jog abort":
        m.send(km.JOG_ABORT, joint=1, axis=-1)
    else:
        m.set("motion.probe-input", 1)
        m.sleep(0.002)
        m.set("motion.probe-input", 0)


def prepare(params, start):
    m.enable()
    m.unhome()
    for j in range(3):
        m.place(j, start if j == 1 else 0.0)
        m.set_home(j, home_sequence=j, **(params if j == 1 else SWITCH))
    m.sleep(0.01)
    m.errors()


def states(params, start):
    prepare(params, start)
    seen, ok = m.run_home()
    r.check(ok, f"{params}: not homed")
    return [s for s in seen[1] if s != "IDLE"]


tried = set()
for params, start in KINDS:
    for state, way in [(s, w) for s in states(params, start) for w in WAYS if (s, w) not in tried]:
        name = f"{params} from {start}: {way} in {state}"
        prepare(params, start)
        m.ask_home()
        try:
            m.until(lambda: m.state(1) == state, state)
        except AssertionError:
            continue  # a state of one cycle, passed between two looks
        tried.add((state, way))
        stop(way)
        m.sleep(0.004)
        r.check(not m.homing() and not any(s["homing"] for s in m.status()["joint"]), f"{name}: still homing")
        r.check(not m.homed(1) and not m.homed(2) and m.homed(0), f"{name}: homed {[m.homed(j) for j in range(3)]}")
        r.check(all(m.state(j) == "IDLE" for j in range(3)), f"{name}: {[m.state(j) for j in range(3)]}")
        r.check(not m.get("joint.1.index-enable"), f"{name}: index still asked for")
        m.sleep(0.2)
        at = [m.at(j) for j in range(3)]
        m.disable()
        m.sleep(0.01)
        m.enable()
        m.sleep(0.3)
        r.check(at == [m.at(j) for j in range(3)], f"{name}: moved after machine-on")
        m.errors()
        m.ask_home(2)  # taken at once, and it is the only one that moves
        m.sleep(0.3)
        r.check(m.get("joint.2.vel-cmd") != 0 and not m.errors(), f"{name}: joint 2 is not homed")
        m.until(lambda: not m.homing(), "homed")
        r.check(m.homed(2) and [m.at(0), m.at(1)] == at[:2] and not m.homed(1), f"{name}: others moved")
        r.check(not m.violations(), f"{name}: {m.violations()}")
# every state that waits for something, or for the next cycle
for state in ("UNLOCK_WAIT BACKOFF_START BACKOFF_WAIT SEARCH_START SEARCH_WAIT FINAL_BACKOFF_START "
              "FINAL_BACKOFF_WAIT RISE_START "
              "RISE_WAIT FALL_START FALL_WAIT INDEX_ONLY_START INDEX_WAIT FINAL_START FINAL_WAIT LOCK_WAIT").split():
    for way in WAYS:
        r.check((state, way) in tried, f"{way} in {state} was not tried")
# between two sequence numbers there is a cycle in which every joint is idle
m.wait(lambda s: s["inpos"], "at rest")
for delay in range(0, 12):
    for j in range(3):
        m.set_home(j, home_sequence=j)
    m.unhome()
    m.ask_home()
    m.sleep(0.001 * delay)
    m.send(km.ABORT)
    m.sleep(0.002)
    homed = [m.homed(j) for j in range(3)]
    r.check(not m.homing(), f"abort after {delay} cycles: still homing")
    m.sleep(0.2)
    r.check(homed == [m.homed(j) for j in range(3)], f"abort after {delay} cycles: homing goes on")
    m.free()
# the probe interlock can be taken off
m.send(km.SET_PROBE_ERR_INHIBIT, probe_jog_err_inhibit=1, probe_home_err_inhibit=1)
prepare(SWITCH, 0.0)
m.ask_home(1)
m.sleep(0.3)
stop("probe")
m.until(lambda: not m.homing(), "homed")
r.check(m.homed(1) and not m.errors(), "probe contact ends homing although it is inhibited")
r.finish()
