# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints of a group (equal negative HOME_SEQUENCE) home together. FP-054, FP-055: the gantry ends
square whichever side trips first and however it was racked, the sides never are farther apart than
they were plus what one switch comes earlier plus the stop; a side whose switch never comes stops
all joints; joint jogs of a side are refused; homing one side homes all."""
import kerf_motion as km
from rig import USE_INDEX, Report, Rig

r = Report()
ACC = 500.0
m = Rig(4, axes="xyz", kins="trivkins coordinates=xyyz kinstype=both", acc=ACC, low=-200.0, high=200.0,
        hw={"all": dict(hysteresis=0.05, home_from=50)})
SEARCH, LATCH = 20.0, 2.0
STOP = SEARCH ** 2 / (2 * ACC) + SEARCH * 0.003


def settings(y0, y1):
    m.set_home(0, home_sequence=2, offset=5.0)
    m.set_home(3, home_sequence=1, offset=5.0)
    m.set_home(1, **y0)
    m.set_home(2, **y1)


def home(title, start, y0, y1, switches=(50.0, 50.0), joint=-1, square=True, hw=({}, {}), bounce=0, fails=False,
         rack=0.0, apart=None):
    """start: places of the two sides. Compared with the first difference the sides may part by
    the distance of the switches and a stop."""
    m.unhome()
    for j in (1, 2):
        m.hw(j, **dict(dict(stuck=0, index_pitch=0, bounce_ms=bounce), **hw[j - 1]))
        m.hw(j, home_from=switches[j - 1], home_to=1e9)
        m.set(f"joint.{j}.home-rack-max", rack)
        m.place(j, start[j - 1])
    settings(y0, y1)
    m.sleep(0.01)
    m.errors()
    allowed = max(abs(start[0] - start[1]), abs(switches[0] - switches[1])) + STOP if apart is None else apart
    worst = [0.0]
    order = []

    def watch(rig):
        worst[0] = max(worst[0], abs(rig.at(1) - rig.at(2)))
        pair = (rig.state(1), rig.state(2))
        if not order or order[-1] != pair:
            order.append(pair)

    seen, ok = m.run_home(joint, 60, watch)
    done = m.homed(1) and m.homed(2)
    m.told = m.errors()
    r.check(done != fails, f"{title}: homed {done}; {m.told} {order}")
    r.check(worst[0] <= allowed, f"{title}: apart by {worst[0]:.3f}, allowed {allowed:.3f}")
    r.check(not m.violations(), f"{title}: {m.violations()}")
    if fails:
        r.check(m.get("joint.1.vel-cmd") == 0 and m.get("joint.2.vel-cmd") == 0, f"{title}: still moves")
        return
    for j in (1, 2):
        r.near(m.get(f"joint.{j}.pos-cmd"), 0.0, f"{title}: joint {j}")
    if square:
        r.near(m.at(1) - m.at(2), switches[0] - switches[1] if square == "switches" else 0.0, f"{title}: square",
               LATCH * (0.004 + bounce * 1e-3))
    # never one side in the latch move while the other one still searches
    for a, b in order:
        for x, y in ((a, b), (b, a)):
            r.check(not (x in ("FINAL_BACKOFF_WAIT", "RISE_WAIT", "FALL_WAIT", "FINAL_WAIT") and
                         y in ("SEARCH_START", "SEARCH_WAIT", "BACKOFF_START", "BACKOFF_WAIT")),
                         f"{title}: {x} beside {y}")
    r.check(("FINAL_WAIT", "FINAL_START") not in order and ("FINAL_START", "FINAL_WAIT") not in order,
            f"{title}: final moves not together: {order}")
    if joint >= 0:
        r.check(not m.homed(0) and not m.homed(3), f"{title}: others were homed")


def y(seq, **more):
    return dict(dict(search_vel=SEARCH, latch_vel=LATCH, offset=52.0, home=0.0, home_sequence=seq), **more)


# every start: square, racked either way, one or both sides on the switch
for a, b in ((0, 0), (0, 3), (3, 0), (0, 12), (12, 0), (51, 51), (51, 48), (48, 51), (55, 51)):
    for latch in (LATCH, -LATCH):
        home(f"start {a} {b} latch {latch}", (a, b), y(-3, latch_vel=latch), y(-3, latch_vel=latch), joint=1)
# mixed signs are a group; switches out of line are made up for by the offsets
home("mixed signs", (0, 3), y(3), y(-3), joint=1)
home("mixed signs, the other one asked", (3, 0), y(3), y(-3), joint=2)
home("switches out of line", (0, 0), y(-3), y(-3, offset=53.5), switches=(50.0, 51.5), joint=1)
home("switches out of line, racked", (4, 0), y(-3), y(-3, offset=53.5), switches=(50.0, 51.5), joint=2)
index = dict(index_pitch=5.0, index_at=1.0)
home("index on both", (0, 2), y(-3, flags=USE_INDEX), y(-3, flags=USE_INDEX), joint=1, hw=(index, index))
for latch in (LATCH, -LATCH):
    home(f"bouncing switches, latch {latch}", (0, 2), y(-3, latch_vel=latch), y(-3, latch_vel=latch),
         joint=1, bounce=20)
# a switch that never comes: both sides stop, within the settable distance
for dead in (0, 1):
    hw = [{}, {}]
    hw[dead] = dict(stuck=-1)
    home(f"side {dead} dead", (0, 0), y(-3), y(-3), joint=1, hw=hw, fails=True, rack=6.0, apart=6.0 + STOP)
    got = m.told
    r.check(got == [f"j{dead + 1} end of move in home state 7",
                    f"joint.{dead + 1}.home-sw-in is later than its partner's by more than "
                    f"joint.{dead + 1}.home-rack-max"],
            f"side {dead} dead: {got}")
for j in (1, 2):
    m.hw(j, stuck=0)
    m.set(f"joint.{j}.home-rack-max", 0)
# home-all: 0, 1 (z), 2 (x), 3 (both y); all homed, then nothing can jog one side
m.unhome()
settings(y(-3), y(-3))
m.place(1, 0.0)
m.place(2, 2.0)
seen, ok = m.run_home()
r.check(ok, f"home-all: {m.errors()} {seen}")
m.free()
m.errors()
for homed in (True, False):
    for j in (1, 2):
        for kind in (km.JOG_CONT, km.JOG_INCR, km.JOG_ABS):
            before = m.at(1), m.at(2)
            m.send(kind, joint=j, axis=-1, vel=5.0, offset=1.0)
            m.sleep(0.05)
            r.check((m.at(1), m.at(2)) == before, f"jog {kind} of side {j} homed {homed} moves it")
            r.check(len(m.errors()) == 1, f"jog {kind} of side {j}: no message")
        m.set(f"joint.{j}.jog-enable", 1)
        m.set(f"joint.{j}.jog-scale", 0.1)
        m.set(f"joint.{j}.jog-counts", m.get(f"joint.{j}.jog-counts") + 20)
        m.sleep(0.05)
        r.check((m.at(1), m.at(2)) == before, f"wheel jog of side {j} homed {homed} moves it")
        r.check(len(m.errors()) >= 1, f"wheel of side {j}: no message")
        m.set(f"joint.{j}.jog-enable", 0)
    m.unhome()
# unhomed and racked: in teleop the sides move as one
settings(y(-3), y(-3))
m.place(1, 0.0)
m.place(2, 2.0)
m.run_home()
m.mode(km.TELEOP)
apart = m.at(1) - m.at(2)
m.send(km.JOG_INCR, joint=-1, axis=1, vel=20.0, offset=15.0)
worst = 0.0
for _ in range(1500):
    m.sleep(0.001)
    worst = max(worst, abs(m.at(1) - m.at(2) - apart))
r.near(m.get("joint.1.pos-cmd"), 15.0, "jogged")
r.check(worst < 1e-9, f"sides part by {worst} in a jog")
r.check(not m.violations(), str(m.violations()))
r.finish()
