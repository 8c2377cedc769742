# SPDX-License-Identifier: GPL-2.0-or-later
"""Play between motor and slide, which BACKLASH compensates: the zero is where it is without play, also when the
switch comes before the play is taken up, while the feed is inhibited, and after a stop that the jerk limit makes
long: the correction follows no way back of that stop. The motor keeps its limits."""
import kerf_motion as km
from rig import Report, Rig

r = Report()
KINDS = {  # search, latch, where the slide starts; the switch is closed from 17 on, with a hysteresis of 0.02
    "from far": (30.0, -20.0, 0.0),
    "from the switch": (8.227625, 2.0, 26.0),
    "fast on and off": (60.0, 30.0, 0.0),
    "slowly": (3.0, -2.0, 15.0),
}
for jerk in (0.0, 8000.0):
    m = Rig(1, low=-150.0, high=150.0, vel=60.0, acc=600.0, jerk=jerk, traj_jerk=jerk or 1e9, ferror=20.0,
            hw={0: dict(home_from=17.0, hysteresis=0.02)})
    m.enable()
    for name, (search, latch, start) in KINDS.items():
        zero = {}
        for gap, inhibited in ((0.0, 0), (0.02, 0), (1.0, 0), (1.0, 1)):
            title = f"{name}, jerk {jerk:g}, play {gap}, inhibited {inhibited}"
            m.unhome()
            m.hw(0, backlash=gap)
            m.send(km.SET_JOINT_BACKLASH, joint=0, backlash=gap)
            m.set_home(0, search_vel=search, latch_vel=latch, offset=5.0, home=3.0)
            m.place(0, start)
            m.set("motion.feed-inhibit", inhibited)
            m.errors()
            seen, ok = m.run_home(0)
            zero[gap, inhibited] = m.at(0) - m.get("joint.0.pos-cmd")
            r.check(ok, f"{title}: not homed, {m.errors()}")
            r.check(not m.violations(), f"{title}: {m.violations()}")
            r.near(zero[gap, inhibited], zero[0.0, 0], f"{title}: zero", abs(latch) * 0.001 + 1e-6)
            m.set("motion.feed-inhibit", 0)
    m.close()
r.finish()
