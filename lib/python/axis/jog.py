# SPDX-License-Identifier: GPL-2.0-or-later
"""Jogging: which joint or axis, how fast, and that it stops. No widgets here.

One jog has one owner (a key or a button). It ends when the owner lets go, when the window
loses the focus, when the Manual tab is left, and when the machine stops answering. While it is held the
screen sends heartbeats: task ends the jog of a screen that does not get on (docs/nml.md).
"""

import math

import linuxcnc
from kerf import clock

from .settings import LETTERS, parse_increment


SLIDER_LEAST, SLIDER_STEP = 0.06, 0.02         # of a speed slider, 0..1


def speed(position, top):
    """Units a minute of a slider position 0..1; top: units a second at 1."""
    return 0.0 if position <= 0 else 60 * top * math.exp(1 - 1 / position)


def position(value, top):
    """Slider position of a speed in units a minute, rounded to 1/200."""
    if value <= 0 or top <= 0:
        return 0.0
    if value >= 60 * top:
        return 1.0
    return round(-200 / (math.log(value / (60 * top)) - 1)) / 200


BEAT_S = 0.05            # between two heartbeats of a jog; task waits five times as long, then it stops the jog


class Jogger:
    """Jogs of one screen. `app` gives status, command, settings, variables, manual_ok() and mode changes."""

    def __init__(self, app):
        self.app = app
        self.running = {}        # owner -> (joint mode, number) of a continuous jog
        self.left_to_user = {}   # owner -> number of a jog that a user's own jog_on() makes
        self.next_beat = 0.0

    # -- what is jogged --------------------------------------------------------------------

    def joint_mode(self):
        """True for a joint jog: not yet homed, or joints chosen on a machine that has its own kinematics."""
        stat = self.app.stat
        if stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY:
            return not self.app.all_homed()
        return stat.motion_mode == linuxcnc.TRAJ_MODE_FREE

    def number(self, selected, joint_mode):
        """Joint or axis number of a letter or a joint number (text)."""
        if not joint_mode:
            return LETTERS.index(selected.upper())
        if selected.isdigit():
            return int(selected)
        return self.app.settings.joint_of(selected.upper())

    def is_angular(self, number, joint_mode):
        s = self.app.settings
        return (s.joint_type(number) if joint_mode else s.axis_type(LETTERS[number])) == "ANGULAR"

    def speed_of(self, number, joint_mode, fast=False):
        """Machine units a second from the slider; fast: the greatest."""
        s, v = self.app.settings, self.app.vars
        if self.is_angular(number, joint_mode):
            return s.max_angular if fast else v.jog_aspeed.get() / 60
        return s.max_linear if fast else self.app.to_machine(v.jog_speed.get()) / 60

    def distance(self):
        """Machine units of the chosen increment, 0 for continuous."""
        text = self.app.vars.jogincrement.get()
        if text == self.app.translate("Continuous"):
            return 0.0
        try:
            return parse_increment(text, self.app.settings.units_per_mm)
        except ValueError as e:
            self.app.notifications.add("error", str(e))
            return 0.0

    # -- starting and stopping -------------------------------------------------------------

    def start(self, owner, selected, direction, fast=False, speed=None):
        """Begins a jog of a letter or joint; returns True when it was sent. speed: units a
        second, None: that of the slider."""
        app = self.app
        if owner in self.running or owner in self.left_to_user or app.is_late() or not app.jog_allowed():
            return False
        joint_mode = self.joint_mode()
        number = self.number(selected, joint_mode)
        if any(what == (joint_mode, number) for what in self.running.values()):
            return False
        app.set_motion_teleop(0 if joint_mode else 1)
        if speed is None:        # a key or button
            speed = self.speed_of(number, joint_mode, True) if fast else app.get_jog_speed(number)
            own = app.replaced("jog_on")
            if own:
                if not self.distance():          # nothing ends an increment
                    self.left_to_user[owner] = number
                own(number, direction * speed)
                return True
        speed *= direction
        distance = self.distance()
        if distance:
            if app.stat.state != linuxcnc.RCS_DONE:
                return False
            app.command.jog(linuxcnc.JOG_INCREMENT, joint_mode, number, speed, distance)
            return True
        self.running[owner] = (joint_mode, number)
        app.command.jog(linuxcnc.JOG_CONTINUOUS, joint_mode, number, speed)
        self.next_beat = 0.0
        self.beat_on()
        return True

    def beat(self):
        """The screen gets on and the keys are held. Called in each update cycle, too, which may be long."""
        if self.running and clock.now() >= self.next_beat:
            self.next_beat = clock.now() + BEAT_S
            for what in self.running.values():
                self.app.command.jog_held(*what)

    def beat_on(self):
        if self.running:
            self.beat()
            self.app.root.after(int(1000 * BEAT_S), self.beat_on)

    def stop(self, owner):
        what, number = self.running.pop(owner, None), self.left_to_user.pop(owner, None)
        if what is not None:
            self.app.command.jog(linuxcnc.JOG_STOP, *what)
        if number is not None:
            try:
                self.app.user["jog_off"](number)
            finally:                     # whatever the user's function does, a jog does not outlive its key
                self.app.jog_off(number)

    def stop_all(self):
        for owner in [*self.running, *self.left_to_user]:
            self.stop(owner)
