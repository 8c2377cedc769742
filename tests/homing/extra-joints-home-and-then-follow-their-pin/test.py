# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints beyond those of the kinematics: they home like others, then follow joint.N.posthome-cmd
without following errors, and are unhomed only while the machine is off."""
import kerf_motion as km
from rig import Report, Rig

r = Report()
m = Rig(4, axes="xyz", kins="trivkins coordinates=xyz kinstype=both", motmod="num_extrajoints=1",
        hw={"all": dict(home_from=10)},
        home={j: dict(search_vel=20.0, latch_vel=2.0, offset=4.0, home=1.0, home_sequence=j // 2) for j in range(4)})
m.enable()
m.set("joint.3.posthome-cmd", 1.0)
seen, ok = m.run_home()
r.check(ok and "RISE_WAIT" in seen[3], f"not homed: {seen[3]} {m.errors()}")
r.near(m.get("joint.3.pos-cmd"), 1.0, "home position")
for value in (1.0, 1.05, 3.0, -20.0):
    m.set("joint.3.posthome-cmd", value)
    m.sleep(0.01)
    r.near(m.get("joint.3.motor-pos-cmd") - m.get("joint.3.motor-offset"), value, "posthome-cmd")
    r.near(m.at(3), 7.0 - 1.0 + value, "slide", 0.02)
r.near(m.get("joint.3.f-error"), 0.0, "following error")
r.check(not m.errors() and m.status()["enabled"], "machine off")
m.mode(km.COORD)
m.line(2, 3, 4, vel=30)
m.rest()
r.near(m.get("joint.0.pos-cmd"), 2.0, "program beside it")
m.mode(km.FREE)
m.send(km.JOG_CONT, joint=3, axis=-1, vel=5)
m.sleep(0.05)
r.check(m.errors() != [], "an extra joint that is homed can be jogged")
m.set("joint.3.jog-enable", 1)
m.set("joint.3.jog-scale", 0.1)
m.set("joint.3.jog-counts", 10)
m.sleep(0.05)
r.check(not m.get("joint.3.wheel-jog-active") and m.status()["inpos"], "an extra joint that is homed takes a wheel")
for joint, text in ((3, "Cannot unhome extrajoint <3> with motion enabled\n"),
                    (-1, "Cannot unhome extrajoint <3> with motion enabled")):
    m.send(km.JOINT_UNHOME, joint=joint)
    m.sleep(0.01)
    got = m.errors()
    r.check(got == [text] and m.homed(), f"unhome {joint} while on: {got}")
m.disable()
m.send(km.JOINT_UNHOME, joint=3)
m.sleep(0.01)
r.check(not m.homed(3) and m.homed(0) and not m.errors(), "unhome while off")
r.check(not [v for v in m.violations() if not v.startswith("joint 3")], str(m.violations()))
r.finish()
