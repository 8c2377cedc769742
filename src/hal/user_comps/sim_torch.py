#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Arc voltage of a plasma torch, to try a configuration without one: HAL component sim-torch.

While `start` is TRUE the voltage rises from on-delay-in over the overshoot down to voltage-in, in
cycles-in cycles of 1 ms; later it has cut-noise-in. `void` lets it rise by void_ramp a cycle. The program
ends with `close`, or with the motion module.
"""

import random
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock

CYCLE_S = 0.001
NOISE_EVERY = 5             # cycles
FIRST_STEP = 0.4            # share of the peak
VOID_MAX = 300.0            # V
PINS = [    # name, type, start value
    ("cut-noise-in", hal.HAL_FLOAT, 0.75), ("cycles-in", hal.HAL_S32, 200), ("on-delay-in", hal.HAL_S32, 10),
    ("offset-in", hal.HAL_FLOAT, 0.0), ("overshoot-in", hal.HAL_S32, 50), ("ramp-noise-in", hal.HAL_FLOAT, 5.0),
    ("ramp-up-in", hal.HAL_S32, 80), ("start", hal.HAL_BIT, False), ("voltage-in", hal.HAL_FLOAT, 100.0),
    ("close", hal.HAL_BIT, False), ("void", hal.HAL_BIT, False), ("void_ramp", hal.HAL_S32, 0),
]


def clamp(value, low, high):
    return min(max(value, low), high)


class Torch:
    """The voltage, cycle by cycle. pins: values by name."""

    def __init__(self, rng=random):
        self.rng = rng
        self.cycle = 0
        self.void_cycles = 0

    def noise(self, size):
        return self.rng.uniform(-size, size) if self.cycle % NOISE_EVERY == 0 else 0.0

    def ramp(self, pins, voltage, cycles):
        peak = voltage * clamp(pins["overshoot-in"], 0, 100) / 100
        first = FIRST_STEP * peak
        up = cycles * clamp(pins["ramp-up-in"], 0, 100) / 100
        delay, n = clamp(pins["on-delay-in"], 0, 100), self.cycle
        if n < delay:
            return (voltage + first) / delay * n
        noise = self.noise(abs(pins["ramp-noise-in"]))
        if n <= up:
            return voltage + first + (n * (peak - first) / up if up else 0) + noise
        return voltage + peak - (n - up) * peak / (cycles - up) + noise

    def step(self, pins):
        """voltage-out of this cycle."""
        if not pins["start"]:
            self.cycle = self.void_cycles = 0
            return 0.0
        voltage, cycles = clamp(pins["voltage-in"], 50, 150), abs(pins["cycles-in"])
        if self.cycle < cycles:
            out = self.ramp(pins, voltage, cycles)
        elif pins["void"]:
            self.void_cycles += 1
            out = min(VOID_MAX, voltage + pins["void_ramp"] * self.void_cycles)
        else:
            self.void_cycles = 0
            out = voltage + clamp(pins["offset-in"], -10, 10) + self.noise(abs(pins["cut-noise-in"]))
        self.cycle += 1
        return out


def main():
    component = hal.component("sim-torch")
    for name, kind, value in PINS:
        component.newpin(name, kind, hal.HAL_IN)
        component[name] = value
    component.newpin("voltage-out", hal.HAL_FLOAT, hal.HAL_OUT)
    component.ready()
    torch = Torch()
    clock.join("sim-torch", 500)
    while hal.component_exists("motmod") and not component["close"]:
        component["voltage-out"] = torch.step(component)
        clock.sleep(CYCLE_S)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
