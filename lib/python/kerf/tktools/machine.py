# SPDX-License-Identifier: GPL-2.0-or-later
"""A machine as a small screen sees it: status, commands, names of axes and joints, positions, jogging."""

import re
from pathlib import Path

import linuxcnc

from .. import clock
from .. import position as offsets
from ..inivalues import LETTERS, trivkins_letters

INCH_MM = 25.4
PER_MM = {"mm": 1.0, "inches": 1 / INCH_MM, "cm": 0.1}
PROGRAM_UNITS = {1: "inches", 2: "mm", 3: "cm"}
UNIT_WORDS = {"mm": 1.0, "cm": 10.0, "um": 0.001, "in": INCH_MM, "inch": INCH_MM, "mil": INCH_MM / 1000}
WAIT_S, START_S = 5.0, 5.0
DEFAULT_RPM = 500.0


def increment_mm(text):
    """Length of a jog increment as written in an INI file (1mm, .01in, 1/8 in); (number, mm per unit or None).
    ValueError."""
    match = re.fullmatch(r"\s*([\d.]+)(?:\s*/\s*([\d.]+))?\s*([a-z]*)\s*", text, re.I)
    if not match or (match[3] and match[3].lower() not in UNIT_WORDS):
        raise ValueError(f"'{text}' is no length")
    return float(match[1]) / float(match[2] or 1), UNIT_WORDS.get(match[3].lower())


class Machine:
    """Raises linuxcnc.error when no controller runs. Speeds are machine units per minute."""

    def __init__(self, path):
        self.path = Path(path).resolve()
        self.ini = linuxcnc.ini(str(self.path))
        nml = self.ini.find("EMC", "NML_FILE")
        if nml:
            linuxcnc.nmlfile = nml
        self.stat, self.command, self.errors = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()
        self.stat.poll()
        clock.wait_until(self._described, START_S)
        self.letters = [c for n, c in enumerate(LETTERS) if self.stat.axis_mask & (1 << n)]
        # letters by joint
        self.coordinates = list(trivkins_letters(self.ini.find("KINS", "KINEMATICS") or "trivkins")
                                or (self.ini.find("TRAJ", "COORDINATES") or "").upper().replace(" ", ""))
        del self.coordinates[self.stat.joints:]
        cycle = float(self.ini.find("DISPLAY", "CYCLE_TIME") or 0.2)
        self.cycle_ms = int(min(max(cycle * 1000 if cycle < 10 else cycle, 20), 1000))
        self.max_linear = 60 * self._real("MAX_LINEAR_VELOCITY", self.stat.max_velocity or 1)
        self.max_angular = 60 * self._real("MAX_ANGULAR_VELOCITY", 60)
        self.linear_speed = min(60 * self._real("DEFAULT_LINEAR_VELOCITY", self.max_linear / 240), self.max_linear)
        self.angular_speed = min(60 * self._real("DEFAULT_ANGULAR_VELOCITY", self.max_angular / 240), self.max_angular)
        text = self.ini.find("DISPLAY", "INCREMENTS") or ""
        words = [w.strip() for w in text.split(",")] if "," in text else text.split()
        self.increments = [w for w in words if self._length(w)]

    def _described(self):
        """The status tells the machine's axes: shortly after the start."""
        self.stat.poll()
        return self.stat.axis_mask

    def _real(self, name, default):
        try:
            return float(self.ini.find("DISPLAY", name) or default)
        except ValueError:
            return default

    @staticmethod
    def _length(text):
        try:
            return increment_mm(text)[0] > 0
        except ValueError:
            return False

    # -- names and positions ------------------------------------------------------------

    def names(self, joints=False):
        return [str(j) for j in range(self.stat.joints)] if joints else list(self.letters)

    @property
    def all_homed(self):
        return all(self.stat.homed[:self.stat.joints])

    def joints_only(self):
        """Before all are homed, letters stand for joints only where each has one of its own."""
        one_each = (self.stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY
                    and len(set(self.coordinates)) == len(self.coordinates))
        return not one_each and not self.all_homed

    def row_of(self, letter, joints=False):
        """Row of an axis, or the first of its joints; None: there is none."""
        letters = self.coordinates if joints else self.letters
        return letters.index(letter) if letter in letters else None

    def is_angular(self, row, joints):
        return self.stat.joint[row]["jointType"] != linuxcnc.LINEAR if joints else self.letters[row] in "ABC"

    def unit_name(self, choice):
        return PROGRAM_UNITS.get(self.stat.program_units, "mm") if choice == "auto" else choice

    def system_name(self):
        n = self.stat.g5x_index
        return str(53 + n) if n <= 6 else f"59.{n - 6}"

    def position(self, row, joints, relative, actual, unit):
        """As shown: of a joint, or of an axis without its offsets. unit: auto, mm, inches, cm."""
        s = self.stat
        if joints:
            value = (s.joint_actual_position if actual else s.joint_position)[row]
            return value if self.is_angular(row, True) else value * self.factor(unit)
        values = list(s.actual_position if actual else s.position)
        if relative:
            values = offsets.relative(s, values)
        value = values[LETTERS.index(self.letters[row])]
        return value if self.is_angular(row, False) else value * self.factor(unit)

    def factor(self, unit):
        """Shown units per machine unit."""
        return PER_MM[self.unit_name(unit)] / (self.stat.linear_units or 1.0)

    def row_homed(self, row, joints):
        return bool(self.stat.homed[row]) if joints else self.all_homed

    # -- commands -----------------------------------------------------------------------

    def state(self, state):
        self.command.state(state)
        self.command.wait_complete(WAIT_S)

    def toggle_estop(self):
        self.stat.poll()
        self.state(linuxcnc.STATE_ESTOP_RESET if self.stat.task_state == linuxcnc.STATE_ESTOP else linuxcnc.STATE_ESTOP)

    def toggle_power(self):
        self.stat.poll()
        self.state(linuxcnc.STATE_OFF if self.stat.task_state == linuxcnc.STATE_ON else linuxcnc.STATE_ON)

    def mode(self, mode):
        """True when the machine is in this mode then; a running program keeps its mode."""
        self.stat.poll()
        if self.stat.task_mode != mode:
            if self.stat.interp_state != linuxcnc.INTERP_IDLE:
                return False
            self.command.mode(mode)
            self.command.wait_complete(WAIT_S)
            self.stat.poll()
        return self.stat.task_mode == mode

    def spindle(self, direction):
        if direction:
            self.command.spindle(linuxcnc.SPINDLE_FORWARD if direction > 0 else linuxcnc.SPINDLE_REVERSE,
                                 self.stat.settings[2] or DEFAULT_RPM)
        else:
            self.command.spindle(linuxcnc.SPINDLE_OFF)

    def teleop(self, on):
        """World or joint jogging; world only when all joints are homed."""
        self.stat.poll()
        if self.stat.task_mode == linuxcnc.MODE_MANUAL and (not on or self.all_homed):
            self.command.teleop_enable(int(on))
            self.command.wait_complete(WAIT_S)
            self.stat.poll()

    def home(self, row, joints=False):
        """One at a time; with it go those that are synchronized with it (negative HOME_SEQUENCE)."""
        self.stat.poll()
        if self.stat.task_mode != linuxcnc.MODE_MANUAL:
            return
        self.command.teleop_enable(0)
        self.command.wait_complete(WAIT_S)
        self.command.home(self.joint_of(row, joints))

    def joint_of(self, row, joints=False):
        """The joint behind a row: itself, or the first of the axis."""
        letter = None if joints else self.letters[row]
        return self.coordinates.index(letter) if letter in self.coordinates else row

    def override_limits(self):
        """Joints may be jogged off their switches; once more: no longer (leaving the manual mode ends it)."""
        self.stat.poll()
        if self.limits_overridden():
            self.mode(linuxcnc.MODE_AUTO)
            self.mode(linuxcnc.MODE_MANUAL)
        elif self.mode(linuxcnc.MODE_MANUAL):
            self.command.override_limits()

    def limits_overridden(self):
        return any(joint["override_limits"] for joint in self.stat.joint[:self.stat.joints])

    def pause(self):
        self.command.auto(linuxcnc.AUTO_PAUSE)

    def resume(self):
        self.command.auto(linuxcnc.AUTO_RESUME)

    def step(self):
        if self.stat.interp_state == linuxcnc.INTERP_IDLE and not (self.stat.file and self.mode(linuxcnc.MODE_AUTO)):
            return
        self.command.auto(linuxcnc.AUTO_STEP)

    def verify(self):
        if self.stat.file and self.stat.interp_state == linuxcnc.INTERP_IDLE and self.mode(linuxcnc.MODE_AUTO):
            self.command.auto(linuxcnc.AUTO_RUN, -1)


