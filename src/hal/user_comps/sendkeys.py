#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Types keys for key codes and pins: HAL component sendkeys.

sendkeys config=[sN][tN],...

One instance for each part: sN scan codes, tN trigger pins (a number alone: scan codes). Once `init` is TRUE a
keyboard of the kernel is made that has the keys of the parameters (needs access to /dev/uinput).
"""

import fcntl
import os
import re
import struct
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf.haltools.input_events import EV_KEY, EV_SYN, event, run

NAME = "sendkeys"
POLL_S = 0.001
DOWN, UP, FLAGS, CODE = 0xC0, 0x80, 0xC0, 0x3F      # of keycode
UI_SET_EVBIT, UI_SET_KEYBIT, UI_DEV_CREATE = 0x40045564, 0x40045565, 0x5501
MAX_SCAN = CODE + 1


class Keyboard:
    """A keyboard made in the kernel. Raises OSError."""

    def __init__(self, keys):
        self.fd = os.open("/dev/uinput", os.O_WRONLY | os.O_NONBLOCK)
        fcntl.ioctl(self.fd, UI_SET_EVBIT, EV_KEY)
        for key in sorted(keys):
            fcntl.ioctl(self.fd, UI_SET_KEYBIT, key)
        # struct uinput_user_dev: name, bus (USB), vendor, product, version, effects, limits of 64 axes
        os.write(self.fd, struct.pack("80s4HI", b"linuxcnc-hal", 3, 1, 1, 1, 0) + bytes(4 * 4 * 64))
        fcntl.ioctl(self.fd, UI_DEV_CREATE)

    def send(self, key, pressed):
        os.write(self.fd, event(EV_KEY, key, pressed) + event(EV_SYN, 0, 0))


class Keys:
    """The pins of one instance."""

    def __init__(self, component, number, scans, triggers, make_keyboard=Keyboard):
        self.pins, self.prefix, self.make_keyboard = component, f"{number}.", make_keyboard
        self.scans, self.triggers = scans, triggers
        self.keyboard = None
        self.last = 0
        self.held = [False] * triggers
        component.newpin(self.prefix + "keycode", hal.HAL_U32, hal.HAL_IN)
        component.newpin(self.prefix + "current-event", hal.HAL_S32, hal.HAL_OUT)
        component.newpin(self.prefix + "init", hal.HAL_BIT, hal.HAL_IN)
        for n in range(triggers):
            component.newpin(f"{self.prefix}trigger-{n:02d}", hal.HAL_BIT, hal.HAL_IN)
            component.newparam(f"{self.prefix}pin-event-{n:02d}", hal.HAL_U32, hal.HAL_RW)
        for n in range(scans):
            component.newparam(f"{self.prefix}scan-event-{n:02d}", hal.HAL_U32, hal.HAL_RW)

    def get(self, name):
        return self.pins[self.prefix + name]

    def scan_key(self, code):
        return self.get(f"scan-event-{code:02d}") if code < self.scans else 0

    def keys(self):
        found = {self.scan_key(n) for n in range(self.scans)}
        return (found | {self.get(f"pin-event-{n:02d}") for n in range(self.triggers)}) - {0}

    def send(self, key, pressed):
        if key:
            self.keyboard.send(key, pressed)

    def step(self):
        code = self.get("keycode")
        self.pins[self.prefix + "current-event"] = code & CODE if code & FLAGS == UP else -1
        if not self.get("init"):
            return
        if self.keyboard is None:
            self.keyboard = self.make_keyboard(self.keys())
        if code != self.last:
            self.last = code
            if code & FLAGS in (DOWN, UP):
                self.send(self.scan_key(code & CODE), code & FLAGS == DOWN)
        for n in range(self.triggers):
            now = self.get(f"trigger-{n:02d}")
            if now != self.held[n]:
                self.held[n] = now
                self.send(self.get(f"pin-event-{n:02d}"), now)


def arguments(words):
    """[(scan codes, triggers)] of config=..."""
    if len(words) != 1 or not words[0].startswith("config="):
        sys.exit(__doc__)
    parts = []
    for part in words[0][len("config="):].split(","):
        if not re.fullmatch(r"([st]?\d+)([st]\d+)*", part, re.I):
            sys.exit(f"{NAME}: {part!r} in {words[0]}: sN (scan codes) and tN (triggers) are expected")
        number = {"s": 0, "t": 0}
        for letter, digits in re.findall(r"([st]?)(\d+)", part.lower()):
            number[letter or "s"] = int(digits)
        if number["s"] > MAX_SCAN:
            sys.exit(f"{NAME}: {part!r} in {words[0]}: at most {MAX_SCAN} scan codes")
        parts.append((number["s"], number["t"]))
    return parts


def main():
    parts = arguments(sys.argv[1:])
    component = hal.component(NAME)
    instances = [Keys(component, n, *part) for n, part in enumerate(parts)]
    component.ready()
    run(NAME, instances, POLL_S,
        lambda _, error: f"/dev/uinput: {error.strerror} (its group, or a udev rule, gives access)")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
