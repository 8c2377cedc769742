#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""limit3, limit2, limit1 and simple_tp follow random inputs; the outputs, differentiated
here, must keep position, velocity and acceleration limits. Inputs jump, ramp, swing, are
not a number or infinite, and the component is enabled and disabled at random.

check.py [SEED...]"""

from __future__ import annotations

import math
import random
import sys

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

CYCLES = 4000
PERIOD = 0.001              # s
SCALE = 1e6                 # outputs are sampled in millionths, to keep digits
CASES = 8                   # at a time


def wild(rng: random.Random) -> list[float]:
    """A signal that changes its nature every now and then."""
    values, x, left = [], 0.0, 0
    while len(values) < CYCLES:
        if left == 0:
            kind, left = rng.choice(["hold", "step", "ramp", "sine", "noise", "bad"]), rng.randint(1, 300)
            size, rate = 10 ** rng.uniform(-3, 2), rng.uniform(0.01, 60)
            if kind == "step":
                x = rng.choice([-1, 1]) * size
            start = x
        phase = len(values) * PERIOD
        if kind == "ramp":
            x += size * PERIOD * rate
        elif kind == "sine":
            x = start + size * math.sin(rate * phase)
        elif kind == "noise":
            x = rng.gauss(0, size)
        values.append(rng.choice([math.nan, math.inf, -math.inf]) if kind == "bad" and rng.random() < .3 else x)
        left -= 1
    return values


def worst_excess(y: list[float], low: float, high: float, vmax: float, amax: float) -> dict[str, float]:
    """How far position, velocity and acceleration go beyond their limits, as a
    share of the limit (position: of the range)."""
    span = max(high - low, 1e-9)
    v = [(b - a) / PERIOD for a, b in zip([0.0] + y, y)]
    a = [(q - p) / PERIOD for p, q in zip([0.0] + v, v)]
    return {"position": max(max(low - p, p - high, 0) for p in y) / span,
            "velocity": max(max(abs(p) - vmax, 0) for p in v) / vmax,
            "acceleration": max(max(abs(p) - amax, 0) for p in a) / amax}


def run(seed: int) -> list[str]:
    """The mistakes of one seed."""
    rng = random.Random(seed)
    parts, limits = [], []
    for n in range(CASES):
        kind = ("limit3", "limit3", "limit3", "simple_tp", "simple_tp", "limit2", "limit2", "limit1")[n]
        vmax, amax = 10 ** rng.uniform(-1, 3), 10 ** rng.uniform(0, 4)
        low, high = (-rng.uniform(0, 5), rng.uniform(0, 5)) if rng.random() < .7 else (-1e20, 1e20)
        signal = wild(rng)
        enable, on = [], 1
        for _ in signal:
            on ^= rng.random() < .003
            enable.append(on)
        hal = kind.replace("_", "-")
        index = [p.functions[0].split(".")[0] for p in parts].count(hal)
        name = f"{hal}.{index}"
        if kind == "limit3":
            setp = [("min", low), ("max", high), ("maxv", vmax), ("maxa", amax)]
            inputs, function, out = [("in", "float"), ("enable", "bit")], name, "out"
        elif kind == "simple_tp":
            low, high = -1e20, 1e20
            setp = [("maxvel", vmax), ("maxaccel", amax)]
            inputs, function, out = [("target-pos", "float"), ("enable", "bit")], name + ".update", "current-pos"
        else:
            amax = math.inf
            vmax = vmax if kind == "limit2" else math.inf
            setp = [("min", low), ("max", high)] + ([("maxv", vmax)] if kind == "limit2" else [])
            inputs, function, out = [("in", "float")], name, "out"
        limits.append((f"{kind} {n}", low, high, vmax, amax))
        rows = [f"{x!r} {e}" if len(inputs) == 2 else repr(x) for x, e in zip(signal, enable)]
        parts.append(Part("", [(f"{name}.{p}", v) for p, v in setp] + [(f"scale.{n}.gain", SCALE)],
                          [function, f"scale.{n}"], [(f"{name}.{p}", t) for p, t in inputs],
                          [(f"scale.{n}.out", "float")], rows, extra=[f"net y{n} {name}.{out} => scale.{n}.in"]))
    parts[0].load = "limit3 count=3\nloadrt simple_tp count=2\nloadrt limit2 count=2\nloadrt limit1\nloadrt scale count=8"
    mistakes = []
    for samples, (what, *limit) in zip(Session(str(seed)).run(parts), limits):
        y = [float(s[0]) / SCALE for s in samples]
        bad = {q: share for q, share in worst_excess(y, *limit).items() if not share <= 1e-5}
        if len(y) < CYCLES or bad or not all(map(math.isfinite, y)):
            mistakes.append(f"seed {seed}, {what}, limits {limit}: {bad}")
    return mistakes


if __name__ == "__main__":
    seeds = [int(s) for s in sys.argv[1:]] or range(6)
    found = [mistake for seed in seeds for mistake in run(seed)]
    print("\n".join(found) or "limits kept")
    sys.exit(bool(found))
