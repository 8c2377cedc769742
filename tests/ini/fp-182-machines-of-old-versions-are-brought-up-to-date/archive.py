# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes machines as they were written for older versions: one folder each."""
from pathlib import Path

INI = """# {title}
[EMC]
{version}
MACHINE = {name}
[DISPLAY]
DISPLAY = {display}
CYCLE_TIME = 0.100
PROGRAM_PREFIX = .
[FILTER]
PROGRAM_EXTENSION = .py Script
[RS274NGC]
PARAMETER_FILE = sim.var
{features}
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 1.0
{comm_wait}SERVO_PERIOD = 1000000
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[HAL]
HALUI = halui
HALFILE = {name}.hal
[TRAJ]
AXES = {axes}
COORDINATES = {coordinates}
LINEAR_UNITS = {linear}
ANGULAR_UNITS = {angular}
CYCLE_TIME = 0.010
DEFAULT_VELOCITY = 1.0
MAX_VELOCITY = 4.0
DEFAULT_ACCELERATION = 20.0
MAX_ACCELERATION = 20.0
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = tool.tbl
"""
AXIS = """[AXIS_{n}]
TYPE = {type}
HOME = 0.0
MAX_VELOCITY = {velocity}
MAX_ACCELERATION = 20.0
BACKLASH = 0.000
MIN_LIMIT = -10.0
MAX_LIMIT = {high}
FERROR = 0.5
MIN_FERROR = 0.1
HOME_OFFSET = 0.0
HOME_SEARCH_VEL = 0
HOME_LATCH_VEL = 0
HOME_SEQUENCE = {sequence}
{own}
"""
HAL = """# motion and I/O
loadrt {kins}
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[TRAJ]AXES
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net estop-loop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in
net prep iocontrol.0.tool-prepare iocontrol.0.tool-prepared
net change iocontrol.0.tool-change iocontrol.0.tool-changed
net speed motion.spindle-speed-out-rps-abs
net on motion.spindle-on
net fwd halui.spindle.is-on
net jog halui.jog.0.plus
setp axis.0.jog-scale 0.01
net wheel axis.0.jog-counts
"""


def machine(name, title, axes, coordinates, version="VERSION = $Revision$", kins="trivkins", extra_hal="",
            linear="inch", angular="degree", features="FEATURES = 12", comm_wait="COMM_WAIT = 0.01\n", display="axis",
            high=10.0, own="", first=(2,)):
    folder = Path(name)
    folder.mkdir()
    text = INI.format(name=name, title=title, version=version, axes=len(axes), coordinates=coordinates, linear=linear,
                      angular=angular, features=features, comm_wait=comm_wait, display=display)
    for i, n in enumerate(axes):
        text += AXIS.format(n=n, type="ANGULAR" if 3 <= n <= 5 and kins != "gantrykins" else "LINEAR",
                            velocity=4.0 if i else 3.5, high=high,
                            sequence=0 if n in first else -1 if name == "unordered" else 1, own=own)
    (folder / f"{name}.ini").write_text(text)
    hal = HAL.format(kins=kins)
    for n in axes:
        hal += f"net p{n} axis.{n}.motor-pos-cmd => axis.{n}.motor-pos-fb\nnet en{n} <= axis.{n}.amp-enable-out\n"
    (folder / f"{name}.hal").write_text(hal + extra_hal)
    (folder / "tool.tbl").write_text("T1 P1 D0.125 Z0.5 ;mill\n")


machine("mill", "three axes", [0, 1, 2], "X Y Z")
machine("lathe", "X and Z only", [0, 2], "X Z", version="", display="tkemc")
machine("rotary", "a rotary axis", [0, 1, 2, 3], "X Y Z A", kins="trivkins", version="VERSION = 0.9")
machine("gantry", "two motors for Y", [0, 1, 2, 3], "X Y Z", kins="gantrykins",
        extra_hal="setp gantrykins.joint-0 0\nsetp gantrykins.joint-1 1\nsetp gantrykins.joint-2 2\n"
                  "setp gantrykins.joint-3 1\n")
machine("bridge", "two motors for Y, which home first", [0, 1, 2, 3], "X Y Z", kins="gantrykins", first=(1, 3),
        extra_hal="setp gantrykins.joint-0 0\nsetp gantrykins.joint-1 1\nsetp gantrykins.joint-2 2\n"
                  "setp gantrykins.joint-3 1\n")
machine("numbers", "numeric units, 22 and 22.222", [0, 1, 2], "X Y Z", linear="0.03937007874016", angular="1.0",
        high=22, features="FEATURES = 1")
machine("fraction", "22.222 is no stranger than 22", [0, 1, 2], "X Y Z", linear="1", angular="1.0",
        high=22.222, features="")
machine("unordered", "homing sequence -1: not in home-all", [0, 1, 2], "X Y Z")
