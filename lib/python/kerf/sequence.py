# SPDX-License-Identifier: GPL-2.0-or-later
"""Several commands that belong together: none is given once one before it has not been done.

    with Sequence() as run:
        run.mode(linuxcnc.MODE_MDI)
        run.mdi("G38.2 Z-10 F50", timeout=120)
        depth = run.stat.probed_position[2]

A command ends in exactly one way: done, failed (Failed, with what the operator was told), aborted
(Aborted: another client's command came between) or late (TimedOut: it goes on, or never
came through). Only after `done` does the sequence go on; every other end raises, and the
sequence takes no more commands. Times are those of the controller's clock.
"""
import linuxcnc

from kerf import clock

POLL_S = 0.01


class Broken(Exception):
    """The sequence has ended before its end. Attributes: command, messages."""

    def __init__(self, command, messages):
        self.command, self.messages = command, messages
        super().__init__(f"{command}: {'; '.join(messages) or self.__doc__}")


class Failed(Broken):
    """the command was refused or ended in an error"""


class Aborted(Broken):
    """another client's command came between"""


class TimedOut(Broken):
    """the command was not done in time"""


class Ended(Broken):
    """a command before has not been done: this sequence takes no more"""


class Sequence:
    """Gives commands one after the other. Every method of linuxcnc.command is there, with `timeout` (s)."""

    def __init__(self, timeout=60.0):
        self.stat, self.command, self.timeout = linuxcnc.stat(), linuxcnc.command(), timeout
        self.log = linuxcnc.message_log()
        self.broken = False
        self._last = None
        self.stat.poll()
        self._catch_up()

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        """A sequence that ends by an error of the client leaves nothing running."""
        if kind is not None and not issubclass(kind, Broken):
            self.broken = True
            self.command.abort()

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
        if self._last is not None and self.stat.echo_serial_number > self._last:
            self._end(Aborted, what)
        self._catch_up()
        end = clock.now() + timeout
        method(*args)
        serial = self._last = self.command.serial
        while True:
            self.stat.poll()
            ahead = self.stat.echo_serial_number - serial
            if ahead > 0:
                self._end(Aborted, what)
            if ahead == 0 and self.stat.state == linuxcnc.RCS_ERROR:
                self._end(Failed, what)
            if ahead == 0 and self.stat.state == linuxcnc.RCS_DONE:
                return
            if clock.now() >= end:
                self._end(TimedOut, what)
            clock.sleep(POLL_S)
