#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Longer runs of limit3, stepgen, pid and encoder, whose values at some cycles are documented."""

from __future__ import annotations

import math
import sys

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

mistakes: list[str] = []


def compare(what: str, k: int, got: list[str], wanted: tuple[float, ...]) -> None:
    for n, (value, want) in enumerate(zip(got, wanted)):
        if not abs(float(value) - want) <= 2e-6 + 1e-6 * abs(want):
            mistakes.append(f"{what}, cycle {k}: value {n} is {value}, expected {want}")


def limit3() -> None:
    step = [0.0] * 5 + [1.0] * 195 + [-0.3] * 200
    wave = [0.6 * math.sin(0.02 * k) for k in range(381)]
    wanted_step = {5: 0.0002, 6: 0.0006, 10: 0.0042, 30: 0.07, 60: 0.22, 100: 0.42, 150: 0.67, 180: 0.82,
                   200: 0.9198, 201: 0.9244, 205: 0.9408, 250: 0.905, 251: 0.9, 260: 0.855, 300: 0.655,
                   350: 0.405, 399: 0.16}
    wanted_wave = {5: 0.0075, 10: 0.0275, 30: 0.2295, 60: 0.3999375, 100: 0.4, 150: 0.0846758623056,
                   180: -0.265512265977, 200: -0.395657924387, 205: -0.399194338989, 250: -0.4, 300: -0.1705,
                   320: 0.0699295229103, 350: 0.369961662257, 380: 0.4}
    parts = [Part("limit3 count=2", [("limit3.0.maxv", 5), ("limit3.0.maxa", 200)], ["limit3.0"],
                  [("limit3.0.in", "float")], [("limit3.0.out", "float")], [repr(x) for x in step]),
             Part("", [("limit3.1.maxv", 20), ("limit3.1.maxa", 500), ("limit3.1.min", -.4), ("limit3.1.max", .4)],
                  ["limit3.1"], [("limit3.1.in", "float")], [("limit3.1.out", "float")], [repr(x) for x in wave])]
    for what, samples, wanted in zip(("limit3 A", "limit3 B"), Session("limit3").run(parts),
                                     (wanted_step, wanted_wave)):
        for k, value in wanted.items():
            compare(what, k, samples[k], (value,))


def pid() -> None:
    setp = {"Pgain": 10, "Igain": 2, "Dgain": .3, "FF0": .1, "FF1": 1, "FF2": .01, "FF3": 1e-5, "deadband": .01,
            "maxerror": 1, "maxerrorI": .05, "maxerrorD": 40, "maxcmdD": 60, "maxoutput": 25, "bias": .2}
    rows = [f"{k >= 3:d} {20 < k < 24:d} {0.02 * k + 0.3 * math.sin(0.2 * k)!r} {-0.5 if k == 24 else 0}"
            for k in range(60)]
    # The plant: feedback += output * 0.0008, and once a step.
    part = Part("pid num_chan=1 debug=1\nloadrt sum2 count=2",
                [(f"pid.0.{n}", v) for n, v in setp.items()] + [("sum2.1.gain1", 0.0008)],
                ["sum2.0", "pid.0.do-pid-calcs", "sum2.1"],
                [("pid.0.enable", "bit"), ("pid.0.index-enable", "bit"), ("pid.0.command", "float"),
                 ("sum2.0.in1", "float")],
                [("pid.0.error", "float"), ("output", "float"), ("pid.0.saturated-count", "s32"),
                 ("pid.0.errorI", "float"), ("pid.0.commandD", "float")], rows,
                extra=["net feedback sum2.0.out => pid.0.feedback sum2.1.in0", "net state sum2.1.out => sum2.0.in0",
                       "net o0-1 => sum2.1.in1"])
    part.outputs[1] = ("pid.0.output", "float")
    wanted = {3: (0.1568255027, 25, 1, 0.0001468255027, 60),
              10: (0.4995288668, -25, 5, 0.002153412701, 0.6349387842),
              24: (0.7447391893, -25, 6, 0.00646190128, 7.373321077),
              40: (1.492774707, -25, 11, 0.01111047152, 17.24447037),
              59: (1.310534443, 25, 10, 0.02101047152, 58.79105306)}
    samples = Session("pid").run([part])[0]
    for k, values in wanted.items():
        compare("pid", k, samples[k], values)


