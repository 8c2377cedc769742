# SPDX-License-Identifier: GPL-2.0-or-later
"""Home-all in the order of HOME_SEQUENCE with gaps, joints that take no part, single joints; a
second request while homing for every pair of joints (FP-049); unhoming and its refusals, volatile
homes; locking indexers; home-all ends in teleop mode; FP-057 (moved by hand while off)."""
import kerf_motion as km
from rig import ABSOLUTE, NO_REHOME, UNLOCK_FIRST, Report, Rig

r = Report()
N = 5
m = Rig(N, axes="xyzab", low=-200.0, high=200.0, motmod="unlock_joints_mask=0x10",
        hw={"all": dict(home_from=10, hysteresis=0.05)}, ferror=0.5,
        hal_lines=["loadrt timedelay", "addf timedelay.0 servo-thread", "setp timedelay.0.on-delay 0.05",
                   "setp timedelay.0.off-delay 0.05", "net unlock joint.4.unlock => timedelay.0.in",
                   "net unlocked timedelay.0.out => joint.4.is-unlocked"])


def order(seen_at):
    """Groups of joints that started together, in the order of their starts."""
    out = []
    for t in sorted(set(seen_at.values())):
        out.append(tuple(j for j in range(N) if seen_at.get(j) == t))
    return out


def home_all(sequences, joint=-1, fresh=True, **params):
    """Returns the order of starts and who is homed."""
    if fresh:
        m.unhome()
    m.free()
    for j, seq in enumerate(sequences):
        m.set_home(j, home_sequence=seq, offset=0.0, home=1.0 + j, **params)
    m.sleep(0.01)
    m.errors()
    starts = {}

    def watch(rig):
        for j in range(N):
            if j not in starts and rig.state(j) != "IDLE":
                starts[j] = rig.now()

    m.run_home(joint, 60, watch)
    return order(starts), [j for j in range(N) if m.homed(j)]


def case(sequences, starts, homed, joint=-1, **more):
    got = home_all(sequences, joint, **more)
    r.check(got == (starts, homed), f"{sequences} joint {joint}: {got} instead of {(starts, homed)} {m.errors()}")


m.enable()
ALL = [0, 1, 2, 3, 4]
case([0, 1, 2, 3, 4], [(0,), (1,), (2,), (3,), (4,)], ALL)
r.check(m.status()["motion_state"] == 2, "home-all does not end in teleop mode")
r.check(m.get("motion.is-all-homed"), "is-all-homed")
case([1, 1, 1, 2, 2], [(0, 1, 2), (3, 4)], ALL)
case([4, 3, 2, 1, 0], [(4,), (3,), (2,), (1,), (0,)], ALL)
case([0, 1, 3, 4, 5], [(0,), (1,)], [0, 1])              # a gap ends it
case([2, 3, 4, 5, 6], [], [])                            # the first number is 0 or 1
case([0, 0, 999, 101, 1], [(0, 1), (4,)], [0, 1, 4])     # 101 and more take no part
r.check(m.status()["motion_state"] == 1, "not all are homed, but the mode changed")
case([0, 1, -2, 2, 3], [(0,), (1,), (2, 3), (4,)], ALL)  # a negative number makes its group negative
case([0, 1, -2, -2, 3], [(2, 3)], [2, 3], joint=2)       # one of a group: all of it
case([0, 1, -2, 2, 3], [(2, 3)], [2, 3], joint=3)
case([5, 5, 5, 5, 999], [(4,)], [4], joint=4)            # a single joint whatever its number
case([5, 5, 5, 5, 999], [(1,)], [1, 4], joint=1, fresh=False)
case([100, 100, 100, 100, 100], [], [])

