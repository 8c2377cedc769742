# A wheel turned at any speed in any sequence can't run away (FP-062, FP-063): joint and axis wheels,
# random counts, scales, modes and moments. In position mode the machine ends at the sum of the counts
# that it may follow; in velocity mode within a stop of where the wheel stopped; counts turned where
# jogging is not allowed are never moved later.
import random

import kerf_motion as km
from motion_bench import Machine

VEL, ACC, LIMIT = 50.0, 500.0, 100.0
STOP = VEL * VEL / (2 * ACC) + 2 * VEL * 0.001
m = Machine(vel=VEL, acc=ACC, low=-LIMIT, high=LIMIT)
rng = random.Random(7)
counts = {}


def turn(pin, delta):
    counts[pin] = (counts.get(pin, 0) + delta + 2**31) % 2**32 - 2**31
    m.set(f"{pin}.jog-counts", counts[pin])


def still(n):
    m.wait(lambda s: not m.get("motion.jog-is-active"), "end of the wheel jog", 30)
    m.sleep(0.02)
    return m.get(f"joint.{n}.pos-cmd")


turns = 0
for mode in (km.FREE, km.TELEOP):
    for trial in range(60):
        m.mode(mode)
        n = rng.randrange(3)
        pin = f"joint.{n}" if mode == km.FREE else f"axis.{'xyz'[n]}"
        scale = rng.choice([0.001, 0.01, 0.1, 1.0, -0.05])
        velocity = rng.random() < 0.5
        m.set(f"{pin}.jog-scale", scale)
        m.set(f"{pin}.jog-vel-mode", int(velocity))
        m.set(f"{pin}.jog-accel-fraction", rng.choice([1.0, 0.5, 0.0, 3.0]))
        m.set(f"{pin}.jog-enable", 1)
        wanted = start = m.get(f"joint.{n}.pos-cmd")
        for _ in range(rng.randint(1, 60)):
            delta = rng.choice([1, -1, 2, 4, -4, 25, -25, 400, -400, 100000])
            target = wanted + delta * scale
            if abs(target) <= LIMIT:  # counts that lead beyond a limit are dropped
                wanted = target
            turn(pin, delta)
            m.sleep(rng.choice([0.001, 0.001, 0.003, 0.02, 0.2]))
            turns += 1
        here = m.get(f"joint.{n}.pos-cmd")
        fraction = m.get(f"{pin}.jog-accel-fraction")
        reach = STOP / (fraction if 0 < fraction <= 1 else 1)
        end = still(n)
        if velocity and abs(end - here) > 2 * reach + 1e-6:
            raise SystemExit(f"trial {trial}: from {here} on to {end}, stop {reach}")
        if not velocity and abs(end - wanted) > 1e-6:
            raise SystemExit(f"trial {trial} {pin}: at {end}, counts say {wanted} from {start}")
        m.set(f"{pin}.jog-enable", 0)
        if abs(end) > LIMIT + 1e-9:
            raise SystemExit(f"trial {trial}: {end} is beyond the limit")

# turned where jogging is not allowed: 1000 counts each
at = m.joints_at()
for n in range(3):
    for pin in (f"joint.{n}", f"axis.{'xyz'[n]}"):
        m.set(f"{pin}.jog-scale", 0.01)
        m.set(f"{pin}.jog-vel-mode", 0)
for what, before, after in (
        ("coordinated mode", lambda: m.mode(km.COORD), lambda: m.mode(km.FREE)),
        ("jog-enable off", lambda: None, lambda: None),
        ("jog-inhibit", lambda: m.set("motion.jog-inhibit", 1), lambda: m.set("motion.jog-inhibit", 0)),
        ("feed hold", lambda: m.set("motion.feed-hold", 1), lambda: m.set("motion.feed-hold", 0)),
        ("machine off", m.disable, m.enable)):
    for mode in (km.FREE, km.TELEOP):
        m.mode(mode)
        before()
        for n in range(3):
            for pin in (f"joint.{n}", f"axis.{'xyz'[n]}"):
                m.set(f"{pin}.jog-enable", int(what != "jog-enable off"))
                if what == "feed hold" and pin.startswith("axis"):
                    continue  # axis wheels do not look at the feed
                turn(pin, 1000)
        m.sleep(0.1)
        after()
        for n in range(3):
            for pin in (f"joint.{n}", f"axis.{'xyz'[n]}"):
                m.set(f"{pin}.jog-enable", 1)
        m.mode(mode)
        m.sleep(0.2)
        if [round(a - b, 9) for a, b in zip(at, m.joints_at())] != [0, 0, 0]:
            raise SystemExit(f"counts of {what} were moved later: {at} {m.joints_at()}")
        for n in range(3):
            for pin in (f"joint.{n}", f"axis.{'xyz'[n]}"):
                m.set(f"{pin}.jog-enable", 0)

# FP-063: after a move to the limit the wheel starts from there
m.mode(km.COORD)
m.line(LIMIT, LIMIT, LIMIT, vel=VEL)
m.rest()
for mode, pin in ((km.FREE, "joint.0"), (km.TELEOP, "axis.y")):
    m.mode(mode)
    m.set(f"{pin}.jog-enable", 1)
    m.set(f"{pin}.jog-vel-mode", 1)
    before = m.joints_at()
    turn(pin, -3)
    still(0)
    moved = sum(abs(a - b) for a, b in zip(before, m.joints_at()))
    if not 0 < moved <= 0.03 + 1e-9:
        raise SystemExit(f"three clicks of 0.01 moved {moved}")
if m.violations():
    raise SystemExit(m.violations())
print(f"{turns} turns of wheels")
