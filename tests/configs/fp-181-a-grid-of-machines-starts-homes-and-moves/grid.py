# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes a stepper machine for each combination of axes, units, homing and backlash, as a wizard would."""
from pathlib import Path

AXES = ("XYZ", "XZ", "XYZA", "XYUV")
HOMING = ("none", "switch", "index")
INI = """[EMC]
VERSION = 1.1
MACHINE = {name}
[DISPLAY]
DISPLAY = axis
LATHE = {lathe}
MAX_LINEAR_VELOCITY = {vel}
[TASK]
TASK = milltask
CYCLE_TIME = 0.005
[RS274NGC]
PARAMETER_FILE = m.var
[EMCMOT]
EMCMOT = motmod
BASE_PERIOD = 50000
SERVO_PERIOD = 1000000
[HAL]
HALFILE = m.hal
HALUI = halui
[TRAJ]
COORDINATES = {letters}
LINEAR_UNITS = {units}
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = {vel}
[KINS]
KINEMATICS = trivkins coordinates={letters}
JOINTS = {joints}
[EMCIO]
TOOL_TABLE = m.tbl
"""
AXIS = """[AXIS_{letter}]
MAX_VELOCITY = {vel}
MAX_ACCELERATION = {acc}
MIN_LIMIT = {low}
MAX_LIMIT = {high}
[JOINT_{n}]
TYPE = {kind}
MAX_VELOCITY = {vel}
MAX_ACCELERATION = {acc}
STEPGEN_MAXACCEL = {genacc}
STEPGEN_MAXVEL = {genvel}
SCALE = {scale}
MIN_LIMIT = {low}
MAX_LIMIT = {high}
FERROR = {ferror}
MIN_FERROR = {ferror}
HOME = 0
BACKLASH = {backlash}
HOME_SEQUENCE = {sequence}
{homing}"""


def machine(letters, units, homing, backlash):
    name = f"{letters}-{units}-{homing}-{'backlash' if backlash else 'plain'}"
    folder = Path(name)
    folder.mkdir()
    k = 1.0 if units == "mm" else 1 / 25.4
    text = INI.format(name=name, lathe=int(letters == "XZ"), letters=letters, units=units,
                      joints=len(letters), vel=30 * k)
    hal = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT base_period_nsec=[EMCMOT]BASE_PERIOD servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt stepgen step_type={types}
loadrt sim_home_switch count={count}
addf stepgen.make-pulses base-thread
addf stepgen.capture-position servo-thread
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf stepgen.update-freq servo-thread
net estop-out iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
""".format(types=",".join("0" * len(letters)), count=len(letters))
    for n, letter in enumerate(letters):
        u = 1.0 if letter in "ABC" else k
        lines = ""
        if homing != "none":
            lines = f"HOME_OFFSET = {3 * u}\nHOME_SEARCH_VEL = {8 * u}\nHOME_LATCH_VEL = {-2 * u}\n"
        if homing == "index":
            lines += "HOME_USE_INDEX = YES\n"
        text += AXIS.format(letter=letter, n=n, kind="ANGULAR" if letter in "ABC" else "LINEAR", vel=20 * u,
                            acc=200 * u, genacc=250 * u, genvel=25 * u, scale=100 / u, low=-60 * u, high=60 * u,
                            ferror=1 * u, backlash=0.05 * u if backlash else 0,
                            sequence=0 if letter == "Z" else 1, homing=lines)
        hal += f"""addf sim-home-switch.{n} servo-thread
setp sim-home-switch.{n}.home-pos {5 * u}
setp sim-home-switch.{n}.hysteresis {0.5 * u}
setp stepgen.{n}.position-scale [JOINT_{n}]SCALE
setp stepgen.{n}.maxaccel [JOINT_{n}]STEPGEN_MAXACCEL
setp stepgen.{n}.maxvel [JOINT_{n}]STEPGEN_MAXVEL
net cmd-{n} joint.{n}.motor-pos-cmd => stepgen.{n}.position-cmd
net fb-{n} stepgen.{n}.position-fb => joint.{n}.motor-pos-fb sim-home-switch.{n}.cur-pos
net on-{n} joint.{n}.amp-enable-out => stepgen.{n}.enable
net home-{n} sim-home-switch.{n}.home-sw => joint.{n}.home-sw-in
net index-{n} joint.{n}.index-enable <=> sim-home-switch.{n}.index-enable
"""
    (folder / "m.ini").write_text(text)
    (folder / "m.hal").write_text(hal)
    (folder / "m.tbl").write_text("T1 P1 ;tool\n")
    second = letters[1]
    (folder / "m.ngc").write_text(f"G21 G90 G18 G0 X5\nG1 F600 X10 {second}4\nG0 X0 {second}0\nM2\n")


number = 0
for letters in AXES:
    for homing in HOMING:
        machine(letters, ("mm", "inch")[number % 2], homing, number % 3 == 0)
        number += 1
