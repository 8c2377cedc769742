#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys, axes, wheels and LEDs of input devices as HAL pins: component hal_input.

hal_input [-KRAL] SPEC ...

SPEC: N is /dev/input/eventN; anything else is part of, or a pattern for, the name, place (phys), numbers
(`Bus=0003 Vendor=046d ...` or 046d:c626) of a device. `:N` after it takes the Nth match (from 0), a `+` before
it keeps the device from all other programs. -KRAL before a SPEC takes only its keys, relative and absolute axes
or LEDs. A device that is lost is at rest, and looked for until it is there again.
"""

import fcntl
import fnmatch
import glob
import os
import re
import struct
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock, event_codes
from kerf.haltools.input_events import EV_ABS, EV_KEY, EV_LED, EV_REL, EV_SYN, EVENT, event, run

NAME = "hal_input"
POLL_S = 0.01
SEARCH_S = 1.0              # for a lost device
SYN_DROPPED = 3             # the kernel has lost events
KINDS = "KRAL"
EV_OF = {"K": EV_KEY, "R": EV_REL, "A": EV_ABS, "L": EV_LED}
TABLES = {"K": ("KEY", event_codes.KEY), "R": ("REL", event_codes.REL), "A": ("ABS", event_codes.ABS),
          "L": ("LED", event_codes.LED)}
# Buttons of a gamepad have two names.
ALIASES = {0x130: "BTN_A", 0x131: "BTN_B", 0x133: "BTN_X", 0x134: "BTN_Y"}
MOVED = 0.01                # of full scale: is-pos, is-neg


def names_of(kind, code):
    """HAL names of an event."""
    prefix, table = TABLES[kind]
    names = [table.get(code, f"{prefix}_{code}")]
    if kind == "K" and code in ALIASES:
        names.append(ALIASES[code])
    return [name.lower().replace("_", "-") for name in names]


class EventDevice:
    """A device of the kernel. Raises OSError."""

    def __init__(self, path):
        self.path = path
        self.writable = True
        try:
            self.fd = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        except OSError:
            self.fd = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
            self.writable = False
        self.name, self.phys = self._text(0x06), self._text(0x07)
        self.id = "Bus=%04x Vendor=%04x Product=%04x Version=%04x" % struct.unpack("4H", self._get(0x02, 8))
        self.numbers = "{1}:{2}".format(*re.findall(r"=(\w+)", self.id))

    def _get(self, number, size):
        return fcntl.ioctl(self.fd, 2 << 30 | size << 16 | 0x45 << 8 | number, bytes(size))

    def _text(self, number):
        try:
            return self._get(number, 256).split(b"\0")[0].decode(errors="replace")
        except OSError:
            return ""

    def codes(self, kind):
        bits = int.from_bytes(self._get(0x20 + EV_OF[kind], 96), "little")
        return [code for code in range(96 * 8) if bits >> code & 1]

    def pressed(self):
        """Codes of the keys that are down now."""
        bits = int.from_bytes(self._get(0x18, 96), "little")
        return {code for code in range(96 * 8) if bits >> code & 1}

    def axis(self, code):
        """value, least, greatest, fuzz, flat."""
        return struct.unpack("6i", self._get(0x40 + code, 24))[:5]

    def grab(self):
        fcntl.ioctl(self.fd, 1 << 30 | 4 << 16 | 0x45 << 8 | 0x90, 1)

    def events(self):
        """(type, code, value) of what happened since the last call."""
        found = []
        while True:
            try:
                data = os.read(self.fd, 64 * EVENT.size)
            except BlockingIOError:
                return found
            found += [one[2:] for one in EVENT.iter_unpack(data)]
            if len(data) < 64 * EVENT.size:
                return found

    def set_led(self, code, on):
        if self.writable:
            os.write(self.fd, event(EV_LED, code, on))

    def close(self):
        os.close(self.fd)


def matches(device, pattern):
    """pattern: part of, or shell pattern for, one of the device's names."""
    return any(pattern in text or fnmatch.fnmatchcase(text, pattern)
               for text in (device.name, device.phys, device.id, device.numbers))


def find(spec, open_device=EventDevice, paths=None):
    """The device of a SPEC. Exits with a message."""
    exclusive, spec = spec.startswith("+"), spec.removeprefix("+")
    if spec.isdigit():
        try:
            device = open_device(f"/dev/input/event{spec}")
        except OSError as error:
            sys.exit(f"{NAME}: /dev/input/event{spec}: {error.strerror}")
    else:
        device = search(spec, open_device, sorted(glob.glob("/dev/input/event*")) if paths is None else paths)
    if exclusive:
        device.grab()
    return device


