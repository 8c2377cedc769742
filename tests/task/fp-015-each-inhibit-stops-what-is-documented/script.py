# SPDX-License-Identifier: GPL-2.0-or-later
# FP-015: each hold and inhibit against each kind of motion: set while it moves, and set before it is asked for. The
# table is that of docs/stops.md.
import hal
from mill import *


def moves():
    before = [hal.get_value(f"joint.{j}.motor-pos-cmd") for j in range(3)]
    sleep(0.02)
    return before != [hal.get_value(f"joint.{j}.motor-pos-cmd") for j in range(3)]


def in_mode(m, joints=None):
    mode(m)
    if joints is not None:
        c.teleop_enable(not joints)
        need(lambda s: s.motion_mode == (TRAJ_MODE_FREE if joints else TRAJ_MODE_TELEOP), "jog mode")


def start_program(text):
    program("M52 P1\nM53\n" + text + "M2\n")
    c.auto(AUTO_RUN, 0)


def start_mdi():
    in_mode(MODE_MDI)
    c.mdi("G1 F900 X300")


def start_jog(joints):
    in_mode(MODE_MANUAL, joints)
    c.jog(JOG_CONTINUOUS, joints, 0, 10)


def start_wheel():
    global counts
    in_mode(MODE_MANUAL, False)
    counts += 150
    hal.set_p("axis.x.jog-counts", str(counts))


def start_homing():
    in_mode(MODE_MANUAL, True)
    c.home(1)


def start_offset():
    global offset
    in_mode(MODE_MANUAL, False)
    offset = 40 - offset
    hal.set_p("axis.z.eoffset-counts", str(offset))


counts = offset = 0
MOTIONS = {"program, feed": lambda: start_program("G1 F900 X300\n"),
           "program, rapid": lambda: start_program("G0 X300\n"), "MDI": start_mdi,
           "joint jog": lambda: start_jog(1), "axis jog": lambda: start_jog(0), "wheel": start_wheel,
           "homing": start_homing, "offset": start_offset}
HOLDS = {"motion.feed-hold": (1, 0), "motion.feed-inhibit": (1, 0), "motion.adaptive-feed": (0, 1),
         "spindle.0.inhibit": (1, 0), "motion.jog-inhibit": (1, 0),
         "motion.jog-stop": (1, 0), "motion.homing-inhibit": (1, 0), "pause": None, "feed override 0": None}


def hold(name, on_now):
    if name == "pause":
        (c.auto(AUTO_PAUSE) if on_now else c.auto(AUTO_RESUME))
    elif name == "feed override 0":
        c.feedrate(0 if on_now else 1)
    else:
        hal.set_p(name, str(HOLDS[name][0 if on_now else 1]))


def at_rest():
    global offset
    c.abort()
    c.wait_complete()
    sleep(0.6)
    if offset:
        offset = 0
        hal.set_p("axis.z.eoffset-counts", "0")
        sleep(3)
    if not all(poll().homed[:3]):
        c.teleop_enable(0)
        c.wait_complete()
        c.home(1)
        need(lambda s: all(s.homed[:3]), "homing")
    mdi("G0 X0 Y0 Z0")
    messages()


on()
for axis in "xz":
    hal.set_p(f"axis.{axis}.jog-enable", "1")
    hal.set_p(f"axis.{axis}.jog-scale", "1")
hal.set_p("motion.adaptive-feed", "1")
hal.set_p("axis.z.eoffset-enable", "1")
hal.set_p("axis.z.eoffset-scale", "1")
print("|  | " + " | ".join(MOTIONS) + " |\n|" + " --- |" * (len(MOTIONS) + 1))
for name in HOLDS:
    cells = []
    for what, start in MOTIONS.items():
        at_rest()
        start()
        sleep(0.2)
        if not moves():
            raise SystemExit(f"{what} does not move {messages()} {poll().interp_state} {s.task_mode} {s.homed[:3]}")
        hold(name, True)
        sleep(0.4)
        during = moves()
        hold(name, False)
        sleep(0.1)
        cell = "-" if during else "holds" if moves() else "ends"
        at_rest()
        hold(name, True)
        start()
        sleep(0.3)
        early = moves()
        hold(name, False)
        sleep(0.3)
        cells.append(cell + ("" if early == during else ", starts" if early else ", waits" if moves() else ", refused"))
    at_rest()
    print(f"| `{name}` | " + " | ".join(cells) + " |")