def stepgen() -> None:
    setp = [("0.position-scale", 100), ("0.maxvel", 50), ("0.maxaccel", 1000), ("0.steplen", 30000),
            ("0.dirsetup", 60000), ("1.position-scale", -400), ("1.maxaccel", 300), ("2.position-scale", 100),
            ("2.maxaccel", 5000)]
    rows = []
    for k in range(60):
        t = k * 0.001
        rows.append(f"1 1 1 {20 * t if k < 30 else 0.58 - 30 * (t - 0.029)!r} {0.5 * math.sin(20 * t)!r} "
                    f"{80 if k < 25 else -80}")
    pins = [f"stepgen.{n}.{p}" for n in range(3) for p in ("counts", "position-fb")]
    part = Part("stepgen step_type=0,2,0 ctrl_type=p,p,v", [(f"stepgen.{n}", v) for n, v in setp],
                ["stepgen.capture-position", "stepgen.update-freq"],
                [(f"stepgen.{n}.enable", "bit") for n in range(3)]
                + [("stepgen.0.position-cmd", "float"), ("stepgen.1.position-cmd", "float"),
                   ("stepgen.2.velocity-cmd", "float")],
                [(p, "s32" if p.endswith("counts") else "float") for p in pins], rows,
                extra=["addf stepgen.make-pulses base"])
    wanted = {1: (0, 0, 0, 0, 0, 0.002562498), 5: (1, 0.008049896, -1, 0.002414921, 6, 0.062812440),
              20: (18, 0.180735173, -22, 0.054219475, 96, 0.960999388),
              30: (42, 0.420857082, -51, 0.126254616, 170, 1.698186944),
              59: (84, 0.840999237, -178, 0.445903397, 120, 1.199001820)}
    threads = "loadrt threads name1=base period1=25000 name2=thread period2=1000000"
    samples = Session("stepgen").run([part], threads=threads)[0]
    for k, values in wanted.items():
        compare("stepgen", k, samples[k], values)


def encoder() -> None:
    """Ten updates of 50 us to a capture: the rows start after the first capture (`not` enables them)."""
    rows, phase = [], 0.0
    for k in range(60):
        for _ in range(10):
            phase += 0.31 if k < 25 else 0 if k < 32 else -0.17
            turn = math.floor(phase)
            a, b = ((0, 0), (1, 0), (1, 1), (0, 1))[turn & 3]
            rows.append(f"{a} {b} {turn % 40 == 0:d} {k == 30:d} {k == 20:d} {k in (10, 40):d}")
    part = Part("encoder num_chan=1\nloadrt tristate_bit\nloadrt not",
                [("encoder.0.position-scale", 40), ("tristate-bit.0.in", 1)],
                ["tristate-bit.0", "encoder.update-counters"],
                [("encoder.0.phase-A", "bit"), ("encoder.0.phase-B", "bit"), ("encoder.0.phase-Z", "bit"),
                 ("encoder.0.reset", "bit"), ("encoder.0.latch-input", "bit"), ("tristate-bit.0.enable", "bit")],
                [("encoder.0.rawcounts", "s32"), ("encoder.0.counts", "s32"), ("encoder.0.index-enable", "bit"),
                 ("encoder.0.counts-latched", "s32"), ("encoder.0.velocity", "float"),
                 ("encoder.0.position-interpolated", "float")], rows, cycles=61, sample_in="servo",
                extra=["net o0-2 tristate-bit.0.out", "net go not.0.out => streamer.0.enable",
                       "addf encoder.capture-position servo", "addf not.0 servo"])
    wanted = {0: (3, 3, 0, 0, 0, 0.075), 3: (12, 12, 0, 0, 166.666667, 0.316666667),
              11: (37, 37, 1, 0, 150, 0.9325), 20: (65, 25, 0, 22, 150, 0.6325),
              30: (77, 0, 0, -12, 8.06451613, 0.025), 32: (75, -2, 0, -12, -12.5, -0.05125),
              59: (29, -11, 0, 25, -83.3333333, -0.279166667)}
    threads = "loadrt threads name1=thread period1=50000 name2=servo period2=500000"
    samples = Session("encoder").run([part], threads=threads)[0]
    for k, values in wanted.items():
        compare("encoder", k, samples[k + 1], values)


if __name__ == "__main__":
    for check in (limit3, pid, stepgen, encoder):
        check()
    print("\n".join(mistakes) or "all as documented")
    sys.exit(bool(mistakes))
