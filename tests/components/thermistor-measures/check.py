#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The Beta equation for some dividers, and for values that make no sense."""

from __future__ import annotations

import math
import sys
import tempfile

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

CASES = [   # t0-c, r0, beta, r-other, v-total, v-thermistor
    (25, 100000, 3950, 4700, 5, 2.5), (25, 10000, 3435, 10000, 3.3, 1.65), (25, 10000, 3435, 2200, 3.3, 0.4),
    (20, 1000, 3000, 1000, -10, -4), (-300, 100000, 3950, 4700, 5, 2.5), (25, 100000, 3950, 4700, 5, 5),
    (25, 100000, 3950, 0, 5, 2), (25, 100000, 3950, 4700, math.nan, 2.5), (25, 0, 3950, 4700, 5, 2),
]
INPUTS = ("t0-c", "r0", "beta", "r-other", "v-total", "v-thermistor")


def expected(t0_c: float, r0: float, beta: float, r_other: float, v_total: float, v: float) -> tuple[float, float]:
    """Resistance and kelvins."""
    try:
        t0 = t0_c + 273.15
        r_inf = r0 * math.exp(-beta / t0)
        current = (v_total - v) / r_other
        resistance = v / current
        kelvin = beta / math.log(resistance / r_inf)
        good = t0 > 0 and r_other > 0 and r_inf > 0 and current > 0 and resistance > 0 and kelvin >= 0
    except (ZeroDivisionError, ValueError, OverflowError):
        good = False
    return (resistance, kelvin) if good else (0, 9999)


def main() -> int:
    session, mistakes = Session("thermistor"), []
    with tempfile.TemporaryDirectory() as folder:
        def halcmd(*words: str) -> str:
            return session.command(folder, "halcmd", *words)[1].strip()
        try:
            session.command(folder, "realtime", "start")
            halcmd("loadusr", "-W", "thermistor", "names=bed")
            for case in CASES:
                for name, value in zip(INPUTS, case):
                    halcmd("setp", f"bed.{name}", repr(float(value)))
                session.command(folder, "kerf-clock", "sleep", "0.25")
                resistance, kelvin = expected(*case)
                wanted = {"resistance": resistance, "temperature-k": kelvin, "temperature-c": kelvin - 273.15,
                          "temperature-f": (kelvin - 273.15) * 9 / 5 + 32}
                for pin, want in wanted.items():
                    got = float(halcmd("getp", f"bed.{pin}"))
                    if abs(got - want) > 1e-5 * max(1, abs(want)):
                        mistakes.append(f"{case}: {pin} is {got}, expected {want}")
            halcmd("unloadusr", "thermistor")
            halcmd("waitusr", "-i", "thermistor")
        finally:
            session.command(folder, "realtime", "stop")
    print("\n".join(mistakes) or "all measured")
    return bool(mistakes)


if __name__ == "__main__":
    sys.exit(main())