def search(spec, open_device, paths):
    wanted = re.fullmatch(r"(.*):(\d+)", spec)
    opened = count = 0
    for path in paths:
        try:
            device = open_device(path)
        except OSError:
            continue
        opened += 1
        if matches(device, spec):
            return device
        if wanted and matches(device, wanted.group(1)):
            if count == int(wanted.group(2)):
                return device
            count += 1
        device.close()
    if paths and not opened:
        sys.exit(f"{NAME}: none of {len(paths)} input devices can be opened: may this user read /dev/input/event*?")
    sys.exit(f"{NAME}: No input device matching '{spec}' was found ({len(paths)} devices checked)")


def find_again(lost, taken, open_device=EventDevice, paths=None):
    """The device that was lost, also at another place, but none of the paths taken. None while it is not there."""
    part = lambda device: device.phys.rpartition("/")[2]
    others = []
    for path in sorted(glob.glob("/dev/input/event*")) if paths is None else paths:
        if path in taken:
            continue
        try:
            device = open_device(path)
        except OSError:
            continue
        alike = (device.name, device.id, part(device)) == (lost.name, lost.id, part(lost))
        if alike and device.phys == lost.phys:
            for other in others:
                other.close()
            return device
        if alike and not others:
            others.append(device)
        else:
            device.close()
    return others[0] if others else None


