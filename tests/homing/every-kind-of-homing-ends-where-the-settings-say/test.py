# SPDX-License-Identifier: GPL-2.0-or-later
"""Every combination of search, latch and index, from every side of the switch, with and without
bouncing contacts, lag of the drive and HOME different from the offset: which states are gone
through, where the coordinate's zero lies on the slide, and that limits hold on the way."""
from rig import ABSOLUTE, NO_ENCODER_RESET, NO_FINAL_MOVE, NO_REHOME, USE_INDEX, Report, Rig

r = Report()
m = Rig(1, hw={0: dict(hysteresis=0.05)}, low=-200.0, high=200.0)
T = 0.001

SEARCH = ["SEARCH_START", "SEARCH_WAIT"]
BACK = ["SEARCH_START", "BACKOFF_START", "BACKOFF_WAIT", "SEARCH_START", "SEARCH_WAIT"]
FINAL = ["FINAL_WAIT"]


def one(title, states, zero, tolerance, start=0.0, hw=None, **params):
    """Homes from start; zero: where on the slide joint position 0 has to be."""
    hw = dict(dict(home_from=10, home_to=1e9, index_pitch=0, bounce_ms=0, time_constant=0, index_reset=1), **(hw or {}))
    m.hw(0, **hw)
    m.unhome()
    m.place(0, start)
    m.errors()
    m.set_home(0, **params)
    seen, ok = m.run_home()
    m.sleep(10 * hw["time_constant"])
    r.check(ok, f"{title}: not homed; {seen[0]} {m.errors()}")
    shown = [s for s in seen[0] if s not in ("IDLE", "START", "UNLOCK_WAIT", "FINAL_START")]
    if states is not None:
        r.check(shown == states, f"{title}: states {shown}, expected {states}")
    if not params.get("flags", 0) & NO_FINAL_MOVE:
        r.near(m.get("joint.0.pos-cmd"), params.get("home", 0.0), f"{title}: final position")
    r.near(m.at(0) - m.get("joint.0.pos-cmd"), zero, f"{title}: zero on the slide", tolerance)
    r.check(not m.violations(), f"{title}: {m.violations()}")
    r.check(not m.errors(), f"{title}: messages")
    r.check(not m.get("joint.0.index-enable"), f"{title}: index still asked for")


LATCH = 2.0
STEP = LATCH * T * 3  # the switch is seen a cycle late, and the position is that of the cycle before
for start in (0.0, 9.9, 15.0):
    for home, offset in ((0.0, 0.0), (-3.0, 2.5)):
        for hw in ({}, dict(bounce_ms=15), dict(time_constant=0.005)):
            name = f"from {start} home {home} offset {offset} {hw}"
            way = BACK if start > 10 else SEARCH
            tol = STEP + (LATCH * 0.005 if hw.get("time_constant") else 0) + (LATCH * 0.03
                                                                              if hw.get("bounce_ms") else 0)
            states = None if hw.get("bounce_ms") else way
            after = ["FINAL_BACKOFF_START", "FINAL_BACKOFF_WAIT", "RISE_START", "RISE_WAIT"]
            one(f"rising edge {name}", states and way + after + FINAL, 10 - offset, tol, start, hw,
                search_vel=20.0, latch_vel=LATCH, home=home, offset=offset)
            one(f"falling edge {name}", states and way + ["FALL_START", "FALL_WAIT"] + FINAL, 9.95 - offset, tol,
                start, hw, search_vel=20.0, latch_vel=-LATCH, home=home, offset=offset)
            index = dict(hw, index_pitch=4.0, index_at=1.3)
            one(f"rising edge, index {name}", states and way + after + ["INDEX_WAIT"] + FINAL, 13.3 - offset, 1e-6,
                start, index, search_vel=20.0, latch_vel=LATCH, home=home, offset=offset, flags=USE_INDEX)
            one(f"falling edge, index {name}", states and way + ["FALL_START", "FALL_WAIT", "INDEX_WAIT"] + FINAL,
                9.3 - offset, 1e-6, start, index, search_vel=20.0, latch_vel=-LATCH, home=home, offset=offset,
                flags=USE_INDEX)
            one(f"falling edge, index that does not reset {name}", None, 9.3 - offset, tol, start,
                dict(index, index_reset=0), search_vel=20.0, latch_vel=-LATCH, home=home, offset=offset,
                flags=USE_INDEX | NO_ENCODER_RESET)

for direction in (1, -1):
    index = dict(index_pitch=4.0, index_at=1.3, home_from=1e9)
    one(f"index only, direction {direction}", ["INDEX_ONLY_START", "INDEX_WAIT"] + FINAL,
        (9.3 if direction > 0 else 5.3) - 1.5, 1e-6, 7.0, index, latch_vel=direction * 1.0, offset=1.5, flags=USE_INDEX)
    one(f"switch at the other end, direction {direction}", None, 10.0 * direction, STEP, 0.0,
        dict(home_from=10 if direction > 0 else -1e9, home_to=1e9 if direction > 0 else -10),
        search_vel=30.0 * direction, latch_vel=LATCH * direction)

one("at once", FINAL, 17.0 - 4.0, 1e-9, 17.0, None, offset=4.0, home=6.0)
one("at once, no way to go", FINAL, 17.0 - 6.0, 1e-9, 17.0, None, offset=6.0, home=6.0)
encoder_zero = m.at(0) - m.get("sim-joint.0.fb")
for n in range(3):  # FP-058: however often, the same coordinate
    one(f"absolute encoder, time {n}", FINAL, encoder_zero - 3.0, 1e-9, 17.0 + n, None, offset=3.0, home=5.0,
        flags=ABSOLUTE | NO_REHOME)
    one(f"absolute encoder without move, time {n}", [], encoder_zero - 3.0, 1e-9, 17.0 + n, None, offset=3.0, home=5.0,
        flags=ABSOLUTE | NO_REHOME | NO_FINAL_MOVE)
    r.near(m.at(0), 17.0 + n, "the slide stands still")

# final velocity: positive, 0 and -1 are the joint's, greater ones are cut
for final, wanted in ((5.0, 5.0), (0.0, 50.0), (-1.0, 50.0), (500.0, 50.0)):
    m.hw(0, home_from=10, home_to=1e9, index_pitch=0, time_constant=0)
    m.unhome()
    m.place(0, 40.0)
    m.set_home(0, offset=40.0, home=0.0, home_final_vel=final)
    m.reset_limits()
    m.run_home()
    r.near(m.worst()[0][0], wanted, f"final velocity {final}", 0.1)
# search and latch velocities beyond the joint's are cut; feed override has no part in it
m.send(__import__("kerf_motion").FEED_SCALE, scale=0.1)
for search, wanted in ((500.0, 50.0), (12.0, 12.0)):
    m.unhome()
    m.place(0, 0.0)
    m.set_home(0, search_vel=search, latch_vel=1.0, home=10.0, offset=10.0, home_final_vel=3.0)
    m.reset_limits()
    m.run_home()
    r.near(m.worst()[0][0], wanted, f"search velocity {search}", 0.1)
r.check(not m.violations(), str(m.violations()))
r.finish()
