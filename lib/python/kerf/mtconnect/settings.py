# SPDX-License-Identifier: GPL-2.0-or-later
"""What the agent takes from the INI file."""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

import linuxcnc

LETTERS = "XYZABCUVW"
LINEAR = "XYZUVW"
UNITS = {  # type of a HAL_ITEM: its unit in MTConnect
    "LOAD": "PERCENT", "TEMPERATURE": "CELSIUS", "PRESSURE": "PASCAL", "VOLTAGE": "VOLT", "VOLT_AMPERE": "VOLT_AMPERE",
    "AMPERAGE": "AMPERE", "WATTAGE": "WATT", "FREQUENCY": "HERTZ", "DISPLACEMENT": "MILLIMETER",
    "VELOCITY": "MILLIMETER/SECOND", "ACCELERATION": "MILLIMETER/SECOND^2", "ANGLE": "DEGREE",
    "ANGULAR_VELOCITY": "DEGREE/SECOND", "ANGULAR_ACCELERATION": "DEGREE/SECOND^2", "TORQUE": "NEWTON_METER",
    "POWER_FACTOR": "PERCENT", "FILL_LEVEL": "PERCENT",
    "HUMIDITY_RELATIVE": "PERCENT", "CONCENTRATION": "PERCENT", "FLOW": "LITER/SECOND", "MASS": "KILOGRAM",
    "RESISTANCE": "OHM", "SOUND_LEVEL": "DECIBEL", "STRAIN": "PERCENT",
    "TILT": "MICRO_RADIAN", "VISCOSITY": "PASCAL_SECOND", "PH": "PH", "CAPACITY_FLUID": "MILLILITER",
    "LINEAR_FORCE": "NEWTON", "VOLTAGE_DC": "VOLT", "VOLTAGE_AC": "VOLT",
    "AMPERAGE_DC": "AMPERE", "AMPERAGE_AC": "AMPERE", "PROCESS_TIMER": "SECOND", "POSITION": "MILLIMETER",
    "ROTARY_VELOCITY": "REVOLUTION/MINUTE"}


def warn(message):
    print(f"warning: {message}", file=sys.stderr, flush=True)


@dataclass
class HalItem:
    """[MTCONNECT]HAL_ITEM: a HAL pin as a sample."""
    pin: str
    id: str
    type: str
    units: str
    name: str = ""
    subtype: str = ""
    component: str = "sensors"


@dataclass
class Joint:
    """[JOINT_n]; lengths in mm, angles in degrees; None: not set."""
    number: int
    kind: str
    axis: str
    limits: tuple
    home: float | None
    home_offset: float | None


@dataclass
class Settings:
    folder: Path
    enable: bool
    name: str
    uuid: str
    transports: set
    http_port: int
    http_bind: str
    shdr_port: int
    shdr_bind: str
    sample_hz: float
    broker: str
    mqtt_port: int
    mqtt_prefix: str
    mqtt_user: str
    mqtt_password: str
    axes: str             # letters of the machine, each once
    mm: float             # machine units per mm
    degree: float         # machine units per degree
    module: str           # kinematics module
    module_words: str     # its parameters
    joints: list
    axis_limits: dict
    spindle_limits: tuple
    hal_items: list = field(default_factory=list)

    @property
    def id(self):
        return "dev_" + self.plain_name

    @property
    def plain_name(self):
        return re.sub(r"[^A-Za-z0-9_.-]", "_", self.name)

    def scaled(self, letter, value):
        """A position in machine units in mm or degrees."""
        return None if value is None else value / (self.mm if letter in LINEAR else self.degree)


def hal_item(line, taken, axes):
    """The item that a line describes; None with a warning when it cannot be one."""
    words = dict(part.strip().split("=", 1) for part in line.split(",") if "=" in part)
    words = {key.strip(): value.strip() for key, value in words.items()}
    missing = [key for key in ("pin", "id", "type") if not words.get(key)]
    if missing:
        return warn(f"[MTCONNECT]HAL_ITEM = {line}: {' and '.join(missing)} missing")
    identifier, kind = words["id"], words["type"].upper()
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_.-]*", identifier):
        return warn(f"[MTCONNECT]HAL_ITEM = {line}: {identifier} is no id: a letter or _, then letters, digits and _.-")
    if identifier in taken:
        return warn(f"[MTCONNECT]HAL_ITEM = {line}: the id {identifier} is taken")
    if kind not in UNITS:
        return warn(f"[MTCONNECT]HAL_ITEM = {line}: {words['type']} is not one of {' '.join(sorted(UNITS))}")
    place = words.get("component", "sensors")
    letter = place.lower().removeprefix("axis_").upper()
    if letter in axes and len(letter) == 1:
        place = f"axis_{letter.lower()}"
    else:
        place = {"sensors": "sensors", "spindle": "spindle", "controller": "ctrl", "ctrl": "ctrl",
                 "path": "path"}.get(place.lower())
    if not place:
        return warn(f"[MTCONNECT]HAL_ITEM = {line}: no component {words['component']}; there are sensors, spindle, "
                    f"controller, path and the axes {axes}")
    return HalItem(words["pin"], identifier, kind, words.get("units", UNITS[kind]), words.get("name", ""),
                   words.get("subType", ""), place)