class Jog:
    """One jog at a time; `key` started it."""

    def __init__(self, machine):
        self.m, self.running, self.key = machine, None, None

    def start(self, row, direction, speeds, increment=None, key=None, joints=False):
        """A joint where joints are rows or not all are homed, else an axis. speeds: linear and angular, units per
        minute."""
        m = self.m
        m.stat.poll()
        if m.stat.task_state != linuxcnc.STATE_ON or m.stat.task_mode != linuxcnc.MODE_MANUAL:
            return
        self.stop()
        teleop = not joints and m.all_homed
        if m.stat.motion_mode != (linuxcnc.TRAJ_MODE_TELEOP if teleop else linuxcnc.TRAJ_MODE_FREE):
            m.teleop(teleop)
            teleop = m.stat.motion_mode == linuxcnc.TRAJ_MODE_TELEOP
        number = LETTERS.index(m.letters[row]) if teleop else m.joint_of(row, joints)
        angular = m.is_angular(row, joints)
        velocity = direction * speeds[angular] / 60
        if increment:
            length, mm = increment_mm(increment)
            distance = length * (mm * m.stat.linear_units if mm and not angular else 1.0)
            m.command.jog(linuxcnc.JOG_INCREMENT, not teleop, number, velocity, distance)
            return
        m.command.jog(linuxcnc.JOG_CONTINUOUS, not teleop, number, velocity)
        self.running, self.key = (not teleop, number), key

    def stop(self):
        if self.running:
            self.m.command.jog(linuxcnc.JOG_STOP, *self.running)
        self.running = self.key = None
