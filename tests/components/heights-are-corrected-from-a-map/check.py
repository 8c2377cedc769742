#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""z_level_compensation: maps of a tilted plane and of scattered points, what is not there or wrong, fading."""

from __future__ import annotations

import random
import sys
import tempfile
from pathlib import Path

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import z_level_compensation as z  # noqa: E402

mistakes: list[str] = []


def check(what: str, got: object, want: object) -> None:
    if got != want and not (isinstance(got, float) and abs(got - want) < 1e-9):
        mistakes.append(f"{what}: {got}, expected {want}")


def maps() -> None:
    def plane(x: float, y: float) -> float:
        return 0.1 * x - 0.05 * y + 1

    grid = [(float(x), float(y), plane(x, y)) for x in range(0, 21, 5) for y in range(-10, 11, 5)]
    rng = random.Random(1)
    corners = [(0.0, -10.0), (20.0, -10.0), (0.0, 10.0), (20.0, 10.0)]
    scattered = [(x, y, plane(x, y)) for x, y in corners + [
        (round(rng.uniform(0, 20), 1), round(rng.uniform(-10, 10), 1)) for _ in range(60)]]
    for name, points in (("grid", grid), ("scattered", scattered)):
        found = z.Map(points, "linear")
        for x in range(0, 21):
            for y in range(-10, 11):
                check(f"{name} {x} {y}", found.at(x, y), plane(x, y))
        check(f"{name}, rounded", found.at(3.4, -2.6), plane(3, -3))
        check(f"{name}, beyond", found.at(99, -99), plane(20, -10))
    nearest = z.Map(grid, "nearest")
    check("nearest", nearest.at(6, 1), plane(5, 0))
    hole = z.Map([(0.0, 0.0, 1.0), (10.0, 0.0, 1.0), (0.0, 10.0, 1.0), (5.0, 5.0, 1.0)], "linear")
    # FP-075: whatever the interpolation says, a correction stays within the range of the map, also beyond its edges
    kept = z.Map.__dict__["smooth"]
    z.Map.smooth = staticmethod(lambda grid, places, heights: heights.max() + 48.0 * grid[..., 0])
    wild = z.Map(grid, "cubic")
    z.Map.smooth = kept
    check("overshoot", (wild.at(20, 0), wild.at(999, 0)), (max(p[2] for p in grid),) * 2)
    check("inside", hole.at(2, 2), 1.0)
    check("nothing known", hole.at(9, 9), 0.0)


def numbers() -> None:
    check("no fading", z.fade(5, 0), 1.0)
    check("fading", z.fade(3, 4), 0.25)
    check("below zero", z.fade(-3, 4), 1.0)
    check("above", z.fade(5, 4), 0.0)
    check("counts", (z.counts(0.1239, 1), z.counts(-0.1239, 0.5)), (123, -61))


def component(folder: str) -> None:
    pins = {"enable-in": False, "x-pos": 7.0, "y-pos": 2.0, "z-pos": 0.0, "fade-height": 0.0, "method": 1}
    z.clock.sleep = lambda seconds: cleared.append(pins["clear"])
    cleared: list[bool] = []
    on = [True]
    part = z.Compensation(pins, lambda: (on[0], 2.0, -1.0), folder)
    part.step()
    check("disabled", (pins["counts"], pins["scale"], cleared), (0, 0.001, []))
    pins["enable-in"] = True
    part.step()
    check("no file", pins["counts"], 0)
    path = Path(folder, z.POINTS)
    path.write_text("0 0 0.5\n10 0 0.5\n0 10 x\n10 10 0.5\n")
    part.step()
    check("wrong file", pins["counts"], 0)
    path.write_text("0 0 0.5\n10 0 0.5\n\n0 10 0.5\n10 10 0.5\n")
    part.step()
    check("enabled", pins["counts"], 500)
    on[0] = False
    part.step()
    check("machine off", pins["counts"], 0)
    on[0], pins["method"] = True, 9
    part.step()
    check("unknown method", pins["counts"], 500)
    pins["enable-in"] = False
    part.step()
    check("disabled again", (pins["counts"], cleared, pins["clear"]), (0, [True], False))


if __name__ == "__main__":
    maps()
    numbers()
    with tempfile.TemporaryDirectory() as name:
        component(name)
        sys.stderr.flush()
        try:
            Path(name, z.POINTS).write_text("0 0 1\n1 2\n")
            z.read_points(Path(name, z.POINTS))
        except ValueError as error:
            check("message", str(error).removeprefix(name), f"/{z.POINTS}:2: three numbers (x y z) are expected: '1 2'")
    print("\n".join(mistakes) or "all heights right")
    sys.exit(bool(mistakes))