# FP-049: every pair: the second request is refused, the first one ends as if it had been alone
for a in range(N):
    for b in range(-1, N):
        m.unhome()
        for j in range(N):
            m.set_home(j, home_sequence=j, search_vel=20.0, latch_vel=2.0, home=0.0, offset=0.0)
        m.place(a, 0.0)
        m.errors()
        m.ask_home(a)
        m.wait(lambda s: m.state(a) == "SEARCH_WAIT", "searching")
        m.ask_home(b)
        m.send(km.JOG_CONT, joint=b % N, axis=-1, vel=10)
        m.sleep(0.01)
        got = m.errors()
        r.check(got == ["Homing not possible until current homing process is finished.\n",
                        "Can't jog any joints while homing."], f"{a} then {b}: {got}")
        m.wait(lambda s: not m.homing(), "homed", 30)
        r.check([j for j in range(N) if m.homed(j)] == [a], f"{a} then {b}: homed")
        r.near(m.get(f"joint.{a}.pos-cmd"), 0.0, f"{a} then {b}: position")
        # the moment homing ends the next request is taken (FP-059)
        c = (a + 1) % N
        m.set_home(c, home_sequence=c, home=3.0)
        m.wait(lambda s: s["inpos"], "at rest")
        m.ask_home(c)
        m.sleep(0.003)
        r.check(m.homing() and not m.errors(), f"{c} after {a}: refused")
        m.wait(lambda s: not m.homing(), "homed", 30)

# unhoming
for j in range(N):
    m.set_home(j, home_sequence=0, volatile_home=j % 2)
m.run_home()
m.mode(km.TELEOP)


def refused(joint, text):
    m.errors()
    before = [m.homed(j) for j in range(N)]
    m.send(km.JOINT_UNHOME, joint=joint)
    m.sleep(0.005)
    got = m.errors()
    r.check(got == [text], f"unhome {joint}: {got}")
    r.check(before == [m.homed(j) for j in range(N)], f"unhome {joint}: changed")


refused(1, "must be in joint mode or disabled to unhome")
m.free()
refused(N, f"Cannot unhome invalid joint {N} (max {N - 1})\n")
m.send(km.JOG_CONT, joint=2, axis=-1, vel=5)
m.sleep(0.1)
refused(2, "Cannot unhome while moving, joint 2\n")
refused(-1, "Cannot unhome while moving, joint 2")
m.send(km.JOG_ABORT, joint=2, axis=-1)
m.rest()
m.set_home(3, search_vel=5.0, latch_vel=1.0, volatile_home=1)
m.ask_home(3)
m.sleep(0.3)
refused(3, "Cannot unhome while homing, joint 3\n")
refused(-2, "Cannot unhome while homing, joint 3")
m.wait(lambda s: not m.homing(), "homed", 60)
m.sleep(0.01)
m.unhome(1)
r.check([m.homed(j) for j in range(N)] == [True, False, True, True, True], "unhome 1")
m.run_home(1)
m.mode(km.TELEOP)
m.disable()
m.send(km.JOINT_UNHOME, joint=-2)  # what task sends when the machine goes off
m.sleep(0.005)
r.check([m.homed(j) for j in range(N)] == [True, False, True, False, True], "volatile homes")
r.check(not m.status()["teleop"], "unhomed, but still in teleop mode")
m.enable()
r.check(m.status()["motion_state"] == 1, "not in free mode")
m.unhome(-1)
r.check(not any(m.homed(j) for j in range(N)), "unhome all")

# a locking indexer: unlocked before it moves, locked afterwards and after an abort
m.set_home(4, search_vel=20.0, latch_vel=2.0, flags=UNLOCK_FIRST)
m.place(4, 0.0)
moved_locked = []


def watch(rig):
    if abs(rig.get("joint.4.vel-cmd")) > 0 and not rig.get("joint.4.is-unlocked"):
        moved_locked.append(rig.state(4))


seen, ok = m.run_home(4, 60, watch)
r.check(ok and not moved_locked, f"indexer {ok} moved while locked in {moved_locked}")
r.check(seen[4][1:4] == ["UNLOCK", "UNLOCK_WAIT", "SEARCH_START"] and "LOCK_WAIT" in seen[4], f"indexer {seen[4]}")
r.check(not m.get("joint.4.unlock") and not m.get("joint.4.is-unlocked"), "indexer not locked")
m.place(4, 0.0)
m.ask_home(4)
m.sleep(0.4)
r.check(m.get("joint.4.unlock"), "indexer not unlocked")
m.send(km.ABORT)
m.sleep(0.3)
r.check(not m.get("joint.4.unlock") and not m.homed(4), "indexer after an abort")
m.errors()
m.send(km.JOG_CONT, joint=4, axis=-1, vel=5)
m.sleep(0.05)
r.check(len(m.errors()) == 1 and m.get("joint.4.vel-cmd") == 0, "indexer can be jogged")

