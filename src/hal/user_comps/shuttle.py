#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Contour ShuttleXpress, ShuttlePRO and ShuttlePROv2: HAL component shuttle.

shuttle [DEVICE ...]

Devices are /dev/hidrawN, all of them if none is named; others than these models are passed over. One that is unplugged
is at rest, and looked for until it is there again.
"""

import errno
import fcntl
import glob
import os
import select
import struct
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal

NAME = "shuttle"
HIDIOCGRAWINFO = 0x80084803     # struct hidraw_devinfo: bus, vendor, product
# buttons, mask of the first
MODELS = {(0x0b33, 0x0020): (5, 0x0010), (0x05f3, 0x0240): (13, 0x0001), (0x0b33, 0x0030): (15, 0x0001)}
REPORT_BYTES = 5
WHEEL_MOST = 7.0
SEARCH_MS = 1000                # for lost devices


def identity(fd):
    """(vendor, product) of a raw HID device, or None."""
    try:
        return struct.unpack("IHH", fcntl.ioctl(fd, HIDIOCGRAWINFO, bytes(8)))[1:]
    except OSError:
        return None


class Device:
    """One device and its pins."""

    def __init__(self, component, number, path, fd, model):
        self.component, self.path, self.fd, self.prefix = component, path, fd, f"{number}."
        self.model = self.buttons, self.first = model
        self.dial = None        # of the last report
        for b in range(self.buttons):
            component.newpin(f"{number}.button-{b}", hal.HAL_BIT, hal.HAL_OUT)
            component.newpin(f"{number}.button-{b}-not", hal.HAL_BIT, hal.HAL_OUT)
            component[f"{number}.button-{b}-not"] = True
        for name, kind in (("counts", hal.HAL_S32), ("spring-wheel-f", hal.HAL_FLOAT),
                           ("spring-wheel-s32", hal.HAL_S32)):
            component.newpin(f"{number}.{name}", kind, hal.HAL_OUT)

    def take(self, report):
        """Pins of one report: spring wheel, jog dial, unused, buttons."""
        put = lambda name, value: self.component.__setitem__(self.prefix + name, value)
        wheel, dial, _, pressed = struct.unpack("<bBBH", report)
        put("spring-wheel-s32", wheel)
        put("spring-wheel-f", wheel / WHEEL_MOST)
        if self.dial is not None:
            moved = (dial - self.dial + 128) % 256 - 128
            put("counts", self.component[self.prefix + "counts"] + moved)
        self.dial = dial
        for b in range(self.buttons):
            put(f"button-{b}", bool(pressed & self.first << b))
            put(f"button-{b}-not", not pressed & self.first << b)


    def lose(self, why):
        """Nothing is pressed and the spring wheel is let go; the counts stay."""
        print(f"{NAME}: {self.path} is lost: {why}", file=sys.stderr)
        os.close(self.fd)
        self.fd = self.dial = None
        self.take(bytes(REPORT_BYTES))
        self.dial = None        # where the dial will be is not known

    def back(self, path, fd):
        print(f"{NAME}: {path} is back", file=sys.stderr)
        self.path, self.fd = path, fd


def found(paths, used=(), quiet=False):
    """(path, descriptor, model) of each Shuttle among the devices, but for those used."""
    for path in paths or sorted(glob.glob("/dev/hidraw*")):
        if path in used:
            continue
        try:
            fd = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        except OSError as e:
            if not quiet and (paths or e.errno == errno.EACCES):
                print(f"{NAME}: {path}: {e.strerror} (its group, or a udev rule, gives access)", file=sys.stderr)
            continue
        if model := MODELS.get(identity(fd)):
            yield path, fd, model
        else:
            os.close(fd)


def find_lost(devices, paths):
    """Gives the lost ones the devices of their models that are there."""
    for path, fd, model in found(paths, {d.path for d in devices if d.fd is not None}, quiet=True):
        lost = [d for d in devices if d.fd is None and d.model == model]
        if lost:
            min(lost, key=lambda d: d.path != path).back(path, fd)
        else:
            os.close(fd)


def serve(devices, paths):
    """Takes reports for ever."""
    while True:
        by_fd = {d.fd: d for d in devices if d.fd is not None}
        ready = select.poll()
        for fd in by_fd:
            ready.register(fd, select.POLLIN)
        all_there = len(by_fd) == len(devices)
        for fd, _ in ready.poll(None if all_there else SEARCH_MS):
            try:
                report = os.read(fd, REPORT_BYTES)
            except BlockingIOError:
                continue
            except OSError as e:
                by_fd[fd].lose(e.strerror)
                continue
            if not report:
                by_fd[fd].lose("unplugged")
            elif len(report) == REPORT_BYTES:
                by_fd[fd].take(report)
        if not all_there:
            find_lost(devices, paths)


def main():
    opened = list(found(sys.argv[1:]))
    if not opened:
        print(f"{NAME}: no devices found", file=sys.stderr)
        return 1
    component = hal.component(NAME)
    devices = [Device(component, n, *each) for n, each in enumerate(opened)]
    component.ready()
    serve(devices, sys.argv[1:])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
