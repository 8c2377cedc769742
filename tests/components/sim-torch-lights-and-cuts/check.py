#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The voltage of sim-torch cycle by cycle, and the program's life."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import sim_torch  # noqa: E402

mistakes: list[str] = []
MOTMOD = """
import hal
from kerf import clock
c = hal.component("motmod")
c.newpin("quit", hal.HAL_BIT, hal.HAL_IN)
c.ready()
clock.join("motmod", 500)
while not c["quit"]: clock.sleep(0.01)
"""


class Quiet:
    """Noise of its greatest value."""

    @staticmethod
    def uniform(low: float, high: float) -> float:
        return high


def check(what: str, got: float, want: float) -> None:
    if abs(got - want) > 1e-9:
        mistakes.append(f"{what}: {got}, expected {want}")


def voltages() -> None:
    pins = {name: value for name, _, value in sim_torch.PINS}
    pins |= {"start": True, "cycles-in": -100, "ramp-noise-in": -3, "cut-noise-in": 2, "on-delay-in": 10}
    torch = sim_torch.Torch(Quiet())
    # 100 V: peak 50, first step 20; up in 80 cycles, down in 20.
    wanted = {0: 0, 5: 60, 9: 108, 10: 120 + 10 * 30 / 80 + 3, 11: 120 + 11 * 30 / 80, 80: 150 + 3,
              81: 147.5, 99: 102.5, 100: 102, 101: 100, 105: 102}
    out = [torch.step(pins) for _ in range(110)]
    for n, volts in wanted.items():
        check(f"cycle {n}", out[n], volts)
    pins |= {"offset-in": 30.0}
    check("offset limited", torch.step(pins), 110 + 2)
    pins |= {"void": True, "void_ramp": 60}
    for n, volts in enumerate((160, 220, 280, 300, 300)):
        check(f"void {n}", torch.step(pins), volts)
    pins["void"] = False
    torch.cycle = 116
    check("void over", torch.step(pins), 110)
    pins["start"] = False
    check("stopped", torch.step(pins), 0)
    pins |= {"start": True, "voltage-in": 1000.0, "ramp-up-in": 0, "on-delay-in": -5, "overshoot-in": 500}
    check("limits", torch.step(pins), 150 + 0.4 * 150 + 3)


def life() -> None:
    session = Session("torch")
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            Path(folder, "motmod.py").write_text(MOTMOD)
            session.env["PYTHONPATH"] = str(TOP / "lib/python")
            status, _, errors = session.command(folder, "halcmd", "loadusr", "-Wn", "motmod", "/usr/bin/python3",
                                                folder + "/motmod.py")
            if status:
                mistakes.append(errors)
            session.command(folder, "halcmd", "loadusr", "-W", "sim-torch")
            session.command(folder, "halcmd", "setp", "sim-torch.start", "1")
            session.command(folder, "kerf-clock", "sleep", "0.3")
            volts = float(session.command(folder, "halcmd", "getp", "sim-torch.voltage-out")[1])
            if not 99 <= volts <= 101:
                mistakes.append(f"cutting with {volts} V")
            session.command(folder, "halcmd", "setp", "motmod.quit", "1")
            session.command(folder, "halcmd", "waitusr", "-i", "motmod")
            session.command(folder, "halcmd", "waitusr", "-i", "sim-torch")     # ends with motmod
            if "sim-torch" in session.command(folder, "halcmd", "list", "comp")[1]:
                mistakes.append("sim-torch stays")
        finally:
            session.command(folder, "realtime", "stop")


if __name__ == "__main__":
    voltages()
    life()
    print("\n".join(mistakes) or "lights, cuts, ends")
    sys.exit(bool(mistakes))
