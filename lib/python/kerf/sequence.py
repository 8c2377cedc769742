# SPDX-License-Identifier: GPL-2.0-or-later
"""Several commands that belong together: none is given once one before it has not been done.

    with Sequence("measure the plate") as run:
        run.mdi("G38.2 Z-10 F50", timeout=120)
        depth = run.stat.probed_position[2]

A sequence has control of the machine until its end: what other programs and panels command is
refused, except what stops or slows (docs/nml.md). Each command brings the mode it needs. A command ends in exactly one
way: done, failed (Failed, with what the operator was told), aborted (Aborted: somebody stopped the machine, or another
command of this program came between) or late (TimedOut: it goes on, or never came through). Only after `done` does the
sequence go on; every other end raises, and the sequence takes no more commands. Times are those of the controller's
clock.
"""
import os

import linuxcnc

from kerf import clock

POLL_S = 0.01
MODES = {"mdi": linuxcnc.MODE_MDI, "auto": linuxcnc.MODE_AUTO, "program_open": linuxcnc.MODE_AUTO,
         "home": linuxcnc.MODE_MANUAL, "unhome": linuxcnc.MODE_MANUAL, "jog": linuxcnc.MODE_MANUAL,
         "teleop_enable": linuxcnc.MODE_MANUAL, "override_limits": linuxcnc.MODE_MANUAL}  # that commands need


class Broken(Exception):
    """The sequence has ended before its end. Attributes: command, messages."""

    def __init__(self, command, messages):
        self.command, self.messages = command, messages
        super().__init__(f"{command}: {'; '.join(messages) or self.__doc__}")


class Failed(Broken):
    """the command was refused or ended in an error"""


class Aborted(Broken):
    """the machine was stopped, or another command came between"""


class Busy(Broken):
    """another program has control of the machine"""


class TimedOut(Broken):
    """the command was not done in time"""


class Ended(Broken):
    """a command before has not been done: this sequence takes no more"""


class Sequence:
    """Gives commands one after the other. Every method of linuxcnc.command is there, with `timeout` (s).

    name: who has control, for the others. Busy: another program has."""

    def __init__(self, name="a script", timeout=60.0):
        self.stat, self.command, self.timeout = linuxcnc.stat(), linuxcnc.command(), timeout
        self.log = linuxcnc.message_log()
        self.broken = False
        self.stat.poll()
        self._catch_up()
        self.command.take_control(name)
        self.stat.poll()
        if self.stat.control_pid != os.getpid():
            self._end(Busy, "take_control")
        self._last = self.command.serial

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        """A sequence that ends by an error of the client leaves nothing running."""
        if kind is not None and not issubclass(kind, Broken):
            self.broken = True
            self.command.abort()
        self.command.release_control()

    def _undisturbed(self):
        return self.stat.control_pid == os.getpid() and self.stat.control_serial <= self._last

    def _catch_up(self):
        try:
            return [m["text"] for m in self.log.poll() if m["kind"] == linuxcnc.OPERATOR_ERROR]
        except linuxcnc.error:  # the .nml file has no message log
            return []

    def _end(self, how, name):
        self.broken = True
        raise how(name, self._catch_up())

    def __getattr__(self, name):
        method = getattr(self.command, name)

        def give(*args, timeout=None):
            return self._give(name, method, args, self.timeout if timeout is None else timeout)

        return give

    def _give(self, name, method, args, timeout):
        what = f"{name}({', '.join(map(repr, args))})"
        if self.broken:
            raise Ended(what, [])
        self.stat.poll()
        if name in MODES and self.stat.task_mode != MODES[name]:
            self._run(f"mode {MODES[name]} for {what}", self.command.mode, (MODES[name],), timeout)
        self._run(what, method, args, timeout)

    def _run(self, what, method, args, timeout):
        if not self._undisturbed():
            self._end(Aborted, what)
        self._catch_up()
        end = clock.now() + timeout
        method(*args)
        self._last = self.command.serial
        while True:
            self.stat.poll()
            if not self._undisturbed():
                self._end(Aborted, what)
            if self.stat.control_serial == self._last:
                if self.stat.control_state == linuxcnc.RCS_ERROR:
                    self._end(Failed, what)
                if self.stat.control_state == linuxcnc.RCS_DONE:
                    return
            if clock.now() >= end:
                self._end(TimedOut, what)
            clock.sleep(POLL_S)
