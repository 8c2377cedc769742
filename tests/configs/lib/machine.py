# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes small machines, one folder each, for tests that start them."""
from pathlib import Path

AXIS = """
[AXIS_{letter}]
MIN_LIMIT = -10
MAX_LIMIT = 10
MAX_VELOCITY = 5
MAX_ACCELERATION = 50
"""
JOINT = """
[JOINT_{n}]
TYPE = LINEAR
MIN_LIMIT = -10.001
MAX_LIMIT = 10.001
MAX_VELOCITY = 5
MAX_ACCELERATION = 50
FERROR = 0.5
MIN_FERROR = 0.1
HOME = 0
HOME_OFFSET = {offset}
HOME_SEARCH_VEL = {search}
HOME_LATCH_VEL = {latch}
HOME_SEQUENCE = {sequence}
"""


def machine(name, hal, letters="XYZ", kins=None, extra="", joint_extra="", home=(0, 0, 0), base=0,
            spindles=1, motmod="", sequences=None, joints=None, sections="", files=None):
    """One folder with NAME.ini; hal: lines of [HAL]; home: offset, search and latch velocity of every joint, or of
    each. sections: lines of other sections; files: {name: text}, executable when they begin with #!."""
    folder = Path(name)
    folder.mkdir()
    joints = joints or len(letters)
    homes = home if isinstance(home[0], tuple) else (home,) * joints
    joint_sections = "".join(JOINT.format(n=n, offset=offset, search=search, latch=latch,
                                          sequence=sequences[n] if sequences and n < len(sequences) else 0
                                          if search == 0 else 1 + n) + joint_extra
                             for n, (offset, search, latch) in enumerate(homes))
    axes = "".join(AXIS.format(letter=letter) for letter in dict.fromkeys(letters))
    (folder / f"{name}.ini").write_text(f"""[EMC]
VERSION = 1.1
MACHINE = {name}
[DISPLAY]
DISPLAY = axis
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = sim.var
[EMCMOT]
EMCMOT = motmod{motmod}
SERVO_PERIOD = 1000000
BASE_PERIOD = {base}
[EMCIO]
TOOL_TABLE = tool.tbl
[HAL]
HALUI = halui
{hal}
[TRAJ]
COORDINATES = {letters}
SPINDLES = {spindles}
LINEAR_UNITS = inch
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = 5
DEFAULT_LINEAR_VELOCITY = 1
[KINS]
KINEMATICS = {kins or 'trivkins coordinates=' + letters.lower()}
JOINTS = {joints}
{sections}
{extra}
{axes}
{joint_sections}
""")
    (folder / "tool.tbl").write_text("T1 P1 D0.125 Z0.5 ;mill\n")
    for file, text in (files or {}).items():
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        if text.startswith("#!"):
            path.chmod(0o755)