# absolute encoders are homed again only after unhoming; home-all leaves them alone
for j in range(N):
    m.set_home(j, home_sequence=0, offset=2.0, home=2.0 + j, flags=(ABSOLUTE | NO_REHOME) if j < 2 else 0)
m.unhome()
m.run_home()
r.check(m.homed(), f"absolute and others {m.errors()}")
m.free()
m.set_home(0, home_sequence=0, offset=90.0, home=0.0, flags=ABSOLUTE | NO_REHOME)
at = m.at(0)
seen, ok = m.run_home(0, 5)
r.check(ok and m.at(0) == at and seen[0] == ["IDLE"], f"absolute encoder homed again {seen[0]}")

# a joint that is deactivated while it homes ends homing instead of hanging it
m.unhome()
for j in range(N):
    m.set_home(j, home_sequence=j, search_vel=20.0, latch_vel=2.0)
m.place(0, 0.0)
m.ask_home()
m.until(lambda: m.state(0) == "SEARCH_WAIT", "searching")
m.send(km.JOINT_DEACTIVATE, joint=0)
m.sleep(0.3)
r.check(not m.homing() and m.get("joint.1.vel-cmd") == 0, "a deactivated joint hangs homing")
m.send(km.JOINT_ACTIVATE, joint=0)
for j in range(N):
    m.set_home(j, home_sequence=0)
m.enable()
m.sleep(0.1)
m.errors()
m.run_home()
r.check(m.homed(), f"not homed after an activation {m.errors()}")

# FP-057: moved by hand while off: no jump and no error at the next machine-on, in each mode
for mode in (km.FREE, km.TELEOP, km.COORD):
    m.mode(mode)
    for way in (0.3, -7.0, 25.0):
        m.disable()
        where = []
        for j in range(N):
            m.hw(j, hand_vel=way * (1 + j / 10) / 0.05)
        m.sleep(0.05)
        for j in range(N):
            m.hw(j, hand_vel=0)
        m.sleep(0.003)
        where = [m.at(j) for j in range(N)]
        m.errors()
        m.reset_limits()
        m.enable()
        m.sleep(0.1)
        r.check(max(abs(m.at(j) - where[j]) for j in range(N)) < 1e-9, f"mode {mode} by hand {way}: jump")
        r.check(not m.errors() and m.status()["enabled"], f"mode {mode} by hand {way}: error {m.errors()}")
        r.check(not m.violations(), f"mode {mode} by hand {way}: {m.violations()}")
        pose = m.status()["carte_pos_cmd"]
        r.check(all(abs(pose[j] - m.get(f"joint.{j}.pos-cmd")) < 1e-9 for j in range(N)), f"mode {mode}: axes {pose}")
m.mode(km.FREE)
# changes of offset, home and sequence at run time (ini.N.home... pins)
m.send(km.UPDATE_JOINT_HOMING_PARAMS, joint=2, offset=7.0, home=8.0, home_sequence=0)
m.run_home(2)
r.near(m.get("joint.2.pos-cmd"), 8.0, "updated HOME")
m.send(km.UPDATE_JOINT_HOMING_PARAMS, joint=2, offset=7.0, home=8.0, home_sequence=-3)
m.send(km.UPDATE_JOINT_HOMING_PARAMS, joint=3, offset=7.0, home=8.0, home_sequence=3)
m.errors()
m.send(km.JOG_CONT, joint=3, axis=-1, vel=5)
m.sleep(0.02)
r.check(m.errors() != [] and m.get("joint.3.vel-cmd") == 0, "a group made at run time is not one")
r.finish()
