#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Powermax plasma cutters on a serial line (Modbus ASCII): HAL component pmx485.

pmx485 PORT

While `enable` is TRUE the cutter is in remote mode: mode, current and pressure are set, and read back with fault and
arc time. Ends with the component motmod.
"""

import signal
import sys
import time
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock
from kerf.powermax import ARC_HIGH, ARC_LOW, FAULT, LIMITS, SCALE, SET, Line, raw

NAME = "pmx485"
POLL_S = 0.02
BAD_ROUNDS = 3          # more in a row: the line is opened anew
RETRY_S = 1.0


class Cutter:
    def __init__(self, component, port):
        self.pins, self.port = component, port
        self.line, self.known, self.bad, self.due = None, {}, 0, 0.0

    def wanted(self, register):
        return raw(register, self.pins[SET[register] + "_set"])

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
