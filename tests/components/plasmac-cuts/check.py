#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""plasmac through cuts: probe with the float switch, pierce, cut, end; an arc that does not light; a machine
that is switched off. The torch moves as the offsets say; the float switch closes at 2 mm."""

from __future__ import annotations

import sys

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

PLATE, PIERCE, CUT = 2.0, 4.0, 1.5      # mm
SETTINGS = {
    "units-per-mm": 1, "machine-is-on": 1, "homed": 1, "mode": 1, "axis-z-min-limit": 0, "axis-z-max-limit": 30,
    "setup-feed-rate": 6000, "probe-feed-rate": 3000, "cut-feed-rate": 1000, "pierce-height": PIERCE,
    "cut-height": CUT, "cut-volts": 100, "pierce-delay": 0.05, "arc-fail-delay": 0.03, "arc-max-starts": 2,
    "restart-delay": 0.02, "arc-lost-delay": 0.1, "safe-height": 10, "feed-override": 1, "current-velocity": 10,
}
PINS = [("state-out", "s32"), ("torch-on", "bit"), ("feed-hold", "bit"), ("arc-ok-out", "bit"), ("cut-time", "float"),
        ("pierce-count", "s32"), ("program-pause", "bit"), ("z-offset-counts", "s32")]
mistakes: list[str] = []


def run(name: str, rows: list[str], arc: bool) -> list[dict[str, float]]:
    """rows: cutting-start, torch-enable, machine-is-on, program-is-running, program-is-idle in each cycle."""
    part = Part(
        "plasmac\nloadrt conv_s32_float\nloadrt mult2\nloadrt sum2\nloadrt comp",
        [(f"plasmac.{n}", v) for n, v in SETTINGS.items() if n != "machine-is-on"]
        + [("sum2.0.offset", 20), ("comp.0.in1", PLATE)],
        ["comp.0", "plasmac", "conv-s32-float.0", "mult2.0", "sum2.0"],
        [(f"plasmac.{p}", "bit") for p in ("cutting-start", "torch-enable", "machine-is-on", "program-is-running",
                                           "program-is-idle")],
        [(f"plasmac.{p}", t) for p, t in PINS] + [("sum2.0.out", "float")], rows,
        extra=["net o0-7 => conv-s32-float.0.in", "net counts conv-s32-float.0.out => mult2.0.in0",
               "net scale plasmac.offset-scale => mult2.0.in1",
               "net offset mult2.0.out => plasmac.z-offset-current sum2.0.in0",
               "net o0-8 => plasmac.axis-z-position comp.0.in0", "net float comp.0.out => plasmac.float-switch"]
        + (["net o0-1 => plasmac.arc-ok-in"] if arc else []))
    names = [p for p, _ in PINS] + ["z"]
    return [dict(zip(names, map(float, line))) for line in Session(name).run([part])[0]]


def states(samples: list[dict[str, float]]) -> list[int]:
    """The states in the order in which they came."""
    all_of_them = [int(s["state-out"]) for s in samples]
    return [b for a, b in zip([None, *all_of_them], all_of_them) if a != b]


def check(what: str, good: bool, value: object) -> None:
    if not good:
        mistakes.append(f"{what}: {value}")


def cut() -> None:
    samples = run("cut", ["0 1 1 1 0"] * 10 + ["1 1 1 1 0"] * 3990 + ["0 1 1 1 0"] * 1000 + ["0 1 1 0 1"] * 1000, True)
    got = states(samples)
    check("states of a cut", got[:11] == [0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11] and got[11] in (13, 14)
          and got[-1] == 0 and set(got[12:]) <= {14, 15, 16, 17, 0}, got)
    for s in samples:
        if s["torch-on"] and s["state-out"] not in (6, 7, 8, 10, 11, 13, 14):
            check("torch on in state", False, s)
            break
    for state, hold, z in ((8, 1, PLATE + PIERCE), (11, 0, PLATE + CUT)):
        there = [s for s in samples if s["state-out"] == state]
        last = there[-1]
        check(f"feed-hold in state {state}", all(s["feed-hold"] == hold for s in there[1:-1]), last)
        check(f"height in state {state}", abs(last["z"] - z) < 0.05, last["z"])
        check(f"torch in state {state}", all(s["torch-on"] for s in there[:-1]), last)
    piercing = sum(s["state-out"] == 8 for s in samples)
    check("cycles of piercing", abs(piercing - 50) <= 2, piercing)
    end = samples[-1]
    cutting = sum(s["state-out"] == 11 for s in samples)
    check("cut-time", abs(end["cut-time"] - cutting * 0.001) < 0.003, (end["cut-time"], cutting))
    check("end", not end["torch-on"] and not end["feed-hold"] and abs(end["z"] - 20) < 0.01
          and end["pierce-count"] == 1, end)


def no_arc() -> None:
    samples = run("no-arc", ["0 1 1 1 0"] * 10 + ["1 1 1 1 0"] * 2500, False)
    got = states(samples)
    check("states without an arc", got[:8] == [0, 1, 2, 3, 4, 5, 6, 7] and 8 not in got and got.count(7) == 2, got)
    check("pauses", any(s["program-pause"] for s in samples), got)
    check("torch without an arc", not samples[-1]["torch-on"] and samples[-1]["pierce-count"] == 2, samples[-1])
    on = sum(s["torch-on"] for s in samples)
    check("torch time without an arc", abs(on - 2 * 30) <= 6, on)


def switched_off() -> None:
    samples = run("off", ["0 1 1 1 0"] * 10 + ["1 1 1 1 0"] * 2500 + ["1 1 0 1 0"] * 20, True)
    check("off while cutting", samples[2500]["torch-on"] == 1, samples[2500])
    for s in samples[2510:]:
        if s["torch-on"] or s["state-out"] != 0 or s["z-offset-counts"]:
            check("machine off", False, s)
            break


if __name__ == "__main__":
    cut()
    no_arc()
    switched_off()
    print("\n".join(mistakes) or "cut")
    sys.exit(bool(mistakes))
