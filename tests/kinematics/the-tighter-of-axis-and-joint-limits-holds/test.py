# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-094: axis limits outside the joints' on a gantry, and joint limits outside the axis'. A jog slows
down and stops exactly at the tighter one, with at most one message; the
machine stays on and can jog back; a program is refused with one reason."""
import kerf_motion as km
from motion_bench import AXES, Machine

bad = []
for name, axis_limit, joint_limit, jerk in (("axis wider", 200.0, 100.0, 0.0), ("joint wider", 80.0, 100.0, 0.0),
                                            ("axis wider, jerk", 200.0, 100.0, 5000.0)):
    m = Machine(jerk=jerk, traj_jerk=jerk or 1e9, joints=4, axes="xyz", kins="trivkins coordinates=xyyz kinstype=both",
                low=-joint_limit, high=joint_limit)
    for a in range(3):
        m.send(km.SET_AXIS_POSITION_LIMITS, axis=a, minLimit=-axis_limit, maxLimit=axis_limit)
    m.mode(km.TELEOP)
    m.errors()
    limit = min(axis_limit, joint_limit)
    for sign in (1, -1):
        for kind, more in ((km.JOG_CONT, {}), (km.JOG_ABS, dict(offset=5 * limit))):
            for letter, joints in (("x", [0]), ("y", [1, 2]), ("z", [3])):
                m.send(kind, joint=-1, axis=AXES.index(letter), vel=sign * 40.0,
                       **{k: sign * v for k, v in more.items()})
                m.sleep(12)
                told, title = m.errors(), f"{name} jog {kind} {letter} {sign:+d}"
                at = [m.get(f"joint.{j}.pos-cmd") for j in joints]
                if not m.status()["enabled"] or m.violations():
                    bad.append(f"{title}: enabled {m.status()['enabled']} {m.violations()} {told}")
                if (len(told) > 1 or any(abs(q) > limit + 1e-9 for q in at)
                        or any(abs(q - sign * limit) > 1e-6 for q in at)):
                    bad.append(f"{title}: at {at}, told {told}")
                m.send(km.JOG_ABORT, joint=-1, axis=AXES.index(letter))
                m.sleep(0.01)
                m.send(km.JOG_INCR, joint=-1, axis=AXES.index(letter), vel=-sign * 40.0, offset=limit)
                m.sleep(6)
                at = [m.get(f"joint.{j}.pos-cmd") for j in joints]
                if any(abs(q) > 0.1 for q in at) or m.errors():
                    bad.append(f"{title}: cannot jog back, {at}")
                m.reset_limits()
    m.mode(km.COORD)
    m.errors()
    m.line(0, limit + 5, 0, vel=40)
    m.sleep(0.5)
    told = m.errors()
    reasons = [t for t in told if "would exceed" in t]
    if m.joints_at() != [0, 0, 0, 0] and max(map(abs, m.joints_at())) > 0.1:
        bad.append(f"{name}: moves to {m.joints_at()}")
    if not reasons or len(told) > len(reasons) + 1 or not m.status()["enabled"]:
        bad.append(f"{name}: {told}")
    m.close()
print("\n".join(bad[:20]) if bad else "the tighter one holds")