def joint_axes(module_words, coordinates, joints):
    """The letter of each joint's axis: coordinates= of the module, or else [TRAJ]COORDINATES."""
    given = re.search(r"coordinates=([A-Za-z]+)", module_words)
    letters = (given[1] if given else coordinates).upper()
    return [letters[n] if n < len(letters) else "" for n in range(joints)]


def read(path):
    """Raises linuxcnc.error when the file cannot be read."""
    ini = linuxcnc.ini(str(path))
    section = "MTCONNECT"

    def number(of, *names):
        for name in names:
            if (value := ini.getreal(of, name)) is not None:
                return value
        return None

    transports = set(re.split(r"[,\s]+", (ini.find(section, "TRANSPORT") or "http").lower())) - {""}
    if "both" in transports:
        transports = transports - {"both"} | {"http", "mqtt"}
    for word in sorted(transports - {"http", "mqtt", "shdr"}):
        warn(f"[MTCONNECT]TRANSPORT: {word} is not one of http, mqtt, shdr")
    coordinates = re.sub(r"[^A-Z]", "", (ini.find("TRAJ", "COORDINATES") or "XYZ").upper())
    axes = "".join(letter for letter in LETTERS if letter in coordinates)
    words = (ini.find("KINS", "KINEMATICS") or "trivkins").split()
    module, module_words = words[0], " ".join(words[1:])
    mm, degree = (ini.getlinearunits("TRAJ", "LINEAR_UNITS", fallback=1.0),
                  ini.getangularunits("TRAJ", "ANGULAR_UNITS", fallback=1.0))
    joints = []
    for n, letter in enumerate(joint_axes(module_words, coordinates, ini.getint("KINS", "JOINTS", fallback=3))):
        linear = (ini.find(f"JOINT_{n}", "TYPE") or "LINEAR").upper() == "LINEAR"
        scaled = [None if v is None else v / (mm if linear else degree)
                  for v in (number(f"JOINT_{n}", name) for name in ("MIN_LIMIT", "MAX_LIMIT", "HOME", "HOME_OFFSET"))]
        joints.append(Joint(n, "LINEAR" if linear else "ANGULAR", letter, tuple(scaled[:2]), *scaled[2:]))
    settings = Settings(
        folder=Path(path).resolve().parent, enable=ini.getbool(section, "ENABLE", fallback=True),
        name=ini.find(section, "DEVICE_NAME") or ini.find("EMC", "MACHINE") or "linuxcnc",
        uuid=ini.find(section, "UUID") or "linuxcnc-0001",
        transports=transports, http_port=ini.getint(section, "HTTP_PORT", fallback=5000),
        http_bind=ini.find(section, "HTTP_BIND") or "127.0.0.1",
        shdr_port=ini.getint(section, "SHDR_PORT", fallback=7878),
        shdr_bind=ini.find(section, "SHDR_BIND") or "127.0.0.1",
        sample_hz=ini.getreal(section, "SAMPLE_HZ", fallback=10.0),
        broker=ini.find(section, "MQTT_BROKER") or "localhost",
        mqtt_port=ini.getint(section, "MQTT_PORT", fallback=1883),
        mqtt_prefix=ini.find(section, "MQTT_PREFIX") or "MTConnect",
        mqtt_user=ini.find(section, "MQTT_USERNAME") or ini.find(section, "MQTT_USER") or "",
        mqtt_password=ini.find(section, "MQTT_PASSWORD") or ini.find(section, "MQTT_PASS") or "",
        axes=axes, mm=mm, degree=degree, module=module, module_words=module_words, joints=joints, axis_limits={},
        spindle_limits=tuple(next((v for v in (number("SPINDLE_0", name), number("SPINDLE", name)) if v is not None),
                                  None)
                             for name in ("MIN_FORWARD_VELOCITY", "MAX_FORWARD_VELOCITY")))
    for letter in axes:
        settings.axis_limits[letter] = tuple(settings.scaled(letter, number(f"AXIS_{letter}", name))
                                             for name in ("MIN_LIMIT", "MAX_LIMIT"))
    return settings, ini
