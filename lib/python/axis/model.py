# SPDX-License-Identifier: GPL-2.0-or-later
"""What the screen knows of the machine and may ask of it; no widgets here.

Positions are machine units and degrees. Every method returns at once; refusals come back
as messages, never as exceptions.
"""

import linuxcnc

LETTERS = "XYZABCUVW"


class Machine:
    """One connection to the controller."""

    def __init__(self, ini_path):
        self.ini = linuxcnc.ini(ini_path)
        self.stat, self.command = linuxcnc.stat(), linuxcnc.command()
        self.errors = linuxcnc.error_channel()
        letters = (self.ini.find("TRAJ", "COORDINATES") or "XYZ").upper()
        self.axes = [c for c in LETTERS if c in letters]
        self.joints = int(self.ini.find("KINS", "JOINTS") or len(self.axes))
        self.units = self.ini.find("TRAJ", "LINEAR_UNITS") or "mm"
        self.jog_speed = float(self.ini.find("DISPLAY", "DEFAULT_LINEAR_VELOCITY") or
                               self.ini.find("TRAJ", "DEFAULT_LINEAR_VELOCITY") or 1.0)
        self.max_jog_speed = float(self.ini.find("DISPLAY", "MAX_LINEAR_VELOCITY") or self.jog_speed * 5)
        self.max_feed = float(self.ini.find("DISPLAY", "MAX_FEED_OVERRIDE") or 1.0)
        self.jogging = None
        self.file = None

    # -- status ----------------------------------------------------------------------------

    def poll(self):
        """Fresh status. Raises linuxcnc.error when the controller is gone."""
        self.stat.poll()
        return self.stat

    def message(self):
        """(is an error, text) of the next message, or None."""
        found = self.errors.poll()
        if not found:
            return None
        kind, text = found
        return kind in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR), text

    def estop(self):
        return self.stat.task_state == linuxcnc.STATE_ESTOP

    def is_on(self):
        return self.stat.task_state == linuxcnc.STATE_ON

    def homed(self):
        return all(self.stat.homed[:self.joints])

    def idle(self):
        return self.stat.interp_state == linuxcnc.INTERP_IDLE

    def paused(self):
        return bool(self.stat.paused)

    def position(self, axis):
        """Position of a letter in the active coordinate system, machine units."""
        s, i = self.stat, LETTERS.index(axis)
        return s.actual_position[i] - s.g5x_offset[i] - s.g92_offset[i] - s.tool_offset[i]

    def state_text(self):
        s = self.stat
        if self.estop():
            return "EMERGENCY STOP"
        if not self.is_on():
            return "OFF"
        mode = {linuxcnc.MODE_MANUAL: "MANUAL", linuxcnc.MODE_AUTO: "AUTO", linuxcnc.MODE_MDI: "MDI"}[s.task_mode]
        doing = "" if self.idle() else ", PAUSED" if self.paused() else ", RUNNING"
        return f"ON, {mode}{doing}" + ("" if self.homed() else ", NOT HOMED")

    # -- commands --------------------------------------------------------------------------

    def mode(self, mode):
        """Asks for a mode; False while a program keeps it."""
        if self.stat.task_mode == mode:
            return True
        if not self.idle():
            return False
        self.command.mode(mode)
        self.command.wait_complete(1.0)
        return True

    def toggle_estop(self):
        self.command.state(linuxcnc.STATE_ESTOP_RESET if self.estop() else linuxcnc.STATE_ESTOP)

    def toggle_power(self):
        if not self.estop():
            self.command.state(linuxcnc.STATE_OFF if self.is_on() else linuxcnc.STATE_ON)

    def home_all(self):
        if self.is_on() and self.mode(linuxcnc.MODE_MANUAL):
            self.command.teleop_enable(0)
            self.command.wait_complete(1.0)
            self.command.home(-1)

    def open(self, path):
        if self.idle() and self.mode(linuxcnc.MODE_AUTO):
            self.command.program_open(path)
            self.file = path

    def run(self):
        if self.is_on() and self.homed() and self.file and self.mode(linuxcnc.MODE_AUTO):
            self.command.auto(linuxcnc.AUTO_RUN, 0)

    def step(self):
        if self.is_on() and self.homed() and self.file and self.mode(linuxcnc.MODE_AUTO):
            self.command.auto(linuxcnc.AUTO_STEP)

    def pause_or_resume(self):
        if self.idle():
            return
        self.command.auto(linuxcnc.AUTO_RESUME if self.paused() else linuxcnc.AUTO_PAUSE)

    def abort(self):
        self.stop_jog()
        self.command.abort()

    def mdi(self, text):
        """True when the line was sent."""
        if not (self.is_on() and self.homed() and text.strip() and self.mode(linuxcnc.MODE_MDI)):
            return False
        self.command.mdi(text)
        return True

    def feed_override(self, scale):
        self.command.feedrate(scale)

    def can_jog(self):
        return self.is_on() and self.idle()

    def start_jog(self, axis, direction):
        """Jogs a letter, or its joint while the machine is not homed, until stop_jog()."""
        if self.jogging or not self.can_jog() or not self.mode(linuxcnc.MODE_MANUAL):
            return
        joint_jog = not self.homed()
        self.command.teleop_enable(0 if joint_jog else 1)
        self.command.wait_complete(1.0)
        number = self.axes.index(axis) if joint_jog else LETTERS.index(axis)
        self.jogging = (joint_jog, number)
        self.command.jog(linuxcnc.JOG_CONTINUOUS, joint_jog, number, direction * self.jog_speed)

    def stop_jog(self):
        if self.jogging:
            self.command.jog(linuxcnc.JOG_STOP, *self.jogging)
            self.jogging = None
