# SPDX-License-Identifier: GPL-2.0-or-later
"""Pins, parameters and signals that a person may set: what is behind sim_pin and simulate_probe."""

import hal
from hal import query

KINDS = {hal.HAL_BIT: "bit", hal.HAL_S32: "s32", hal.HAL_U32: "u32", hal.HAL_FLOAT: "float"}
RANGES = {"s32": (-2**31, 2**31 - 1), "u32": (0, 2**32 - 1)}


class NotWritable(Exception):
    """Says which name, why, and what to do."""


class Item:
    """One name in HAL, its type (bit, s32, u32, float) and how it is set."""

    def __init__(self, name):
        """Raises NotWritable."""
        self.name = name
        self.what, self.signal, found = self._find()
        try:
            self.kind = KINDS[found["type"]]
        except KeyError:
            raise NotWritable(f"{name}: a {self.what} of type {found['type'].name} cannot be set here: "
                              "bit, s32, u32 and float can") from None
        self.start = self.get()

    def _find(self):
        name = self.name
        if pin := query.pin(name):
            if not pin["signal"]:
                if pin["dir"] == hal.HAL_OUT:
                    raise NotWritable(f"{name}: is an output of {pin['comp']}: only its component sets it")
                return "pin", None, pin
            return "pin", self._free(pin["signal"], f"{name} is connected to the signal {pin['signal']}, which"), pin
        if param := query.param(name):
            if param["dir"] == hal.HAL_RO:
                raise NotWritable(f"{name}: the parameter is read-only")
            return "parameter", None, param
        if signal := query.signal(name):
            return "signal", self._free(name, "the signal"), signal
        raise NotWritable(f"{name}: no such pin, parameter or signal (see: halcmd show)")

    def _free(self, signal, subject):
        found = query.signal(signal)
        if found["writers"]:
            raise NotWritable(f"{self.name}: {subject} is written by {found['driver'] or 'a pin'}: disconnect that first "
                              f"(halcmd unlinkp {found['driver'] or 'PIN'})")
        return signal

    def get(self):
        """The value now. Raises NotWritable when it is gone."""
        value = hal.get_s(self.signal) if self.signal else hal.get_p(self.name)
        if value is None:
            raise NotWritable(f"{self.name}: is gone")
        return value

    def set(self, value):
        """Raises NotWritable when the value does not fit or is refused."""
        low, high = RANGES.get(self.kind, (None, None))
        if low is not None and not (low <= value <= high and value == int(value)):
            raise NotWritable(f"{self.name}: {value} is no {self.kind}: whole numbers {low} to {high}")
        if low is not None:
            value = int(value)
        try:
            hal.set_s(self.signal, value) if self.signal else hal.set_p(self.name, value)
        except RuntimeError as error:
            raise NotWritable(str(error)) from None

    def step(self, by):
        """One more or less, not beyond the type's range."""
        low, high = RANGES[self.kind]
        self.set(min(max(self.get() + by, low), high))

    def reset(self):
        """Back to the value it had at first."""
        self.set(self.start)

    def text(self):
        value = self.get()
        if self.kind == "u32":
            return f"{value} (0x{value:08X})"
        return f"{value:.6g}" if self.kind == "float" else str(int(value))


class Button:
    """What pressing and releasing does to a bit, by mode."""
    MODES = ("pulse", "toggle", "hold")

    def __init__(self, item, mode="toggle"):
        self.item, self.mode = item, mode

    def press(self):
        """True when the caller must call end_pulse() after a while."""
        self.item.set(not self.item.get() if self.mode == "toggle" else True)
        return self.mode == "pulse"

    def release(self):
        if self.mode == "hold":
            self.item.set(False)

    def end_pulse(self):
        self.item.set(False)
