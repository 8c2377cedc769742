# SPDX-License-Identifier: GPL-2.0-or-later
"""The compiled component moves a machine; its pins, also those made later; its own types; the frame's
types: pins kinstype.is-N, joints stay where they are when kinematics are switched (FP-092: also while an
external offset is active), a type that does not exist leaves the old one."""
import kerf_motion as km
from motion_bench import Machine

bad = []


def check(ok, text):
    if not ok:
        bad.append(text)


def near(a, b, text, tolerance=1e-6):
    check(max(abs(x - y) for x, y in zip(a, b)) < tolerance, f"{text}: {a} instead of {b}")


def switch(m, value):
    """Switches at rest; no joint may move."""
    before = [m.get(f"joint.{j}.motor-pos-cmd") for j in range(m.joints)]
    m.set("motion.switchkins-type", value)
    for _ in range(100):
        m.sleep(0.001)
        now = [m.get(f"joint.{j}.motor-pos-cmd") for j in range(m.joints)]
        check(max(abs(a - b) for a, b in zip(now, before)) < 1e-9, f"type {value}: {before} becomes {now}")
        if bad:
            break


def pose(m):
    return m.status()["carte_pos_cmd"]


HOME = {j: dict(offset=10.0 * j, home=10.0 * j) for j in range(3)}
m = Machine(joints=3, kins="kerf_test_kins", home_params=HOME)
check(m.get("kerf_test_kins.scale") == 1.0 and m.get("kerf-test-kins.0.is-tilted") == 0, "pins of the component")
m.mode(km.COORD)
m.line(5, 6, 7)
m.rest()
near(m.joints_at(), [5, 6, 7], "type 0")
switch(m, 1)
near(pose(m)[:3], [5 + 3, 6, 7], "pose in type 1")
m.line(8, 16, 7)
m.rest()
near(m.joints_at(), [0, 16, 7], "type 1")
check(not m.errors(), "errors")
switch(m, 5)
check(any("kinematicsSwitch() FAIL<5" in e for e in m.errors()), "a type that does not exist is not reported")
m.send(km.ABORT)
switch(m, 0.9)
near(pose(m)[:3], [0, 16, 7], "pose in type 0")
m.close()

m = Machine(joints=5, axes="xyzbc", kins="xyzbc-trt-kins", high=200, low=-200, eoffset_ratio=0.3,
            kins_setup=["setp xyzbc-trt-kins.z-rot-point -30", "setp xyzbc-trt-kins.x-offset 4",
                        "setp xyzbc-trt-kins.z-offset 7"],
            home_params={j: dict(offset=q, home=q) for j, q in enumerate((1.0, 2.0, 3.0, 20.0, 40.0))})
for value, shown in ((0, 0), (1, 1), (2, 2), (1, 1), (0, 0)):
    switch(m, value)
    check([m.get(f"kinstype.is-{n}") for n in range(3)] == [n == shown for n in range(3)],
          f"kinstype pins in type {value}")
m.mode(km.COORD)
switch(m, 1)
near(pose(m)[:5], [1, 2, 3, 0, 20], "identity")
switch(m, 3)
check([m.get(f"kinstype.is-{n}") for n in range(3)] == [0, 1, 0], "a type that does not exist changes the type")
check(any("BAD VALUE <3>" in e for e in m.errors()), "a type that does not exist is not reported")
m.send(km.ABORT)
# FP-092: with an external offset on an axis, in every mode and both ways
for axis in "xyz":
    m.mode(km.TELEOP)
    switch(m, 1)
    m.set(f"axis.{axis}.eoffset-scale", 0.1)
    m.set(f"axis.{axis}.eoffset-enable", 1)
    m.sleep(0.01)
    m.set(f"axis.{axis}.eoffset-counts", 25)
    m.sleep(1.0)
    near([m.get(f"axis.{axis}.eoffset")], [2.5], f"offset of {axis}")
    for mode in (km.TELEOP, km.COORD):
        m.mode(mode)
        for value in (0, 1, 0, 2, 1):
            switch(m, value)
    m.mode(km.TELEOP)
    m.set(f"axis.{axis}.eoffset-counts", 0)
    m.sleep(1.0)
    m.set(f"axis.{axis}.eoffset-enable", 0)
check(not m.violations(), str(m.violations()))
check(not m.errors(), "errors at the end")
m.close()

# modules with a switch of their own
for name, joints, axes, types, prefix, dummy in (
        ("xyzab_tdr_kins", 5, "xyzab", 2, "xyzab_tdr_kins", "xyzab-tdr-kins.0.dummy"),
        ("xyzacb_trsrn", 6, "xyzacb", 3, "xyzacb_trsrn_kins", "xyzacb-trsrn.0.dummy"),
        ("xyzbca_trsrn", 6, "xyzbca", 3, "xyzbca_trsrn_kins", "xyzbca-trsrn.0.dummy"),
        ("millturn", 4, "xyza", 2, "millturn", "millturn.0.fpin")):
    m = Machine(joints=joints, axes=axes, kins=name, low=-500, high=500)
    if name != "millturn":
        m.set(f"{prefix}.tool-offset-z", 12.5)
        m.set(f"{prefix}.x-offset", 3.5)
    check(m.get(dummy) == 0, f"{name}: {dummy}")
    m.mode(km.COORD)
    m.line(*[5.0] * joints)  # letters of these are the first of xyzabc
    m.rest()
    for value in [*range(types), 7, 0]:
        switch(m, value)
        on = value if value < types else types - 1
        check([m.get(f"kinstype.is-{n}") for n in range(types)] == [n == on for n in range(types)],
              f"{name} type {value}")
        check((value < types) != any("BAD VALUE <7>" in e for e in m.errors()), f"{name} type {value}: message")
        m.send(km.ABORT)
        m.mode(km.TELEOP)
        m.mode(km.COORD)
    m.close()

# a module in plain C that uses posemath.h
m = Machine(joints=3, kins="kerf_test_tower", low=-200, high=200,
            home_params={j: dict(offset=q, home=q) for j, q in enumerate((100.0, 0.0, 0.0))})
m.set("kerf_test_tower.shown", 4)
m.mode(km.COORD)
near(pose(m)[:3], [0, 0, 0], "tower")
m.line(30, 0, 60)
m.rest()
near(m.joints_at(), [50, 30, 0], "tower")
m.close()

# the template, as shipped and as a user builds it
for name in ("userkins", "kerf_test_userkins"):
    m = Machine(joints=3, kins=name)
    m.set("userkins.in", 7)
    m.sleep(0.01)
    m.mode(km.COORD)
    m.line(1, 2, 3)
    m.rest()
    near(m.joints_at(), [1, 2, 3], name)
    check(m.get("userkins.out") == 7, "userkins.out")
    m.close()
print("\n".join(bad) if bad else "as documented")
