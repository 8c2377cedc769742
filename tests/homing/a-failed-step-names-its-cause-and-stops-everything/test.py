# SPDX-License-Identifier: GPL-2.0-or-later
"""Every way homing can fail: the message, which joints stop, what stays homed, and that the next
request is accepted at once. FP-050, FP-051 (a failed step ends the sequence, all joints stop),
FP-052 (dead or stuck switches: bounded moves, the switch is named), FP-056 (never farther onto a
tripped limit), FP-059 (status clears on every path)."""
import math

import kerf_motion as km
from rig import IGNORE_LIMITS, IS_SHARED, USE_INDEX, Report, Rig

r = Report()
ACC = 500.0
m = Rig(3, hw={"all": dict(home_from=10, hysteresis=0.05, pos_lim_at=60, neg_lim_at=-60)}, acc=ACC,
        low=-40.0, high=40.0, ferror=5.0)
USUAL = dict(search_vel=20.0, latch_vel=2.0)
OK = dict(home_from=10, home_to=1e9, stuck=0, index_pitch=0, pos_lim_at=60, neg_lim_at=-60, noise=0)


def fresh(joint, start, hw, bounds=(0, 0, 0, 0), **params):
    for j in range(3):
        m.hw(j, **OK)
        m.set_home(j, home_sequence=j, **USUAL)
    m.enable()
    m.unhome()
    for j in range(3):
        m.place(j, start if j == joint else 0.0)
    m.hw(joint, **hw)
    for name, value in zip(("search", "backoff", "latch", "rack"), bounds):
        m.set(f"joint.{joint}.home-{name}-max", value)
    m.set_home(joint, home_sequence=joint, **params)
    m.sleep(0.02)
    m.errors()


def fails(title, messages, start, hw, bounds=(0, 0, 0, 0), way=None, joint=1, break_at=None, events=(), **params):
    """Home-all in which one joint fails. way: how far the slide may have been from its start."""
    fresh(joint, start, hw, bounds, **params)
    farthest = [0.0]
    told = []

    def watch(rig):
        farthest[0] = max(farthest[0], abs(rig.at(joint) - start))
        if break_at and rig.state(joint) == break_at and not told:
            told.append(1)
            for j, pins in events:
                rig.hw(j, **pins)

    if hw.keys() & {"pos_lim_at", "neg_lim_at"}:  # stands on it: only with limits overridden the machine is on
        m.send(km.OVERRIDE_LIMITS, joint=0)
        m.sleep(0.003)
        m.enable()
        m.sleep(0.003)
        m.errors()
    seen, ok = m.run_home(-1, 120, watch)
    r.check(not ok, f"{title}: homed")
    r.check(not m.homed(joint), f"{title}: failed joint says homed")
    r.check(m.homed(0) == (joint > 0), f"{title}: joint 0 homed {m.homed(0)}")
    r.check(seen[2] == ["IDLE"] and not m.homed(2), f"{title}: the next in sequence started: {seen[2]}")
    got = m.errors()
    after = [f"joint {joint} on limit switch error"]  # a switch that is still on: the machine goes off
    r.check(got in (list(messages), list(messages) + after), f"{title}: {got}")
    if way is not None:
        r.check(farthest[0] <= way + 1e-6, f"{title}: moved {farthest[0]:.4f}, allowed {way}")
    before = [m.at(j) for j in range(3)]
    m.sleep(0.5)
    r.check(before == [m.at(j) for j in range(3)], f"{title}: still moves")
    r.check(not m.homing() and not any(s["homing"] for s in m.status()["joint"]), f"{title}: homing not cleared")
    r.check(not m.get(f"joint.{joint}.index-enable"), f"{title}: index still asked for")
    r.check(not m.violations(), f"{title}: {m.violations()}")
    # the machine is as before: with the cause removed it homes
    for j in range(3):
        m.hw(j, **OK)
        m.set_home(j, home_sequence=j, **USUAL)
    for name in ("search", "backoff", "latch", "rack"):
        m.set(f"joint.{joint}.home-{name}-max", 0)
    m.enable()
    if abs(m.at(joint)) > 59:
        m.place(joint, 0.0)
    m.errors()
    seen, ok = m.run_home()
    r.check(ok, f"{title}: not homed afterwards {m.errors()} {seen}")
    m.free()


