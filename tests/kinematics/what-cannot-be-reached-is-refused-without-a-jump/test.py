# SPDX-License-Identifier: GPL-2.0-or-later
"""Moves to and through places that a kinematics cannot reach, and through its singular places:
each is refused when it is queued or stops the machine with a message; no joint ever jumps (a step of
more than its speed allows in one cycle), and afterwards the machine works. FP-097: the machine never
goes off without a message."""
import kerf_motion as km
from motion_bench import AXES, Machine

bad = []
STEP = 500.0 * 0.001 * 1.01 + 1e-9  # vel limit per cycle


def machine(kins, start, axes="xyz", setp=(), seed=(0,) * 9):
    m = Machine(joints=len(start), kins=kins, axes=axes, vel=500.0, acc=1e5, low=-1e4, high=1e4, check=False,
                home_params={j: dict(offset=q, home=q) for j, q in enumerate(start)}, kins_setup=setp, home=False)
    m.send(km.SET_WORLD_HOME, pos=seed)
    m.enable()
    m.home()
    m.mode(km.COORD)
    m.sleep(0.01)
    m.errors()
    return m


def go(m, title, target, refused, vel=100.0):
    """One move in COORD mode, every cycle watched. refused: 'queue', 'on the way' or ''."""
    pose = [0.0] * 9
    for letter, value in target.items():
        pose[AXES.index(letter)] = value
    before = [m.get(f"joint.{j}.motor-pos-cmd") for j in range(m.joints)]
    m.send(km.SET_LINE, pos=pose, vel=vel, ini_maxvel=vel, acc=2000.0, ini_maxjerk=1e9, id=7, motion_type=2, turn=-1)
    last, moved, told = before, False, []
    for cycle in range(200000):
        m.sleep(0.001)
        now = [m.get(f"joint.{j}.motor-pos-cmd") for j in range(m.joints)]
        step = max(abs(a - b) for a, b in zip(now, last))
        if not step <= STEP:
            bad.append(f"{title}: step of {step:g} in a cycle, {last} to {now}")
            break
        moved |= step > 0
        last = now
        if cycle % 20 == 19:
            s = m.status()
            told += m.errors()
            if not s["enabled"] or s["error"] or (s["inpos"] and s["depth"] == 0):
                break
    told += m.errors()
    s = m.status()
    if refused == "" and (told or not s["enabled"]):
        bad.append(f"{title}: {told} enabled {s['enabled']}")
    if refused == "queue" and (moved or not any("kinematicsInverse" in t or "non-finite" in t for t in told)):
        bad.append(f"{title}: moved {moved}, {told}")
    if refused == "on the way" and not any("inematics" in t for t in told):
        bad.append(f"{title}: {told} at {last}")
    if not s["enabled"] and not told:
        bad.append(f"{title}: machine off without a message")
    m.send(km.ABORT)
    if not m.status()["enabled"]:
        m.enable()
        m.mode(km.FREE)
    m.mode(km.COORD)
    m.sleep(0.05)
    again = m.errors()
    if again:
        bad.append(f"{title}: afterwards {again}")
    if m.status()["motion_state"] != 3:
        bad.append(f"{title}: not usable afterwards")


