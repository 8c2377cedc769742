# SPDX-License-Identifier: GPL-2.0-or-later
"""Events of the kernel's input devices, and the loop of the programs that turn them into pins: hal_input, sendkeys."""

import struct
import sys

from kerf import clock

EVENT = struct.Struct("llHHi")      # struct input_event: seconds, microseconds, type, code, value
EV_SYN, EV_KEY, EV_REL, EV_ABS, EV_LED = 0, 1, 2, 3, 0x11


def event(kind, code, value):
    """What is written to a device."""
    return EVENT.pack(0, 0, kind, code, value)


def run(name, instances, poll_s, explain):
    """Joins the clock and calls step() of all instances for ever. explain(instance, error): text for an OSError."""
    clock.join(name, 500)
    while True:
        for one in instances:
            try:
                one.step()
            except OSError as error:
                sys.exit(f"{name}: {explain(one, error)}")
        clock.sleep(poll_s)
