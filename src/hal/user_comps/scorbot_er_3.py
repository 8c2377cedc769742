#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Control box of the robot Scorbot ER-3 on a serial line: HAL component scorbot-er-3.

scorbot-er-3 [DEVICE]

DEVICE: the line (/dev/ttyS0). Source: sheet of USB drivers, section 15.
"""

import math
import signal
import sys
import time
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock
from kerf.serial_line import SerialLine

NAME = "scorbot-er-3"
JOINTS = 8
RATE, STOP_BITS = 9600, 2
ANSWER_S, REOPEN_S, NAP_S = 1.0, 1.0, 0.01
START = b"X"
LOOK = b"".join(b"%dl" % (n + 1) for n in range(JOINTS))    # at the limit switch of each joint


class Joint:
    """One motor: what the box was told last, and its pins."""

    def __init__(self, component, number):
        self.component, self.number, self.prefix = component, number, f"joint{number}."
        for name, kind, direction, value in (("limit-sw", hal.HAL_BIT, hal.HAL_OUT, False),
                                             ("motor-pos-cmd", hal.HAL_FLOAT, hal.HAL_IN, 0.0),
                                             ("scale", hal.HAL_FLOAT, hal.HAL_IN, 1.0),
                                             ("motor-max-vel", hal.HAL_S32, hal.HAL_IN, 9)):
            component.newpin(self.prefix + name, kind, direction)
            component[self.prefix + name] = value
        self.forget()

    def forget(self):
        """The box knows nothing: it starts where the motor is."""
        self.counts = self.velocity = None

    def changes(self):
        """What the box is to be told."""
        told = b""
        position = self.component[self.prefix + "motor-pos-cmd"] * self.component[self.prefix + "scale"]
        if math.isfinite(position):
            counts = int(position)
            if self.counts is not None and counts != self.counts:
                told += b"%dm%d\n\r" % (self.number + 1, counts - self.counts)
            self.counts = counts
        velocity = self.component[self.prefix + "motor-max-vel"]
        if velocity != self.velocity:
            told += b"%dv%d\n" % (self.number + 1, velocity)
            self.velocity = velocity
        return told


class Box:
    """The line with the box. A problem is told once."""

    def __init__(self, device, joints):
        self.device, self.joints, self.line, self.told, self.due = device, joints, None, None, 0.0

    def tell(self, text=None):
        if text and text != self.told:
            print(f"{NAME}: {self.device}: {text}", file=sys.stderr, flush=True)
        self.told = text

    def open(self):
        if self.line is None and time.monotonic() >= self.due:
            try:
                self.line = SerialLine(self.device, RATE, stop_bits=STOP_BITS)
                self.line.send(START)
                for joint in self.joints:
                    joint.forget()
            except OSError as e:
                self.drop(e)
        return self.line is not None

    def drop(self, error):
        self.tell(error.strerror)
        if self.line:
            self.line.close()
        self.line, self.due = None, time.monotonic() + REOPEN_S

    def serve(self):
        """Moves, then the limit switches."""
        if not self.open():
            return
        try:
            if changes := b"".join(joint.changes() for joint in self.joints):
                self.line.send(changes)
            self.take(self.line.ask(LOOK, lambda answer: len(answer) >= JOINTS, ANSWER_S))
        except OSError as e:
            self.drop(e)

    def take(self, answer):
        if not answer:
            self.tell("the control box does not answer")
        elif answer[:JOINTS].strip(b"01"):
            self.tell(f"the control box answers {answer!r}: must be {JOINTS} characters 0 or 1")
        else:
            self.tell()
            for joint, state in zip(self.joints, answer):
                joint.component[joint.prefix + "limit-sw"] = state == ord("1")


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        asked = len(sys.argv) == 2
        print(__doc__.strip().splitlines()[2], file=sys.stdout if asked else sys.stderr)
        return 0 if asked else 1
    component = hal.component(NAME)
    box = Box((sys.argv[1:] or ["/dev/ttyS0"])[0], [Joint(component, n) for n in range(JOINTS)])
    clock.join(NAME, 500)
    clock.leave()                               # the robot lives in real time
    ends = []
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ends.append(True))
    component.ready()
    while not ends:
        box.serve()
        time.sleep(NAP_S)
    return 0


if __name__ == "__main__":
    sys.exit(main())
