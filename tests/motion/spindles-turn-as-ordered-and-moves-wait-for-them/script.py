# Outputs of spindles by speed, limits, override, brake, orientation and constant surface speed; feeds that
# wait for the speed after a start, another speed and a stop, and rapids that do not (FP-023,
# FP-027), with eight spindles.
import os
import tempfile

import kerf_motion as km
from motion_bench import Machine, eq

SPINDLES = 8
log = tempfile.NamedTemporaryFile()
os.environ["MOTION_BENCH_LOG"] = log.name
m = Machine(vel=200.0, acc=5000.0, motmod=f"num_spindles={SPINDLES}")
m.send(km.SET_NUM_SPINDLES, spindle=SPINDLES)
for n in range(SPINDLES):
    m.send(km.SET_SPINDLE_PARAMS, spindle=n, maxLimit=6000, minLimit=-5000, min_pos_speed=20,
           max_neg_speed=-30, offset=100)


def order(rpm, n=0, wait=0, state=1, css=0.0, offset=0.0):
    m.send(km.SPINDLE_ON if rpm or css else km.SPINDLE_OFF, spindle=n, vel=rpm, state=state, ini_maxvel=css, acc=offset,
           wait_for_spindle_at_speed=wait)
    m.sleep(0.003)


def shown(rpm, n=0, on=True, brake=False, what=""):
    p = f"spindle.{n}."
    eq([round(m.get(p + "speed-out"), 6), round(m.get(p + "speed-out-abs"), 6),
        round(m.get(p + "speed-out-rps") * 60, 6), round(m.get(p + "speed-out-rps-abs") * 60, 6), m.get(p + "forward"),
        m.get(p + "reverse"), m.get(p + "on"), m.get(p + "brake")],
       [rpm, abs(rpm), rpm, abs(rpm), rpm > 0, rpm < 0, on, brake], what or f"outputs of spindle {n}")


def direction(n=0):
    return m.status()["spindle"][n]["direction"]


# ---- limits, override, inhibit
for asked, given in ((1000, 1000), (9000, 6000), (5, 20), (-1000, -1000), (-9000, -5000), (-5, -30)):
    order(asked)
    shown(given, what=f"{asked} rpm")
    eq((direction(), round(m.get("spindle.0.speed-cmd-rps") * 60, 6)), (1 if asked > 0 else -1, given), f"{asked} rpm")
order(0)
shown(0, on=False, brake=True)
eq(direction(), 0, "direction of a stopped spindle")
order(3000)
for scale, given in ((0.5, 1500), (3.0, 6000), (0.001, 20), (0.0, 0), (1.0, 3000)):
    m.send(km.SPINDLE_SCALE, spindle=0, scale=scale)
    m.sleep(0.003)
    shown(given, what=f"override {scale}")
    eq(round(m.get("spindle.0.speed-cmd-rps") * 60, 6), 3000, "the commanded speed is without override")
m.send(km.SPINDLE_SCALE, spindle=0, scale=0.5)
m.send(km.SS_ENABLE, mode=0)
m.sleep(0.003)
shown(3000, what="override disabled")
m.set("spindle.0.inhibit", 1)
m.sleep(0.003)
shown(0, what="inhibited, also while the override is disabled")
m.set("spindle.0.inhibit", 0)
m.send(km.SS_ENABLE, mode=1)
m.send(km.SPINDLE_SCALE, spindle=0, scale=1.0)

# ---- steps of the increment, brake
order(-150)
for code, given in ((km.SPINDLE_INCREASE, -250), (km.SPINDLE_DECREASE, -150), (km.SPINDLE_DECREASE, -50),
                    (km.SPINDLE_DECREASE, -50)):
    m.send(code, spindle=0)
    m.sleep(0.003)
    shown(given, what="increase and decrease")
order(5950)
m.send(km.SPINDLE_INCREASE, spindle=0)
m.sleep(0.003)
shown(6000, what="increase up to the limit")
order(0)
m.send(km.SPINDLE_INCREASE, spindle=0)
m.sleep(0.003)
shown(0, on=False, brake=True, what="increase at rest")
m.send(km.SPINDLE_BRAKE_RELEASE, spindle=0)
m.sleep(0.003)
shown(0, on=False, what="brake released")
order(500)
m.send(km.SPINDLE_BRAKE_ENGAGE, spindle=0)
m.sleep(0.003)
shown(0, brake=True, what="brake engaged: the state is unchanged")

# ---- all at once, each for itself
order(700, n=-1)
order(-200, n=1)
order(0, n=2)
shown(700, 0)
shown(-200, 1)
shown(0, 2, on=False, brake=True)
m.set("spindle.1.revs", 12.25)
m.set("spindle.1.speed-in", -3.5)
m.sleep(0.003)
eq((m.status()["spindle"][1]["spindleRevs"], m.status()["spindle"][1]["spindleSpeedIn"]), (12.25, -3.5), "encoder")

# ---- orientation
PINS = ("orient", "locked", "orient-angle", "orient-mode", "on", "brake")


def orientation(n=0):
    return [m.get(f"spindle.{n}.{p}") for p in PINS] + [m.status()["spindle"][n]["orient_state"]]


m.send(km.SPINDLE_ORIENT, spindle=0, orientation=123.5, mode=2)
m.sleep(0.003)
eq(orientation(), [True, False, 123.5, 2, False, False, 2], "orientation in progress")
shown(0, on=False)
m.set("spindle.0.is-oriented", 1)
m.sleep(0.003)
eq(orientation(), [False, True, 123.5, 2, False, True, 1], "orientation complete")
m.set("spindle.0.is-oriented", 0)
order(400)
eq(orientation(), [False, False, 123.5, 2, True, False, 0], "a start unlocks")
m.send(km.SPINDLE_ORIENT, spindle=0, orientation=0, mode=0)
m.sleep(0.003)
m.set("spindle.0.orient-fault", 17)
m.sleep(0.003)
eq((orientation()[0], orientation()[6], m.status()["error"], m.errors()),
   (False, 3, True, ["fault 17 during orient in progress"]),
   "fault of the orientation")
