# Machines with coordinates in any number and order, and travels on either side of zero. Before homing every
# joint jogs both ways (FP-071); a jog moves what it names and nothing else, as far as it says, after each kind of
# automatic move and after power went off and on, and power does not change the mode (FP-065, FP-066); a place
# reached by jogging to a limit that is no round number is legal for moves along it (FP-070); in teleop mode, too, a
# jog leads back from outside a limit (FP-069).
import random

import kerf_motion as km
from motion_bench import AXES, Machine, eq

MODES = {km.FREE: 1, km.TELEOP: 2, km.COORD: 3}
LINE, ARC, PROBE = range(3)


def only(m, title, before, changes):
    m.wait(lambda s: not m.get("motion.jog-is-active") and s["inpos"] and s["depth"] == 0, f"{title}: at rest", 60)
    m.sleep(0.02)
    for j, (a, b) in enumerate(zip(before, m.joints_at())):
        eq(round(b - a, 9) + 0.0, changes.get(j, 0.0), f"{title}: way of joint {j}")
    eq(m.errors(), [], title)


def power(m, title, mode):
    m.disable()
    m.sleep(0.01)
    m.enable()
    m.sleep(0.02)
    eq(m.status()["motion_state"], MODES[mode], f"{title}: mode after power off and on")


def automatic(m, kind, letters):
    """One move of the kind through all axes, which ends where it began but for the first axis."""
    pose = list(m.status()["carte_pos_cmd"])
    first = AXES.index(letters[0])
    pose[first] += 1
    if kind == ARC and {"x", "y"} <= set(letters):
        here = list(m.status()["carte_pos_cmd"])
        end = list(here)
        end[1] += 2
        m.send(km.SET_CIRCLE, pos=end, center=[here[0], here[1] + 1, here[2]], normal=[0, 0, 1], vel=20,
               ini_maxvel=20, acc=300, ini_maxjerk=1e9, id=2, motion_type=3, turn=0)
        m.rest()
        pose = here
    m.send(km.PROBE if kind == PROBE else km.SET_LINE, pos=pose, vel=20, ini_maxvel=20, acc=300, ini_maxjerk=1e9, id=3,
           motion_type=5 if kind == PROBE else 2, probe_type=1, turn=-1)
    m.rest()
    m.sleep(0.01)
    eq(m.errors(), [], f"move {kind} on {letters}")


def machine(letters, rng):
    n = len(letters)
    span = [rng.uniform(50, 90) for _ in letters]
    low = [rng.choice([-1, 0, 0.5]) * rng.uniform(90, 120) - (0 if rng.random() < 0.5 else s) for s in span]
    high = [a + s for a, s in zip(low, span)]
    middle = [round((a + b) / 2, 3) for a, b in zip(low, high)]
    m = Machine(joints=n, axes=letters, kins=f"trivkins coordinates={letters}", low=low, high=high, home=False,
                home_params={j: dict(offset=q, home=q) for j, q in enumerate(middle)})
    m.enable()
    for j in range(n):  # not homed, at zero, wherever the travel is
        for sign in (1, -1):
            before = m.joints_at()
            m.send(km.JOG_INCR, joint=j, axis=-1, vel=sign * 40, offset=40)
            m.sleep(0.005)
            only(m, f"{letters} joint {j} not homed", before, {j: sign * 40.0})
    power(m, letters, km.FREE)
    m.home()
    m.errors()
    for j, letter in enumerate(letters):
        title = f"{letters} {letter}"
        for kind in (LINE, ARC, PROBE):
            m.mode(km.COORD)
            automatic(m, kind, letters)
            power(m, title, km.COORD)
            m.mode(km.TELEOP)
            before = m.joints_at()
            m.send(km.JOG_INCR, joint=-1, axis=AXES.index(letter), vel=-20, offset=0.5)
            m.sleep(0.005)
            only(m, f"{title} after move {kind}", before, {j: -0.5})
            power(m, title, km.TELEOP)
            m.mode(km.FREE)
            before = m.joints_at()
            m.send(km.JOG_INCR, joint=j, axis=-1, vel=20, offset=0.5)
            m.sleep(0.005)
            only(m, f"{title} joint after move {kind}", before, {j: 0.5})
    for mode in (km.FREE, km.TELEOP):
        for j, letter in enumerate(letters):
            for sign, limit in ((1, high[j]), (-1, low[j])):
                title = f"{letters} {letter} to {limit!r} in mode {mode}"
                m.mode(mode)
                before = m.joints_at()
                m.send(km.JOG_CONT, joint=j if mode == km.FREE else -1,
                       axis=-1 if mode == km.FREE else AXES.index(letter), vel=sign * 50)
                m.sleep(0.005)
                only(m, title, before, {j: round(limit - before[j], 9)})
                m.mode(km.COORD)
                pose = list(m.status()["carte_pos_cmd"])
                pose[AXES.index(letters[j - 1])] += (-0.25 if j != 0 or n > 1 and m.joints_at()[j - 1] > middle[j - 1]
                                                     else 0.25)
                for axis in AXES:
                    if axis not in letters:
                        pose[AXES.index(axis)] = 2e-13  # what a rotated system leaves of an axis that is not there
                m.send(km.SET_LINE, pos=pose, vel=20, ini_maxvel=20, acc=300, ini_maxjerk=1e9, id=4,
                       motion_type=2, turn=-1)
                m.rest()
                eq(m.errors(), [], f"{title}: then a move along it")
                m.mode(km.FREE)
                m.send(km.JOG_ABS, joint=j, axis=-1, vel=50, offset=middle[j])
                m.rest()
                m.sleep(0.01)
    # outside a limit in teleop mode
    m.mode(km.TELEOP)
    at = m.joints_at()[0]
    m.send(km.SET_JOINT_POSITION_LIMITS, joint=0, minLimit=low[0], maxLimit=at - 2)
    m.send(km.SET_AXIS_POSITION_LIMITS, axis=AXES.index(letters[0]), minLimit=low[0], maxLimit=at - 2)
    m.sleep(0.02)
    eq((len(m.errors()) > 0, m.get("motion.on-soft-limit")), (True, True), f"{letters}: outside")
    m.send(km.ABORT)
    m.send(km.JOG_CONT, joint=-1, axis=AXES.index(letters[0]), vel=20)
    m.sleep(0.3)
    eq(round(m.joints_at()[0] - at, 9), 0.0, f"{letters}: farther out")
    m.errors()
    m.send(km.JOG_INCR, joint=-1, axis=AXES.index(letters[0]), vel=-20, offset=5)
    m.sleep(1)
    eq((round(m.joints_at()[0] - at, 9), m.get("motion.on-soft-limit"), m.get("joint.0.homed")), (-5, False, True),
       f"{letters}: back inside")
    eq(m.violations(), [], f"{letters}: limits")
    m.close()


rng = random.Random(6)
for coordinates in ("xz", "xza", "zyx", "yxcu", "xyzabcuvw"):
    machine(coordinates, rng)
print(f"{eq.checks} checks")
