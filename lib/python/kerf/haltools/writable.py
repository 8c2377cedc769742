# SPDX-License-Identifier: GPL-2.0-or-later
"""Pins, parameters and signals that a person may set: what is behind sim_pin and simulate_probe."""

import hal
from hal import query

from ..language import _, N_

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
            raise NotWritable(_("%s: a %s of type %s cannot be set here: bit, s32, u32 and float can")
                              % (name, _(self.what), found["type"].name)) from None
        self.start = self.get()

    def _find(self):
        name = self.name
        if pin := query.pin(name):
            if not pin["signal"]:
                if pin["dir"] == hal.HAL_OUT:
                    raise NotWritable(_("%s: is an output of %s: only its component sets it") % (name, pin["comp"]))
                return N_("pin"), None, pin
            return N_("pin"), self._free(pin["signal"], connected=True), pin
        if param := query.param(name):
            if param["dir"] == hal.HAL_RO:
                raise NotWritable(_("%s: the parameter is read-only") % name)
            return N_("parameter"), None, param
        if signal := query.signal(name):
            return N_("signal"), self._free(name), signal
        raise NotWritable(_("%s: no such pin, parameter or signal (see: halcmd show)") % name)

    def _free(self, signal, connected=False):
        found = query.signal(signal)
        if found["writers"]:
            driver = found["driver"] or "PIN"
            if connected:
                raise NotWritable(_("%s: %s is connected to the signal %s, which is written by %s: disconnect that "
                                    "first (halcmd unlinkp %s)")
                                  % (self.name, self.name, signal, driver, driver))
            raise NotWritable(_("%s: the signal is written by %s: disconnect that first (halcmd unlinkp %s)")
                              % (self.name, driver, driver))
        return signal

    def get(self):
        """The value now. Raises NotWritable when it is gone."""
        value = hal.get_s(self.signal) if self.signal else hal.get_p(self.name)
        if value is None:
            raise NotWritable(_("%s: is gone") % self.name)
        return value

    def set(self, value):
        """Raises NotWritable when the value does not fit or is refused."""
        low, high = RANGES.get(self.kind, (None, None))
        if low is not None and not (low <= value <= high and value == int(value)):
            raise NotWritable(_("%s: %s is no %s: whole numbers %s to %s") % (self.name, value, self.kind, low, high))
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
        self.ending = None          # the mode of a press whose bit is still to be cleared

    def press(self):
        """True when the caller must call end_pulse() after a while."""
        self.item.set(not self.item.get() if self.mode == "toggle" else True)
        self.ending = None if self.mode == "toggle" else self.mode
        return self.mode == "pulse"

    def release(self):
        if self.ending == "hold":
            self.finish()

    def end_pulse(self):
        if self.ending == "pulse":
            self.finish()

    def finish(self):
        """Nothing stays set that was to be cleared later."""
        if self.ending:
            self.item.set(False)
            self.ending = None