m.set("spindle.0.orient-fault", 0)
m.send(km.ABORT)
m.send(km.SPINDLE_ORIENT, spindle=0, orientation=0, mode=0)
order(0)
eq(orientation(), [False, False, 0.0, 0, False, True, 0], "a stop ends the orientation")

# ---- constant surface speed: D bounds it, override before the bound
m.mode(km.COORD)
order(2000, css=30000.0, offset=-5.0)
for x, given in ((15.0, 1500), (55.0, 500), (5.0, 2000), (-5.0, 2000), (-15.0, 2000), (-65.0, 500)):
    m.line(x, 0, 0, vel=200, kind=1)
    m.rest()
    shown(given, what=f"surface speed at {x}")
m.send(km.SPINDLE_SCALE, spindle=0, scale=1.5)
m.sleep(0.003)
shown(750, what="surface speed with override")
m.send(km.SPINDLE_SCALE, spindle=0, scale=1.0)


# ---- waits: which move waits until every spindle is at its speed
def waits(kind, **more):
    """A move away and back; 1 when it did not begin within 0.1 s, then at-speed comes and it has to."""
    before = m.get("joint.1.pos-cmd")
    y = 10.0 if before == 0 else 0.0
    m.line(m.get("joint.0.pos-cmd"), y, 0, vel=200, kind=kind, **more)
    m.sleep(0.1)
    held = m.get("joint.1.pos-cmd") == before
    for n in range(SPINDLES):
        m.set(f"spindle.{n}.at-speed", 1)
    m.rest()
    eq(m.get("joint.1.pos-cmd"), y, "the move ends")
    return held


def case(what, wanted, rpm=None, n=0, kinds=(2,)):
    if rpm is not None:
        order(rpm, n=n, wait=1)
    m.set(f"spindle.{n}.at-speed", 0)
    eq([waits(k) for k in kinds], wanted, what)
    m.errors()


order(0, n=-1)
case("feed after a start", [True], 500)
case("only the first feed", [False])
case("feed after another speed", [True], 600)
case("feed after the other direction", [True], -600)
case("the same speed again is no order", [False], -600)
case("feed after a stop", [True], 0)
case("rapids go on", [False], 500, kinds=(1,))
case("the feed after a rapid waits", [True])
case("any spindle counts", [True], 800, n=2)
for n in range(SPINDLES):
    case(f"FP-027: a start of spindle {n}", [True], 300, n=n)
    case(f"FP-027: another speed of spindle {n}", [True], 400, n=n)
order(0, n=5, wait=1)
case("FP-027: the stop of a spindle", [True], n=5)
order(500, n=2, wait=1)
case("FP-027: a spindle that stopped before is not waited for", [False], n=5)
order(0, n=6)
order(600, n=2, wait=1)
case("FP-027: nor one whose stop is no reason to wait", [False], n=6)
order(700, n=2, wait=1)
for n in (2, 5, 7):
    m.set(f"spindle.{n}.at-speed", 0)
m.set("spindle.2.speed-in", 1.5)
start = m.get("joint.1.pos-cmd")
m.line(m.get("joint.0.pos-cmd"), 20, 0, vel=200, id=77)
m.sleep(9.9)
eq(m.errors(), [], "FP-027: nothing is told of a spindle that gets to its speed in time")
m.sleep(5)
eq(m.errors(), [f"line 77 waits for spindle.{n}.at-speed since 10 s: {rpm} rpm are commanded, {real} measured\n"
                for n, rpm, real in ((2, 700, 90), (7, 400, 0))],
   "FP-027: a wait that does not end is told once, with each spindle that is not at its speed")
for n in (2, 7):
    eq(m.get("joint.1.pos-cmd"), start, f"FP-027: the move begins before spindle {n} is at its speed")
    m.set(f"spindle.{n}.at-speed", 1)
    m.sleep(0.1)
m.rest()
m.set("spindle.5.at-speed", 1)
eq(m.get("joint.1.pos-cmd"), 20.0, "FP-027: the move goes on")
m.line(m.get("joint.0.pos-cmd"), 0, 0, vel=200, kind=1)
m.rest()
order(900, wait=0)
case("an order without a wait", [False])
order(2000, css=30000.0, wait=1)
case("surface speed: the first feed", [True])
for _ in range(2):
    case("surface speed: a rapid", [False], kinds=(1,))
    case("surface speed: the feed after it", [True])
    case("surface speed: a feed after a feed", [False])
# an abort of a wait after a stop says what to look at
order(0, wait=1)
m.set("spindle.0.at-speed", 0)
m.line(50, 0, 0, vel=200)
m.sleep(0.1)
m.errors()
m.send(km.ABORT)
m.rest()
eq(m.errors(), ["Aborted while waiting for spindle 0 at-speed after a spindle stop. Check that spindle.0.at-speed "
                "is connected and "
                "goes true once the spindle has stopped."], "abort of a wait")
m.line(40, 0, 0, vel=200)
m.rest()
eq(round(m.get("joint.0.pos-cmd"), 9), 40.0, "after an abort nothing waits")
m.close()
eq([x.strip() for x in open(log.name) if "motion: line 77 waits" in x],
   [f"motion: line 77 waits for spindle.{n}.at-speed" for n in (2, 7)],
   "FP-027: the log names each spindle of a wait")
print(f"{eq.checks} checks")
