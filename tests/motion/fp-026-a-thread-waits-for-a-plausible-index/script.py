# Threads on a wheel with a missing tooth, whose gap is seen where there is none when the spindle slows down (FP-026): a
# thread begins only after an index that came a whole number of revolutions after the one before, always at the same
# angle. Where no such index comes the move ends before it begins, and the operator is told.
import math

import hal
import kerf_motion as km
from motion_bench import Machine

TEETH, PITCH = 24, 2.0
HAL = ["loadrt sim_encoder num_chan=1", "loadrt encoder num_chan=1", "loadrt and2", "loadrt not count=2",
       "loadrt flipflop", f"setp sim-encoder.0.ppr {TEETH}", f"setp encoder.0.position-scale {TEETH}",
       "setp encoder.0.counter-mode 1", "setp encoder.0.missing-teeth 1",
       # tooth 0 is missing: its phase A does not get through
       "net a sim-encoder.0.phase-A => and2.0.in0 not.0.in", "net b not.0.out => flipflop.0.reset",
       "net z sim-encoder.0.phase-Z => flipflop.0.set", "net gap flipflop.0.out => not.1.in",
       "net tooth not.1.out => and2.0.in1", "net wheel and2.0.out => encoder.0.phase-A", "newsig noise bit",
       "net noise => encoder.0.phase-Z", "net rps spindle.0.speed-out-rps => sim-encoder.0.speed",
       "net revs encoder.0.position => spindle.0.revs", "net index encoder.0.index-enable <=> spindle.0.index-enable"]
HAL += [f"addf {f} servo-thread {n}" for n, f in enumerate(
    ["sim-encoder.update-speed", "sim-encoder.make-pulses", "not.0", "flipflop.0", "not.1", "and2.0",
     "encoder.update-counters", "encoder.capture-position"], 1)]
m = Machine(vel=60.0, acc=600.0, hal_lines=HAL)
m.mode(km.COORD)


def spindle(rpm): m.send(km.SPINDLE_ON, spindle=0, vel=rpm, state=1, ini_maxvel=0, acc=0, wait_for_spindle_at_speed=0)


def z(): return m.get("joint.2.pos-cmd")


def thread(end):
    """Cuts to Z end, from 0. Returns the angle of the wheel where the thread begins, in
    revolutions, and what was told."""
    m.send(km.SET_SPINDLESYNC, spindle=0, spindlesync=PITCH, flags=0)
    m.line(0, 0, end, vel=60, acc=600)
    m.send(km.SET_SPINDLESYNC, spindle=0, spindlesync=0, flags=0)
    angle = []
    while not (s := m.status())["inpos"] or s["depth"]:
        m.sleep(0.001)
        hal.set_s("noise", str(int(noisy and m.now() % 0.37 < 0.1)))
        if end * 0.5 > z() > end * 0.9:
            angle.append(2 * math.pi * (m.get("sim-encoder.0.rawcounts") / (4 * TEETH) + z() / PITCH))
    told = m.errors()
    m.send(km.ABORT)
    m.line(0, 0, 0, vel=60, acc=600, kind=1)
    m.rest()
    return math.atan2(sum(map(math.sin, angle)), sum(map(math.cos, angle))) / (2 * math.pi), told


noisy = False
spindle(240)
m.sleep(3)
reference, told = thread(-16)
assert not told, told
for wait in (0.03, 0.11, 0.19, 0.26, 0.32):
    spindle(240)
    m.sleep(2 + wait)
    spindle(30)  # teeth come eight times as slowly: each looks like a gap
    angle, told = thread(-8)
    assert not told, told
    off = (angle - reference + 0.5) % 1 - 0.5
    assert abs(off) < 0.06, f"slowed down {wait} s later: the thread begins {off:.3f} revolutions beside its place"
print("threads begin at the same angle")
noisy = True
spindle(60)
m.sleep(2)
told = thread(-8)[1]
assert len(told) == 1 and told[0].startswith("line 1: spindle 0 gives its index ") and "not once a revolution" in told[0], told
assert m.get("joint.2.pos-cmd") == 0 and not m.get("spindle.0.index-enable")
print("a move without a plausible index is refused")
m.close()
