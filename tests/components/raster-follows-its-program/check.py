#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of pixels come over a port; the output is interpolated along the position. A wrong header or
pixel is a fault with its code until reset."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import LETTER, Session  # noqa: E402

INPUTS = [("position", "float"), ("run", "bit"), ("reset", "bit")]
OUTPUTS = [("output", "float"), ("enabled", "bit"), ("fault", "bit"), ("fault-code", "s32"), ("state", "s32"),
           ("bitmap-position", "float"), ("fraction", "float")]
FEED = """
import hal, sys
c = hal.component("feeder")
p = c.newpin("out", hal.HAL_PORT, hal.HAL_OUT)
c.ready()
hal.connect("feeder.out", "program")
sys.exit(not p.write(sys.argv[1].encode()) if sys.argv[1] else 0)
"""
# 4 bits a pixel: 0 is 0 %, e is 100 %, f is off. The program, then a row a cycle.
CASES = {
    "0;4;1;4;0F8e": [
        ("10 1 0", (-1, 0, 0, 0, 1, 0, 0)), ("10 1 0", (0, 1, 0, 0, 1, 0, 0)), ("10.5 1 0", (-1, 1, 0, 0, 1, .5, 0)),
        ("12 1 0", (800 / 14, 1, 0, 0, 1, 2, 0)),
        ("12.5 1 0", ((800 / 14 + 100) / 2, 1, 0, 0, 1, 2.5, .5)), ("13 1 0", (100, 1, 0, 0, 1, 3, .5)),
        ("14 1 0", (-1, 1, 0, 0, 1, 4, .5)), ("14 0 0", (-1, 0, 0, 0, 0, 4, .5)), ("14 0 0", (-1, 0, 0, 0, 0, 0, .5))],
    # backward: 2 pixels a unit, the first 1 unit behind the start
    "-1;8;2;2;00fe": [
        ("5 1 0", (-1, 0, 0, 0, 1, 0, 0)), ("5 1 0", (-1, 1, 0, 0, 1, -2, 0)), ("4 1 0", (0, 1, 0, 0, 1, 0, 0)),
        ("3.75 1 0", (50, 1, 0, 0, 1, .5, .5)), ("3.5 1 0", (100, 1, 0, 0, 1, 1, .5))],
    "x;4;1;2;00": [("0 1 0", (-1, 0, 0, 1, 2, 0, 0)), ("0 1 0", (-1, 0, 1, 1, 2, 0, 0)),
                   ("0 1 1", (-1, 0, 0, 0, 0, 0, 0))],
    "0;5;1;2;00": [("0 1 0", (-1, 0, 0, 2, 2, 0, 0))],
    "0;36;1;2;00": [("0 1 0", (-1, 0, 0, 2, 2, 0, 0))],
    "0;4;0;2;00": [("0 1 0", (-1, 0, 0, 3, 2, 0, 0))],
    "0;4;1;1;0": [("0 1 0", (-1, 0, 0, 4, 2, 0, 0))],
    "0;4;1;2;0g": [("0 1 0", (-1, 0, 0, 0, 1, 0, 0)), ("0 1 0", (0, 1, 0, 0, 1, 0, 0)),
                   ("1 1 0", (-1, 1, 0, 5, 2, 1, 0)), ("1 1 0", (-1, 0, 1, 5, 2, 1, 0))],
    "0;4;1;2;0": [("0 1 0", (-1, 0, 0, 6, 2, 0, 0))],
    "": [("0 1 0", (-1, 0, 0, 1, 2, 0, 0))],
}


def run(number: int, program: str, rows: list[tuple[str, tuple[float, ...]]]) -> list[str]:
    session = Session(str(number))
    lines = ["loadrt raster", "loadrt threads name1=thread",
             f"loadrt streamer depth=50 cfg={''.join(LETTER[t] for _, t in INPUTS)}",
             f"loadrt sampler depth=50 cfg={''.join(LETTER[t] for _, t in OUTPUTS)}",
             "newsig program port", "sets program 100", "net program raster.0.program"]
    lines += [f"net i{n} streamer.0.pin.{n} => raster.0.{p}" for n, (p, _) in enumerate(INPUTS)]
    lines += [f"net o{n} raster.0.{p} => sampler.0.pin.{n}" for n, (p, _) in enumerate(OUTPUTS)]
    lines += [f"addf {f} thread" for f in ("streamer.0", "raster.0", "sampler.0")]
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            Path(folder, "set-up.hal").write_text("\n".join(lines) + "\n")
            status, _, errors = session.command(folder, "halcmd", "-f", f"{folder}/set-up.hal")
            if status:
                return [errors]
            status, _, errors = session.command(folder, "/usr/bin/python3", "-c", FEED, program)
            if status:
                return [f"feeding {program}: {errors}"]
            session.command(folder, "halstreamer", feed="".join(r + "\n" for r, _ in rows))
            session.command(folder, "halcmd", "start")
            _, text, _ = session.command(folder, "halsampler", "-n", str(len(rows)))
        finally:
            session.command(folder, "realtime", "stop")
    mistakes = []
    for cycle, (line, (row, wanted)) in enumerate(zip(text.splitlines(), rows)):
        for (pin, _), got, want in zip(OUTPUTS, line.split(), wanted):
            if abs(float(got) - want) > 2e-6:
                mistakes.append(f"{program!r}, cycle {cycle} ({row}): {pin} is {got}, expected {want}")
    if len(text.splitlines()) != len(rows):
        mistakes.append(f"{program!r}: {text!r}")
    return mistakes


if __name__ == "__main__":
    found = [m for n, (program, rows) in enumerate(CASES.items()) for m in run(n, program, rows)]
    print("\n".join(found) or "all rows hold")
    sys.exit(bool(found))
