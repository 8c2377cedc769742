# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of the AXIS screen from the INI file; no widgets here.

Defaults and checks: GUI reference, sections 1.3 and 1.5. Speeds are machine units a second.
"""

import re
from dataclasses import dataclass, field

from kerf import inivalues
from kerf.inivalues import LETTERS

MM_PER_INCH = 25.4


class SettingsError(Exception):
    """A setting without which the screen cannot start; the text names it."""


@dataclass
class Settings:
    """What the INI file says. `units_per_mm`: machine units in a millimetre."""
    ini: object
    ini_path: str = ""
    machine: str = "<unknown>"
    coordinates: str = "XYZ"
    joints: int = 3
    units_per_mm: float = 1.0
    kinematics: str = "trivkins"
    lathe: bool = False
    back_tool_lathe: bool = False
    foam: bool = False
    cycle_ms: int = 20
    relative: bool = False
    commanded: bool = False
    metric: bool = True
    max_feed_override: float = 1.0
    max_spindle_override: float = 1.0
    default_spindle_speed: int = 1
    max_linear: float = 1.0
    default_linear: float = 1.0
    max_angular: float = 1.0
    default_angular: float = 1.0
    max_velocity: float = 1.0
    geometry: str = "XYZABCUVW"
    foam_z: float = 0.0          # inches
    foam_w: float = 1.5
    increments: list = field(default_factory=list)
    grids: list = field(default_factory=list)
    warnings: list = field(default_factory=list)

    @property
    def axes(self):
        """Letters of COORDINATES, each once, in the order X Y Z A B C U V W."""
        return [c for c in LETTERS if c in self.coordinates]

    @property
    def axis_mask(self):
        return sum(1 << LETTERS.index(c) for c in self.axes)

    def find(self, section, name, default=None):
        value = self.ini.find(section, name)
        return default if value is None else value

    def real(self, *places, default=None):
        """First number among (section, name) pairs."""
        for section, name in places:
            value = self.ini.getreal(section, name)
            if value is not None:
                return value
        return default

    def flag(self, section, name):
        return bool(self.ini.getbool(section, name, fallback=False))

    def joint_type(self, n):
        return (self.find(f"JOINT_{n}", "TYPE", "LINEAR")).upper()

    def axis_type(self, letter):
        return (self.find(f"AXIS_{letter}", "TYPE", "ANGULAR" if letter in "ABC" else "LINEAR")).upper()

    def has_linear(self):
        return any(self.axis_type(c) == "LINEAR" for c in self.axes) or \
            any(self.joint_type(j) == "LINEAR" for j in range(self.joints))

    def has_angular(self):
        return any(c in "ABC" for c in self.axes) or any(self.joint_type(j) == "ANGULAR" for j in range(self.joints))

    def home_sequence(self, joint):
        """Text of [JOINT_n]HOME_SEQUENCE or ""."""
        return self.find(f"JOINT_{joint}", "HOME_SEQUENCE", "")

    def all_sequences(self):
        return all(self.home_sequence(j) != "" for j in range(self.joints))

    def trivkins_letters(self):
        return inivalues.trivkins_letters(self.kinematics)

    def joint_of(self, letter):
        """Joint of a letter with identity kinematics: its first place in COORDINATES."""
        if self.historical_lathe():
            return "XYZ".index(letter)
        return self.coordinates.index(letter)

    def historical_lathe(self):
        """Lathe of the old kind: COORDINATES X Z with three joints, of which Y is a dummy."""
        return self.lathe and self.coordinates == "XZ" and self.joints == 3

    def jog_order(self):
        given = self.find("DISPLAY", "JOG_AXES")
        if given:
            return [c for c in given.upper() if c in self.axes]
        order = "ZXYABCUVW" if self.lathe else "XYUVABCZW" if self.foam else LETTERS
        return [c for c in order if c in self.axes]

    def jog_invert(self):
        given = self.find("DISPLAY", "JOG_INVERT")
        if given is not None:
            return given.upper()
        return "X" if self.lathe and not self.back_tool_lathe else ""

    def min_speed(self, angular):
        """Least position of a speed slider, units/min."""
        name = "MIN_ANGULAR_VELOCITY" if angular else "MIN_LINEAR_VELOCITY"
        value = self.real(("DISPLAY", name), ("DISPLAY", "MIN_VELOCITY"))
        if value is not None:
            return 60 * value
        scales = [abs(self.ini.getreal(f"AXIS_{c}", "SCALE") or 8000) for c in self.axes]
        return 30 * min(1 / s for s in scales)


def parse_increment(text, units_per_mm):
    """Distance in machine units of an increment such as "1/8 in", "0.1mm", ".5"; ValueError otherwise."""
    match = re.fullmatch(r"\s*([0-9.]+)(?:\s*/\s*([0-9.]+))?\s*([a-zA-Z]*)\s*", text)
    if not match:
        raise ValueError(f"'{text}' is no increment: write a number or a fraction and mm, cm, um, in, inch or mil")
    value = float(match[1]) / (float(match[2]) if match[2] else 1.0)
    unit = match[3].lower()
    if not unit:
        return value
    mm = {"mm": 1.0, "cm": 10.0, "um": 0.001, "in": MM_PER_INCH, "inch": MM_PER_INCH, "mil": MM_PER_INCH / 1000}
    if unit not in mm:
        raise ValueError(f"'{text}': the unit {unit} is not mm, cm, um, in, inch or mil")
    return value * mm[unit] * units_per_mm


def split_list(text):
    """Items separated by commas, or by blanks when there is no comma."""
    return [item.strip() for item in (text.split(",") if "," in text else text.split()) if item.strip()]


def cycle_ms(text):
    """CYCLE_TIME in ms: below 1 seconds, else milliseconds; 20 when it is no number."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return 20
    return max(1, round(value * 1000 if value < 1 else value))


