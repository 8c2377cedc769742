#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Powermax plasma cutters on a serial line (Modbus ASCII): HAL component pmx485.

pmx485 PORT

While `enable` is TRUE the cutter is in remote mode: mode, current and pressure are set, and read back with fault and
arc time. Ends with the component motmod.
"""

import errno
import os
import select
import signal
import sys
import termios
import time
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock

NAME = "pmx485"
TIMEOUT_S = 0.1
POLL_S = 0.02
BAD_ROUNDS = 3          # more in a row: the line is opened anew
RETRY_S = 1.0
MODE, CURRENT, PRESSURE, FAULT = 0x2093, 0x2094, 0x2096, 0x2098
CURRENT_MIN, CURRENT_MAX, PRESSURE_MIN, PRESSURE_MAX = 0x2099, 0x209A, 0x209C, 0x209D
ARC_LOW, ARC_HIGH = 0x209E, 0x209F
SCALE = {MODE: 1, CURRENT: 64, PRESSURE: 128, FAULT: 1, CURRENT_MIN: 64, CURRENT_MAX: 64, PRESSURE_MIN: 128,
         PRESSURE_MAX: 128}
SET = {MODE: "mode", CURRENT: "current", PRESSURE: "pressure"}
LIMITS = {CURRENT_MIN: "current_min", CURRENT_MAX: "current_max", PRESSURE_MIN: "pressure_min",
          PRESSURE_MAX: "pressure_max"}


def lrc(text):
    """Two digits that make the sum of all bytes 0."""
    return b"%02X" % (-sum(bytes.fromhex(text.decode())) & 0xFF)


class Line:
    """The serial line, 19200 8E1. Raises OSError when it can not be opened or is gone."""

    def __init__(self, port):
        self.fd = os.open(port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            control = termios.CS8 | termios.PARENB | termios.CREAD | termios.CLOCAL
            characters = [b"\0"] * 32
            termios.tcsetattr(self.fd, termios.TCSANOW, [0, 0, control, 0, termios.B19200, termios.B19200, characters])
        except termios.error as e:
            if e.args[0] != errno.EINVAL:       # a pseudo terminal knows no parity
                os.close(self.fd)
                raise OSError(*e.args) from None

    def close(self):
        os.close(self.fd)

    def ask(self, body):
        """The answer to a frame, whole lines only; b"" after the time-out."""
        termios.tcflush(self.fd, termios.TCIFLUSH)
        os.write(self.fd, b":" + body + lrc(body) + b"\r\n")
        answer, end = b"", time.monotonic() + TIMEOUT_S
        while not answer.endswith(b"\r\n"):
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.fd], [], [], left)[0]:
                return b""
            more = os.read(self.fd, 64)
            if not more:
                return b""
            answer += more
        return answer

    def write(self, register, value):
        body = b"0106%04X%04X" % (register, value)
        return self.ask(body) == b":" + body + lrc(body) + b"\r\n"

    def read(self, register):
        """Its value, or None."""
        answer = self.ask(b"0104%04X0001" % register)
        try:
            good = len(answer) == 15 and answer[:7] == b":010402" and lrc(answer[1:11]) == answer[11:13]
            return int(answer[7:11], 16) if good else None
        except ValueError:
            return None


class Cutter:
    def __init__(self, component, port):
        self.pins, self.port = component, port
        self.line, self.known, self.bad, self.due = None, {}, 0, 0.0

    def wanted(self, register):
        return min(max(int(self.pins[SET[register] + "_set"] * SCALE[register]), 0), 0xFFFF)

    def show(self, name, register, value):
        if value is not None:
            self.pins[name] = value / SCALE[register]

    def set(self, register):
        """Writes what is wanted, or reads what is in force. False: no good answer."""
        value = self.wanted(register)
        if self.known.get(register) != value:
            if not self.line.write(register, value):
                return False
            self.known[register] = value
        else:
            self.known[register] = self.line.read(register)
        self.show(SET[register], register, self.known[register])
        return self.known[register] is not None

    def round(self):
        """One pass over all registers. False: some had no good answer."""
        good = all([self.set(register) for register in SET])
        fault, low, high = self.line.read(FAULT), self.line.read(ARC_LOW), self.line.read(ARC_HIGH)
        self.show("fault", FAULT, fault)
        if None not in (low, high):
            self.pins["arcTime"] = high << 16 | low
        return good and None not in (fault, low, high)

    def begin(self):
        self.line, self.known, self.bad = Line(self.port), {}, 0
        for register in SET:
            self.set(register)
        for register, name in LIMITS.items():
            self.show(name, register, self.line.read(register))

    def end(self):
        """Back to the cutter's own panel."""
        self.pins["status"] = False
        if self.line is None:
            return
        try:
            for register in SET:
                self.line.write(register, 0)
        except OSError:
            pass
        self.line.close()
        self.line = None

    def step(self):
        if not self.pins["enable"]:
            return self.end()
        try:
            if self.line is None:
                if time.monotonic() < self.due:
                    return None
                self.begin()
            if self.round():
                self.bad, self.pins["status"] = 0, True
                return None
            self.bad += 1
        except OSError as e:
            print(f"{NAME}: {self.port}: {e.strerror}", file=sys.stderr)
            self.bad = BAD_ROUNDS + 1
        if self.bad > BAD_ROUNDS:
            self.end()
            self.due = time.monotonic() + RETRY_S
        return None


def main():
    if len(sys.argv) != 2:
        sys.exit(f"usage: {NAME} PORT, /dev/ttyUSB0 for example")
    port = sys.argv[1]
    try:
        Line(port).close()
    except OSError as e:
        sys.exit(f"ERROR: Could not open {port} for Powermax communications: {e.strerror}")
    component = hal.component(NAME)
    for name in SET.values():
        component.newpin(name + "_set", hal.HAL_FLOAT, hal.HAL_IN)
        component.newpin(name, hal.HAL_FLOAT, hal.HAL_OUT)
    component.newpin("enable", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("status", hal.HAL_BIT, hal.HAL_OUT)
    for name in ("fault", "arcTime", *LIMITS.values()):
        component.newpin(name, hal.HAL_FLOAT, hal.HAL_OUT)
    component.ready()
    clock.join(NAME, 500)
    cutter = Cutter(component, port)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        while hal.component_exists("motmod"):
            cutter.step()
            clock.sleep(POLL_S)
    finally:
        cutter.end()


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
