# SPDX-License-Identifier: GPL-2.0-or-later
"""A limit switch that trips (for good, or for an instant), an amplifier fault and an abort on one
side of a gantry, in every phase of homing in which the sides are seen together: both sides stop at
once, neither is homed, one message names the side, nothing goes on by itself; with the cause
removed the gantry homes. FP-051, FP-055."""
import kerf_motion as km
from rig import USE_INDEX, Report, Rig

r = Report()
ACC, SEARCH, LATCH, FINAL = 500.0, 20.0, 2.0, 30.0
m = Rig(3, axes="xy", kins="trivkins coordinates=xyy kinstype=both", acc=ACC, low=-200.0, high=200.0,
        hw={"all": dict(hysteresis=0.05, home_from=10, index_pitch=5.0, index_at=1.0)})
SIDES = (1, 2)


def prepare(start, latch, flags):
    m.unhome()
    for j, at, offset in ((1, start[0], 12.0), (2, start[1], 14.0)):
        m.place(j, at)
        m.set_home(j, home_sequence=-1, search_vel=SEARCH, latch_vel=latch, offset=offset, home_final_vel=FINAL,
                   flags=flags)
    m.set_home(0, home_sequence=2)
    m.sleep(0.01)
    m.errors()


def pair():
    return m.state(1), m.state(2)


def pairs(start, latch, flags):
    """The pairs of states of a run without a fault that last longer than a few cycles."""
    prepare(start, latch, flags)
    last = {}

    def watch(rig):
        last[pair()] = last.get(pair(), 0) + 1

    seen, ok = m.run_home(1, watch=watch)
    r.check(ok and m.homed(2), f"{start} {latch}: not homed without a fault: {m.errors()} {seen}")
    m.free()
    return [p for p, cycles in last.items() if cycles > 6 and p != ("IDLE", "IDLE")]


def trip(way, side):
    if way == "limit":
        m.hw(side, pos_lim_at=-1e9)
    elif way == "limit for an instant":
        m.hw(side, neg_lim_at=1e9)
        m.sleep(0.002)
        m.hw(side, neg_lim_at=-1e9)
    elif way == "amplifier":
        m.set(f"joint.{side}.amp-fault-in", 1)
    else:
        m.send(km.ABORT)


def told(way, side, messages):
    if way == "abort":
        return not messages
    starts = [f"joint {side} amplifier fault"] if way == "amplifier" else [f"j{side} hit limit in home state ",
                                                                             f"hit limit in home state j={side}"]
    after = [f"joint {side} on limit switch error"]  # a switch that is still on: the machine goes off
    more = [after] if way == "limit" else [[], after] if way == "limit for an instant" else [[]]
    return messages[1:] in more and any(messages[:1] and messages[0].startswith(s) for s in starts)


def case(start, latch, flags, at, way, side):
    name = f"{start} latch {latch}, {way} of {side} in {at}"
    prepare(start, latch, flags)
    m.ask_home(1)
    m.until(lambda: pair() == at, at)
    m.sleep(0.003)
    trip(way, side)
    m.sleep(0.003 + (0 if way == "amplifier" else max(SEARCH, FINAL) / ACC))
    before = m.at(1), m.at(2)
    r.check(all(m.get(f"joint.{j}.vel-cmd") == 0 for j in SIDES), f"{name}: a side still moves")
    r.check(not any(m.get(f"joint.{j}.index-enable") for j in SIDES), f"{name}: index still asked for")
    r.check(not m.homing() and pair() == ("IDLE", "IDLE"), f"{name}: still homing {pair()}")
    r.check(not any(m.get(f"joint.{j}.homed") for j in SIDES), f"{name}: a side is homed")
    m.sleep(0.25)
    r.check(before == (m.at(1), m.at(2)), f"{name}: a side moves again")
    got = m.errors()
    r.check(told(way, side, got), f"{name}: {got}")
    r.check(not m.violations(), f"{name}: {m.violations()}")
    m.hw(side, pos_lim_at=1e9)
    m.set(f"joint.{side}.amp-fault-in", 0)
    m.enable()
    m.errors()
    m.ask_home(3 - side)
    m.sleep(0.01)
    m.until(lambda: not m.homing(), "homed again")
    r.check(m.homed(1) and m.homed(2), f"{name}: not homed afterwards {m.errors()}")
    r.near(m.at(1) + 2.0, m.at(2) + 4.0, f"{name}: not square afterwards", 3 * LATCH * 0.003 + 0.05)
    m.free()


tried = set()
for start, latch, flags in (((0, 3), LATCH, 0), ((3, 0), -LATCH, 0), ((12, 15), LATCH, 0), ((0, 3), LATCH, USE_INDEX)):
    for at in pairs(start, latch, flags):
        if at in tried:
            continue
        tried.add(at)
        for way in ("limit", "limit for an instant", "amplifier", "abort"):
            for side in SIDES if way != "abort" else (1,):
                case(start, latch, flags, at, way, side)
for phase in ("BACKOFF_WAIT SEARCH_WAIT FINAL_BACKOFF_WAIT RISE_WAIT FALL_WAIT INDEX_WAIT FINAL_WAIT").split():
    for j in (0, 1):
        r.check(any(p[j] == phase for p in tried), f"{phase} of side {j + 1} was not tried")
r.finish()
