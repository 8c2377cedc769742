# Locking indexers: unlock, wait, move, lock, wait; what is refused; what happens without pins or after machine off.
import kerf_motion as km
from motion_bench import Machine, eq

LOCKING = 8  # homing flag: the joint is unlocked before it homes
TABLE = 3
HAL = ["loadrt timedelay", "addf timedelay.0 servo-thread", "setp timedelay.0.on-delay 0.2",
       "setp timedelay.0.off-delay 0.3", f"net unlock joint.{TABLE}.unlock => timedelay.0.in",
       f"net unlocked timedelay.0.out => joint.{TABLE}.is-unlocked"]

def machine(mask, hal=()):
    m = Machine(joints=4, kins="trivkins coordinates=xyza", axes="xyza",
                motmod=f"unlock_joints_mask={mask}", hal_lines=hal)
    m.send(km.SET_AXIS_LOCKING_JOINT, axis=3, joint=TABLE)
    m.send(km.SET_JOINT_HOMING_PARAMS, joint=TABLE, offset=0, home=0, home_final_vel=-1, search_vel=0,
           latch_vel=0, flags=LOCKING, home_sequence=0, volatile_home=0)
    return m


def index(m, a, id):
    m.send(km.SET_LINE, pos=[0, 0, 0, a, 0, 0, 0, 0, 0], vel=50, ini_maxvel=50, acc=500, ini_maxjerk=1e9, id=id,
           motion_type=6, turn=TABLE)


m = machine(1 << TABLE, HAL)
m.mode(km.COORD)
m.errors()
before = m.now()
index(m, 45, id=1)
index(m, 90, id=2)
seen = []
end = m.now() + 20
while not (m.status()["inpos"] and m.status()["depth"] == 0):
    m.sleep(0.001)
    if m.now() > end:
        raise SystemExit(f"no end: {seen} {m.errors()}")
    now = (m.get(f"joint.{TABLE}.unlock"), m.get(f"joint.{TABLE}.is-unlocked"), m.get(f"joint.{TABLE}.vel-cmd") != 0)
    if now[2] and not now[1]:
        raise SystemExit("the table turns while it is locked")
    if not seen or seen[-1] != now:
        seen.append(now)
    eq(m.get("motion.motion-type") in (6, 0), True, "motion type")
turn = [(True, False, False), (True, True, False), (True, True, True), (True, True, False), (False, True, False),
        (False, False, False)]
eq([s for s in seen if s != (False, False, False)], [s for s in turn * 2 if s != (False, False, False)],
   "order of events")
eq(round(m.get(f"joint.{TABLE}.pos-cmd"), 9), 90.0, "place of the table")
eq(0.4 * 2 < m.now() - before < 10, True, "time")
m.mode(km.TELEOP)
m.send(km.JOG_CONT, joint=-1, axis=3, vel=10)
eq([t.strip() for t in m.errors()], ["Cannot jog a locking indexer AXIS_A,joint_num=3"], "jog of the axis")
m.mode(km.FREE)
for code, fields, text in ((km.JOG_CONT, {}, "Can't jog locking joint_num=3"),
                           (km.JOG_INCR, {"offset": 1}, "Can't jog locking joint_num=3")):
    m.send(code, joint=TABLE, axis=-1, vel=10, **fields)
    eq([t.strip() for t in m.errors()], [text], "jog of the joint")
m.set(f"joint.{TABLE}.jog-enable", 1)
m.set(f"joint.{TABLE}.jog-scale", 1)
m.set(f"joint.{TABLE}.jog-counts", 1)
m.sleep(0.01)
eq([t.strip() for t in m.errors()], ["Can't wheel jog locking joint_num=3"], "wheel of the joint")
m.send(km.ABORT)
# an abort, or machine off, in the middle: locked
for stop in (lambda: m.send(km.ABORT), m.disable):
    if not m.status()["enabled"]:
        m.enable()
    m.mode(km.COORD)
    index(m, 0, id=3)
    m.wait(lambda s: m.get(f"joint.{TABLE}.vel-cmd") != 0, "turn")
    stop()
    m.sleep(1.5)
    eq(m.get(f"joint.{TABLE}.unlock"), False, "locked after a stop")
    m.send(km.ABORT)
    if m.status()["enabled"]:
        index(m, 90, id=4)
        m.rest()
m.close()

m = machine(0)
m.mode(km.COORD)
m.errors()
index(m, 10, id=1)
m.sleep(0.2)
told = [t.strip() for t in m.errors()]
eq(sorted(set(told)), sorted(["emcmotSetRotaryUnlock(): No unlock pin configured for joint 3\n"
                              "   Use motmod parameter: unlock_joints_mask=8",
                              "emcmotGetRotaryUnlocked(): No unlock pin configured for joint 3\n"
                              "   Use motmod parameter: unlock_joints_mask=8'"]),
   "messages without pins")
eq(m.get(f"joint.{TABLE}.pos-cmd"), 0.0, "table without pins")
m.send(km.ABORT)
m.close()
print("ok")