def hit(n):
    return f"j1 hit limit in home state {n}"


def end(n):
    return f"j1 end of move in home state {n}"


DEAD = "joint.1.home-sw-in stayed FALSE over the whole move: switch, its wiring or the direction"
STUCK = "joint.1.home-sw-in stayed TRUE over the whole move: switch or its wiring"
STOP = 20.0 ** 2 / (2 * ACC) + 0.05

# settings that cannot work
fails("latch without source", ["invalid homing config: non-zero LATCH_VEL needs either SEARCH_VEL or USE_INDEX"],
      0, {}, way=0, latch_vel=2.0)
fails("search without latch", ["invalid homing config: non-zero SEARCH_VEL needs LATCH_VEL"], 0, {}, way=0,
      search_vel=2.0)
# a limit switch in each state that moves; without the ignore flag any switch counts
for start, at, n, params in ((0, "SEARCH_WAIT", 7, USUAL), (20, "BACKOFF_WAIT", 5, dict(search_vel=5.0, latch_vel=2.0)),
                             (5, "FINAL_BACKOFF_WAIT", 10, USUAL), (5, "RISE_WAIT", 12, USUAL),
                             (5, "FALL_WAIT", 14, dict(search_vel=20.0, latch_vel=-2.0)),
                             (5, "INDEX_WAIT", 18, dict(USUAL, flags=USE_INDEX))):
    for end_of in (dict(pos_lim_at=-100), dict(neg_lim_at=100)):
        fails(f"limit in {at} {end_of}", [hit(n)], start, {}, break_at=at, events=[(1, end_of)], **params)
fails("limit in the final move", ["hit limit in home state j=1"], 5, {}, break_at="FINAL_WAIT",
      events=[(1, dict(pos_lim_at=-100))], **dict(USUAL, home=-20.0))
# a limit switch before the start: nothing moves
for start, n, params in ((0, 7, USUAL), (20, 5, USUAL), (0, 18, dict(latch_vel=2.0, flags=USE_INDEX))):
    fails(f"on a limit from {start}", [f"j0 hit limit in home state {n}"], start, dict(pos_lim_at=-100), way=0, joint=0,
          **params)
# FP-056: limits ignored, but the joint stands at that end
for start, hw, n in ((0, dict(pos_lim_at=-100), 7), (20, dict(neg_lim_at=100), 5)):
    fails(f"farther onto the limit from {start}",
          [f"j0 hit limit in home state {n}",
           "joint 0 would move farther onto the limit switch it stands on: jog it off first"],
          start, hw, way=0, joint=0, **dict(USUAL, flags=IGNORE_LIMITS))
# ... and one switch for both ends does not say which end it is, before a back-off, a search and an index move
for start, n, params in ((20, 5, USUAL), (0, 7, USUAL), (0, 18, dict(latch_vel=2.0))):
    fails(f"on the switch of either end from {start}",
          [f"j0 hit limit in home state {n}",
           "joint 0 stands on a limit switch of either end: choose the direction, jog it off first"],
          start, dict(pos_lim_at=-100, neg_lim_at=100), way=0, joint=0,
          **dict(params, flags=IGNORE_LIMITS | (USE_INDEX if n == 18 else 0)))
