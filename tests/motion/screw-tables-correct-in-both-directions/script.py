# COMP_FILE of both types, BACKLASH, and what a file may not contain.
# FP-048: compensation stops no path and costs next to no time.
import os
import tempfile

import kerf_motion as km
from motion_bench import Machine, eq

POINTS = [(-50, 0.010, -0.020), (-10, 0.004, -0.004), (0, 0.0, -0.010), (40, 0.030, 0.010), (60, -0.010, -0.015)]
VEL, ACC = 50.0, 500.0
m = Machine(vel=VEL, acc=ACC)
files = tempfile.TemporaryDirectory()

def load(joint, text, kind):
    """Loads a table; what was printed, with the file's name as FILE."""
    name = os.path.join(files.name, "table")
    with open(name, "w") as f:
        f.write(text)
    with tempfile.TemporaryFile("w+") as out:
        saved = os.dup(2)
        os.dup2(out.fileno(), 2)
        try:
            eq(km.load_comp(joint, name, kind), 0, "result of a load")
        finally:
            os.dup2(saved, 2)
            os.close(saved)
        out.seek(0)
        return out.read().replace(name, "FILE").splitlines()


def trim(x, side):
    """The table's correction at x: linear between points, constant outside."""
    if x <= POINTS[0][0]:
        return POINTS[0][side]
    for a, b in zip(POINTS, POINTS[1:]):
        if x <= b[0]:
            return a[side] + (b[side] - a[side]) * (x - a[0]) / (b[0] - a[0])
    return POINTS[-1][side]


eq(load(0, "".join(f"{n} {n - f} {n - r}\n" for n, f, r in POINTS), 0), [], "file of positions")
eq(load(1, "".join(f"{n}\t{f}  {r}\n" for n, f, r in POINTS) + "\n", 1), [], "file of trims")
m.send(km.SET_JOINT_BACKLASH, joint=1, backlash=7)  # a table is in its place
m.send(km.SET_JOINT_BACKLASH, joint=2, backlash=0.02)
m.mode(km.COORD)
where = [-70, -50.5, -50, -30, -10, -5, 0, 1, 20, 40, 55, 60, 80]
looked = 0
m.line(-90, -90, -90, vel=40)
m.rest()
for x, side in [(x, 1) for x in where] + [(x, 2) for x in reversed(where[:-1])]:
    m.line(x, x, x, vel=40)
    m.rest()
    m.sleep(0.2)
    for j in (0, 1):
        corr, filt = m.get(f"joint.{j}.backlash-corr"), m.get(f"joint.{j}.backlash-filt")
        if abs(corr - trim(x, side)) > 2e-6 or filt != corr:
            raise SystemExit(f"joint {j} at {x}, side {side}: wanted {corr}, in effect {filt}, table {trim(x, side)}")
        eq(round(m.get(f"joint.{j}.motor-pos-cmd") - x - filt, 9), 0, "motor command")
        eq(round(m.get(f"joint.{j}.pos-fb") - x, 9), 0, "feedback without compensation")
        looked += 1
    eq(m.get("joint.2.backlash-filt"), 0.01 if side == 1 else -0.01, "half of the backlash by direction")
eq(m.violations(), [], "limits of the joints")
eq(m.errors(), [], "messages")
print(looked, "places looked at, limits kept")

# a hold of the feed holds the correction as well, and lets it go on
m.line(-70, -70, -70.01, vel=40)
m.rest()
m.sleep(0.2)
m.line(-70, -70, -70, vel=40)
m.wait(lambda s: m.get("joint.2.backlash-vel") > 0, "start of the correction")
m.set("motion.feed-hold", 1)
m.sleep(0.3)
held = m.get("joint.2.backlash-filt")
eq(-0.01 < held < 0.01 and m.get("joint.2.backlash-vel") == 0, True, "correction while the feed is held")
m.set("motion.feed-hold", 0)
m.rest()
m.sleep(0.2)
eq(m.get("joint.2.backlash-filt"), 0.01, "correction after the hold")

# ---- FP-048
took = {}
for backlash in (0.0, 0.02):
    m.send(km.SET_JOINT_BACKLASH, joint=2, backlash=backlash)
    m.send(km.SET_TERM_COND, termCond=2, tolerance=0.01)
    m.line(0, 0, 0, vel=40)
    m.rest()
    m.sleep(0.2)
    begin, slowest, moving = m.now(), 1e9, 0
    for turn in range(4):  # circles in the plane of a joint with backlash and one without
        m.send(km.SET_CIRCLE, pos=[0] * 9, center=[0, -20, 0], normal=[1, 0, 0], id=turn, vel=25, ini_maxvel=25,
               acc=ACC, ini_maxjerk=1e9, motion_type=3, turn=0)
    while not m.status()["inpos"]:
        m.sleep(0.001)
        if 0.5 < m.now() - begin < 19:
            slowest = min(slowest, m.get("motion.current-vel"))
    took[backlash] = m.now() - begin
    eq(slowest > 24.9, True, f"FP-048: speed at the quadrants with backlash {backlash}: {slowest}")
eq(took[0.02] < 1.02 * took[0.0], True, f"FP-048: time with and without backlash {took}")
eq(m.violations(), [], "limits of the joints in circles")
print("circles are not slowed down")

# ---- files
m.close()
m = Machine(joints=9, kins="trivkins coordinates=xyzabcuvw", axes="xyzabcuvw", home=False)
for joint, (text, kind, printed, told) in enumerate((
        ("0 0 0\n1 1\n2 2 2\n", 0, ["FILE:2: three numbers expected: the 1 points before this line are used"], []),
        ("# table\n0 0 0\n", 0, ["FILE:1: three numbers expected: the 0 points before this line are used",
                                 "FILE: no compensation points"], []),
        ("0 0 0\n1 nan 1\n", 0, ["FILE:2: a value is no number: the 1 points before this line are used"], []),
        ("0 0 0\n1 1,5 1\n", 0, ["FILE:2: three numbers expected: the 1 points before this line are used"], []),
        ("0 0 0\n0 0.5 0\n1 1 1\n", 0, ["FILE:2: position 0 is not above 0 of the point before: point not used"],
         ["joint 4: compensation values must increase"]),
        ("0 0 0\n10 10 10\n", 1, ["FILE:2: the correction changes by more than half of the travel since "
                                  "the point before: "
                                 "is COMP_FILE_TYPE 1 right?"], []),
        ("", 0, ["FILE: no compensation points"], []),
        ("".join(f"{n} 0 0\n" for n in range(300)), 1, ["FILE:257: more than 256 points"],
         ["joint 7: too many compensation entries"]))):
    eq(load(joint, text, kind), printed, f"messages of {text[:40]!r}")
    eq(m.errors(), told, f"operator's messages of {text[:40]!r}")
print("files are checked")
m.close()