class Input:
    """The pins of one device. taken: paths of the devices that are there, of all Inputs."""

    def __init__(self, component, number, device, kinds, *, exclusive=False, taken=None, again=find_again):
        self.pins, self.device, self.prefix, self.kinds = component, device, f"{number}.", kinds
        self.exclusive, self.taken, self.again = exclusive, set() if taken is None else taken, again
        self.taken.add(device.path)
        self.lost, self.look_at, self.unexpected = None, 0.0, set()
        self.pin("connected", hal.HAL_BIT, hal.HAL_OUT, True)
        self.codes = {kind: device.codes(kind) if kind in kinds else [] for kind in KINDS}
        self.leds = {}
        for kind, make in zip(KINDS, (self.make_key, self.make_wheel, self.make_axis, self.make_led)):
            for code in self.codes[kind]:
                make(code, names_of(kind, code))

    def pin(self, name, kind, direction, value):
        self.pins.newpin(self.prefix + name, kind, direction)
        self.pins[self.prefix + name] = value

    def make_key(self, code, names):
        for name in names:
            self.pin(name, hal.HAL_BIT, hal.HAL_OUT, False)
            self.pin(name + "-not", hal.HAL_BIT, hal.HAL_OUT, True)

    def make_wheel(self, code, names):
        name = names[0]
        self.pin(name + "-position", hal.HAL_FLOAT, hal.HAL_OUT, 0.0)
        self.pin(name + "-counts", hal.HAL_S32, hal.HAL_OUT, 0)
        self.pin(name + "-reset", hal.HAL_BIT, hal.HAL_IN, False)
        self.pin(name + "-scale", hal.HAL_FLOAT, hal.HAL_IN, 1.0)

    def make_axis(self, code, names):
        name = names[0]
        value, least, greatest, fuzz, flat = self.device.axis(code)
        self.pin(name + "-position", hal.HAL_FLOAT, hal.HAL_OUT, 0.0)
        self.pin(name + "-counts", hal.HAL_S32, hal.HAL_OUT, value)
        self.pin(name + "-is-pos", hal.HAL_BIT, hal.HAL_OUT, False)
        self.pin(name + "-is-neg", hal.HAL_BIT, hal.HAL_OUT, False)
        self.pin(name + "-scale", hal.HAL_FLOAT, hal.HAL_IN, (greatest - least) / 2 or 1.0)
        self.pin(name + "-offset", hal.HAL_FLOAT, hal.HAL_IN, (greatest + least) / 2)
        self.pin(name + "-fuzz", hal.HAL_S32, hal.HAL_IN, fuzz)
        self.pin(name + "-flat", hal.HAL_S32, hal.HAL_IN, flat)
        for end, limit in (("-min", least), ("-max", greatest)):
            self.pins.newparam(self.prefix + name + end, hal.HAL_S32, hal.HAL_RO)
            self.pins[self.prefix + name + end] = limit

    def make_led(self, code, names):
        self.pin(names[0], hal.HAL_BIT, hal.HAL_IN, False)
        self.pin(names[0] + "-invert", hal.HAL_BIT, hal.HAL_IN, False)

    def take(self, kind, code, value):
        """One event."""
        if kind == EV_KEY and code in self.codes["K"]:
            self.set_key(code, value)
        elif kind == EV_REL and code in self.codes["R"]:
            name = self.prefix + names_of("R", code)[0]
            counts = self.pins[name + "-counts"] + value
            self.pins[name + "-counts"] = (counts + 2**31) % 2**32 - 2**31
        elif kind == EV_ABS and code in self.codes["A"]:
            name = self.prefix + names_of("A", code)[0]
            middle = int(self.pins[name + "-offset"])
            if abs(value - middle) <= self.pins[name + "-flat"]:
                value = middle
            if abs(value - self.pins[name + "-counts"]) > self.pins[name + "-fuzz"]:
                self.pins[name + "-counts"] = value
        elif kind == EV_SYN and code == SYN_DROPPED:
            self.refresh()
        elif any(kind == EV_OF[k] for k in self.kinds if k != "L") and (kind, code) not in self.unexpected:
            self.unexpected.add((kind, code))
            print(f"{NAME}: {self.device.name}: Unexpected event {kind} {code}", file=sys.stderr)

    def set_key(self, code, down):
        for name in names_of("K", code):
            self.pins[self.prefix + name] = bool(down)
            self.pins[self.prefix + name + "-not"] = not down

    def refresh(self):
        """Keys and axes as they are now: a release may be among the events that the kernel lost."""
        down = self.device.pressed() if self.codes["K"] else ()
        for code in self.codes["K"]:
            self.set_key(code, code in down)
        for code in self.codes["A"]:
            self.take(EV_ABS, code, self.device.axis(code)[0])

    def rest(self):
        """No key is down, all axes are in the middle; what wheels have counted stays."""
        for code in self.codes["K"]:
            self.set_key(code, False)
        for code in self.codes["A"]:
            name = self.prefix + names_of("A", code)[0]
            self.pins[name + "-counts"] = int(self.pins[name + "-offset"])

    def lose(self, error):
        print(f"{NAME}: {self.device.name} ({self.device.path}) is lost: {error.strerror}", file=sys.stderr)
        self.device.close()
        self.taken.discard(self.device.path)
        self.lost, self.device, self.leds = self.device, None, {}
        self.pins[self.prefix + "connected"] = False
        self.rest()

    def find_again(self):
        """Once in SEARCH_S. An axis that is held stays in the middle until it moves."""
        if clock.now() < self.look_at:
            return
        self.look_at = clock.now() + SEARCH_S
        device = self.again(self.lost, self.taken)
        if device is None:
            return
        if self.exclusive:
            try:
                device.grab()
            except OSError:
                return device.close()
        print(f"{NAME}: {device.name} ({device.path}) is back", file=sys.stderr)
        self.device, self.lost = device, None
        self.taken.add(device.path)
        self.pins[self.prefix + "connected"] = True

    def step(self):
        """Takes all events and brings the pins up to date."""
        if self.device is None:
            self.find_again()
        if self.device is not None:
            try:
                for change in self.device.events():
                    self.take(*change)
                self.show_leds()
            except OSError as error:
                self.lose(error)
        self.update()

    def show_leds(self):
        for code in self.codes["L"]:
            name = self.prefix + names_of("L", code)[0]
            on = self.pins[name] != self.pins[name + "-invert"]
            if self.leds.get(code) != on:
                self.leds[code] = on
                self.device.set_led(code, on)

    def update(self):
        for code in self.codes["R"]:
            name = self.prefix + names_of("R", code)[0]
            if self.pins[name + "-reset"]:
                self.pins[name + "-counts"] = 0
            self.pins[name + "-position"] = self.pins[name + "-counts"] / (self.pins[name + "-scale"] or 1.0)
        for code in self.codes["A"]:
            name = self.prefix + names_of("A", code)[0]
            away = self.pins[name + "-counts"] - self.pins[name + "-offset"] if self.device else 0.0
            position = away / (self.pins[name + "-scale"] or 1.0)
            self.pins[name + "-position"] = position
            self.pins[name + "-is-pos"] = position > MOVED
            self.pins[name + "-is-neg"] = position < -MOVED


def arguments(words):
    """[(SPEC, kinds)]"""
    specs, kinds = [], KINDS
    for word in words:
        if word.startswith("-"):
            kinds = word[1:]
            if not kinds or set(kinds) - set(KINDS):
                sys.exit(f"{NAME}: {word}: letters out of {KINDS} are expected\n\n{__doc__}")
        else:
            specs.append((word, kinds))
            kinds = KINDS
    if not specs:
        sys.exit(__doc__)
    return specs


def main():
    devices = [(find(spec), kinds, spec.startswith("+")) for spec, kinds in arguments(sys.argv[1:])]
    component, taken = hal.component(NAME, "input"), set()
    inputs = [Input(component, number, device, kinds, exclusive=exclusive, taken=taken)
              for number, (device, kinds, exclusive) in enumerate(devices)]
    component.ready()
    run(NAME, inputs, POLL_S, lambda one, error: f"{one.device.path}: {error.strerror}")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