# FP-052: dead and stuck switches, default and settable bounds
fails("dead switch", [end(7), DEAD], 0, dict(stuck=-1, pos_lim_at=1e9), **USUAL)
fails("dead switch, bounded", [end(7), DEAD], 0, dict(stuck=-1), (7.5, 0, 0, 0), 7.5, **USUAL)
fails("stuck switch, bounded", [end(5), STUCK], 20, dict(stuck=1), (0, 3.5, 0, 0), 3.5, **USUAL)
fails("sticks while it backs off", [end(10), STUCK], 5, {}, (0, 2.0, 0, 0), 5 + STOP,
      break_at="FINAL_BACKOFF_START", events=[(1, dict(stuck=1))], **USUAL)
fails("dead while it latches", [end(12), DEAD], 5, {}, (0, 0, 1.5, 0), 5 + STOP + 1.5,
      break_at="RISE_WAIT", events=[(1, dict(stuck=-1))], **USUAL)
fails("sticks while it latches off", [end(14), STUCK], 5, {}, (0, 0, 1.5, 0), 5 + STOP + 1.5,
      break_at="FALL_WAIT", events=[(1, dict(stuck=1))], **dict(USUAL, latch_vel=-2.0))
NO_INDEX = "joint.1.index-enable stayed TRUE over the whole move: no index came"
fails("no index", [end(18), NO_INDEX], 0, {}, (0, 0, 1.5, 0), 1.5, latch_vel=2.0, flags=USE_INDEX)
fails("no index after the switch", [end(18), NO_INDEX], 5, {}, (0, 0, 3.0, 0), None, **dict(USUAL, flags=USE_INDEX))
# a switch that is not where it was a moment ago
fails("gone before the back-off", ["Home switch inactive before start of backoff move j=1"], 5, {},
      break_at="FINAL_BACKOFF_START", events=[(1, dict(stuck=-1))], **USUAL)
fails("there before the latch", ["Home switch active before start of latch move j=1"], 5, {},
      break_at="RISE_START", events=[(1, dict(stuck=1))], **USUAL)
fails("gone before the latch", ["Home switch inactive before start of latch move j=1"], 5, {},
      break_at="FALL_START", events=[(1, dict(stuck=-1))], **dict(USUAL, latch_vel=-2.0))
fails("shared switch closed", ["Cannot home while shared home switch is closed j=1"], 20, {}, way=0,
      **dict(USUAL, flags=IS_SHARED))
# FP-051: of several that home together the highest, the lowest and the middle one fails
for bad in range(3):
    fresh(bad, 0.0, {}, **USUAL)
    for j in range(3):
        m.set_home(j, home_sequence=1, **USUAL)
    m.ask_home()
    m.wait(lambda s: all(m.state(j) == "SEARCH_WAIT" for j in range(3)), "searching")
    m.sleep(0.2)
    m.hw(bad, pos_lim_at=-100)
    m.sleep(0.001 + 20.0 / ACC + 0.005)
    r.check(all(m.get(f"joint.{j}.vel-cmd") == 0 for j in range(3)), f"joint {bad} fails: others still move")
    got = m.errors()
    r.check(got[:1] == [f"j{bad} hit limit in home state 7"] and not m.homing(), f"joint {bad} fails: {got}")
    m.hw(bad, pos_lim_at=60)
# refused requests change nothing
fresh(1, 0.0, {}, **USUAL)
m.set("motion.homing-inhibit", 1)
m.ask_home(2)
m.sleep(0.05)
r.check(m.errors() == ["Homing denied by motion.homing-inhibit joint=2\n"] and not m.homing(), "inhibit")
m.set("motion.homing-inhibit", 0)
m.disable()
m.ask_home(1)
m.sleep(0.05)
r.check(m.errors() == ["must be in joint mode to home"] and not m.homing(), "off")
m.enable()
m.sleep(0.05)
r.check(not m.homing(), "starts by itself after a request while off")
m.run_home()
m.mode(km.TELEOP)
m.ask_home(0)
m.sleep(0.05)
r.check(m.errors() == ["must be in joint mode to home"] and m.homed(), "teleop")
r.check(math.isfinite(m.at(0)) and not m.violations(), str(m.violations()))
r.finish()
