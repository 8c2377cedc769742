# A jog of Y takes the joint of Y to its limit while an external offset turns the head, which leads the joint back in.
# When both have to stop, Y stands long before the head does: at the end the joint is well inside, but between it may
# not go out. In all directions, at several speeds and tilts, with and without a jerk limit.
import kerf_motion as km
from fuzz import machine
from motion_bench import AXES, eq

LIMIT, TOLERANCE, SCALE, BEFORE, TURN = 100.0, 1e-6, 0.1, 0.4, 30


def to(m, letter, at):
    m.send(km.JOG_ABS, joint=-1, axis=AXES.index(letter), vel=30, offset=at)
    m.sleep(0.01)
    m.wait(lambda s: not m.get("motion.jog-is-active"), f"{letter} at {at}", 60)
    eq(m.get(f"axis.{letter}.pos-cmd"), float(at), letter)


def turn_head(m, way):
    turn_head.counts += round(way / SCALE)
    m.set("axis.c.eoffset-counts", turn_head.counts)


def run(m, tilt, turn, speed, sign):
    """The jog starts so that the joint comes to its limit while the head turns at its full speed."""
    title = f"tilt {tilt} turn {turn} jog {speed} to {sign}"
    for letter, at in (("y", 0), ("b", tilt), ("c", -turn / 2)):
        to(m, letter, at)
    to(m, "y", sign * (LIMIT - BEFORE) - m.joints_at()[1])
    m.reset_limits()
    turn_head(m, turn)
    m.sleep(0.2)
    m.send(km.JOG_CONT, joint=-1, axis=1, vel=sign * speed)
    m.sleep(0.6)
    m.send(km.ABORT)
    m.sleep(3)
    eq((m.violations(), m.errors()), ([], []), title)
    to(m, "y", 0)
    m.set("axis.c.eoffset-clear", 1)
    m.wait(lambda s: abs(m.get("axis.c.eoffset")) < 1e-6, "head turned back", 60)
    m.set("axis.c.eoffset-clear", 0)


for jerk in (0.0, 5000.0):
    m = machine("five", jerk, 0.3)
    for j in range(m.joints):
        m.set(f"limitcheck.{j}.max-pos", LIMIT + TOLERANCE)
        m.set(f"limitcheck.{j}.min-pos", -LIMIT - TOLERANCE)
    m.set("axis.c.eoffset-enable", 1)
    m.set("axis.c.eoffset-scale", SCALE)
    turn_head.counts = 0
    m.mode(km.TELEOP)
    for tilt in (-4, -2, 2, 4):
        for sign in (1, -1):
            for speed in (5, 6, 8, 12):
                run(m, tilt, TURN * sign if tilt > 0 else -TURN * sign, speed, sign)
    m.close()
print(f"{eq.checks} checks")