# rods of 269 on towers at 130: everything beyond is out of reach
m = machine("lineardeltakins", [235.0] * 3)
go(m, "linear delta, out of reach", dict(x=390, y=0, z=0), "queue")
go(m, "linear delta, near the edge", dict(x=0, y=-130, z=0), "")
go(m, "linear delta, back", dict(x=0, y=0, z=0), "")
# a chord whose ends are within reach, its middle is not
go(m, "linear delta, at a corner", dict(x=-100, y=58, z=0), "")
go(m, "linear delta, past the edge", dict(x=-250, y=145, z=0), "queue")
m.close()
m = machine("rotarydeltakins", [10.0] * 3)
go(m, "rotary delta, too low", dict(x=0, y=0, z=-30), "queue")
go(m, "rotary delta, through the hips' plane", dict(x=0, y=0, z=0), "queue")
go(m, "rotary delta, down", dict(x=1, y=2, z=-16), "")
m.close()
# from a place 0.1 units above the lowest one
m = machine("rotarydeltakins", [90.0] * 3)
go(m, "rotary delta, up from its lowest place", dict(x=1, y=2, z=-16), "")
m.close()
# thighs inward of the line of their shins: the same foot is reached with them outward, and nothing goes there by itself
for start in ([120.0] * 3, [120.0, 100.0, 110.0], [-60.0] * 3):
    title = f"rotary delta from {start}"
    m = Machine(joints=3, kins="rotarydeltakins", vel=500.0, acc=1e5, low=-1e4, high=1e4, check=False, home=False,
                home_params={j: dict(offset=q, home=q) for j, q in enumerate(start)})
    m.enable()
    m.send(km.JOINT_HOME, joint=-1)
    for mode in ("after homing", km.TELEOP, km.COORD):
        if mode != "after homing":
            m.send(mode)
        m.sleep(0.5)
        s, told = m.status(), m.errors()
        if len(told) != 1 or "another branch" not in told[0] or s["motion_state"] != 1 or max(
                abs(q - at) for q, at in zip(m.joints_at(), start)) > 1e-6:
            bad.append(f"{title}, mode {mode}: {told}, state {s['motion_state']}, joints {m.joints_at()}")
    for j in range(3):
        m.send(km.JOG_ABS, joint=j, axis=-1, vel=100.0, offset=40.0)
    m.sleep(3)
    m.mode(km.COORD)
    go(m, f"{title}, jogged over", dict(x=1, y=2, z=-16), "")
    m.close()
# arm of 340 and 250, wrist 0: a ring from 90 to 590; the straight way through the base is out of it
m = machine("scarakins", [30.0, 60.0, 0, 0, 0, 0], axes="xyzabc", setp=["setp scarakins.D6 0"])
go(m, "scara, out of reach", dict(x=600, y=0, z=400, c=90), "queue")
go(m, "scara, into the hole", dict(x=10, y=0, z=400, c=90), "queue")
go(m, "scara, one side", dict(x=300, y=20, z=400, c=90), "")
go(m, "scara, through the hole", dict(x=-300, y=20, z=400, c=90), "on the way")
m.close()
# a wrist that goes through its singular place, and a target out of reach
m = machine("pumakins", [20.0, -30.0, 60.0, 10.0, 40.0, 15.0], axes="xyzabc")
pose = dict(zip("xyzabc", m.status()["carte_pos_cmd"]))
go(m, "puma, out of reach", dict(pose, x=pose["x"] + 2000), "queue")
go(m, "puma, a bit", dict(pose, x=pose["x"] + 20), "")
m.close()
m = machine("genserkins", [20.0, -30.0, 60.0, 10.0, 40.0, 15.0, 0, 0, 0], axes="xyzabcuvw")
pose = dict(zip("xyzabcuvw", m.status()["carte_pos_cmd"]))
go(m, "genser, out of reach", dict(pose, x=pose["x"] + 2000), "queue")
go(m, "genser, a bit", dict(pose, x=pose["x"] + 20, u=5), "")
m.close()
m = machine("scorbot-kins", [0.0, 60.0, -20.0, 0, 0], axes="xyzab")
go(m, "scorbot, out of reach", dict(x=500, y=0, z=140), "queue")
go(m, "scorbot, to the back through its axis", dict(x=-100, y=0, z=300), "")
m.close()
# at the middle of the disc every angle is right: a path may begin and end there, but not turn the disc on the spot
m = machine("rosekins", [0.0, 0.0, 0.0])
go(m, "rose engine, out of the middle", dict(x=30, y=0, z=0), "")
go(m, "rose engine, back to the middle", dict(x=0, y=0, z=0), "")
go(m, "rose engine, askew out of it", dict(x=0, y=30, z=0), "on the way")
go(m, "rose engine, out again", dict(x=20, y=0, z=0), "")
go(m, "rose engine, straight through the middle", dict(x=-20, y=0, z=0), "on the way")
m.close()
m = machine("rosekins", [50.0, 0.0, 10.0])
go(m, "rose engine, round", dict(x=-30, y=20, z=5), "")
m.close()
m = machine("genhexkins", [34.0] * 6, axes="xyzabc", seed=(0, 0, 30, 0, 0, 0))
z = m.status()["carte_pos_cmd"][2]
go(m, "hexapod, tilt", dict(x=1, y=2, z=z + 1, a=5, b=-4, c=8), "")
m.close()
print("\n".join(bad) if bad else "as promised")