def read(ini):
    """Settings from a linuxcnc.ini object. Raises SettingsError."""
    def need(section, name, text=None):
        value = ini.find(section, name)
        if value is None:
            raise SettingsError(text or f"Missing [{section}]{name}")
        return value

    need("RS274NGC", "PARAMETER_FILE", "Missing INI file setting for [RS274NGC]PARAMETER_FILE")
    need("TRAJ", "LINEAR_UNITS")
    units = ini.getlinearunits("TRAJ", "LINEAR_UNITS")
    if units is None:
        raise SettingsError("Invalid [TRAJ]LINEAR_UNITS")
    s = Settings(ini)
    s.units_per_mm = units
    s.coordinates = re.sub(r"[^XYZABCUVW]", "", need("TRAJ", "COORDINATES").upper())
    s.machine = s.find("EMC", "MACHINE", "<unknown>")
    s.joints = ini.getint("KINS", "JOINTS") or len(s.coordinates)
    s.kinematics = s.find("KINS", "KINEMATICS", "trivkins")
    s.lathe, s.foam = s.flag("DISPLAY", "LATHE"), s.flag("DISPLAY", "FOAM")
    s.back_tool_lathe = s.flag("DISPLAY", "BACK_TOOL_LATHE")
    s.lathe = s.lathe or s.back_tool_lathe
    s.cycle_ms = cycle_ms(s.find("DISPLAY", "CYCLE_TIME", ".020"))
    s.relative = s.find("DISPLAY", "POSITION_OFFSET") == "RELATIVE"
    s.commanded = s.find("DISPLAY", "POSITION_FEEDBACK") == "COMMANDED"
    shown = s.find("DISPLAY", "POSITION_UNITS")
    s.metric = shown.lower() in ("mm", "metric") if shown is not None else \
        any(abs(units - u) < 1e-9 for u in (.001, .01, .1, 1, 10))
    s.max_feed_override = s.real(("DISPLAY", "MAX_FEED_OVERRIDE"), default=1.0)
    s.max_spindle_override = s.real(("DISPLAY", "MAX_SPINDLE_OVERRIDE"), default=s.max_feed_override)
    s.default_spindle_speed = int(s.real(("DISPLAY", "DEFAULT_SPINDLE_SPEED"), default=1))
    s.geometry = s.find("DISPLAY", "GEOMETRY", "XYZABCUVW").upper()
    s.foam_z, s.foam_w = s.real(("DISPLAY", "FOAM_Z"), default=0.0), s.real(("DISPLAY", "FOAM_W"), default=1.5)
    read_speeds(s)
    s.increments = split_list(s.find("DISPLAY", "INCREMENTS", "0.1000 0.0100 0.0010 0.0001"))
    s.grids = s.find("DISPLAY", "GRIDS", "10mm 20mm 50mm 100mm 1in 2in 5in 10in").split()
    return s


def read_speeds(s):
    """Ranges of the speed sliders. Raises SettingsError."""
    def required(*places):
        value = s.real(*places)
        if value is None:
            names = "\n".join(f"    [{section}]{name}" for section, name in places)
            raise SettingsError(f"Missing required specifier; one of these is needed:\n{names}")
        return value

    linear = (("DISPLAY", "MAX_LINEAR_VELOCITY"), ("TRAJ", "MAX_LINEAR_VELOCITY"))
    s.max_velocity = required(*linear, ("AXIS_X", "MAX_VELOCITY"))
    if s.has_linear():
        s.max_linear = required(*linear)
        s.default_linear = s.real(("DISPLAY", "DEFAULT_LINEAR_VELOCITY"), ("TRAJ", "DEFAULT_LINEAR_VELOCITY"),
                                  default=s.max_linear)
    if s.has_angular():
        angular = s.real(("DISPLAY", "MAX_ANGULAR_VELOCITY"), ("TRAJ", "MAX_ANGULAR_VELOCITY"))
        if angular is None:
            s.warnings.append("[DISPLAY]MAX_ANGULAR_VELOCITY is missing: 1 degree/s is used")
            angular = 1.0
        s.max_angular = angular
        s.default_angular = s.real(("DISPLAY", "DEFAULT_ANGULAR_VELOCITY"), ("TRAJ", "DEFAULT_ANGULAR_VELOCITY"),
                                   default=angular)
