#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""stepgen follows random commands with random times, step types and base periods. The
outputs, sampled in the base thread, must keep every time that was asked for, and their
steps must add up to the counts.

check.py [SEED...]"""

from __future__ import annotations

import random
import sys
from dataclasses import dataclass

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

SERVO_NS = 1000000
SERVO_CYCLES = 700
PHASES = {2: 2, 3: 3, 4: 3, 5: 4, 6: 4, 7: 4, 8: 4, 9: 4, 10: 4, 11: 5, 12: 5, 13: 5, 14: 5}
STATES = {2: (1, 3, 2, 0), 3: (1, 2, 4), 4: (1, 3, 2, 6, 4, 5), 5: (1, 2, 4, 8), 6: (3, 6, 12, 9),
          7: (1, 7, 14, 8), 8: (5, 6, 10, 9), 9: (1, 3, 2, 6, 4, 12, 8, 9), 10: (1, 5, 7, 6, 14, 10, 8, 9),
          11: (1, 2, 4, 8, 16), 12: (3, 6, 12, 24, 17), 13: (1, 3, 2, 6, 4, 12, 8, 24, 16, 17),
          14: (3, 7, 6, 14, 12, 28, 24, 25, 17, 19)}
SETTLE = 3                  # servo cycles until the times are taken over


@dataclass
class Channel:
    type: int
    velocity: bool
    steplen: int
    stepspace: int
    dirsetup: int
    dirhold: int            # dirdelay for other types

    def pins(self) -> list[str]:
        if self.type < 2:
            return [["step", "dir"], ["up", "down"]][self.type]
        return [f"phase-{'ABCDE'[i]}" for i in range(PHASES[self.type])]


def wild(rng: random.Random) -> list[float]:
    values, x, left, kind = [], 0.0, 0, ""
    while len(values) < SERVO_CYCLES:
        if left == 0:
            kind, left = rng.choice(["hold", "step", "ramp", "noise", "shake"]), rng.randint(1, 60)
            size = 10 ** rng.uniform(-3, 1.3)
            if kind == "step":
                x += rng.choice([-1, 1]) * size
        if kind == "ramp":
            x += size * .01
        elif kind == "noise":
            x += rng.gauss(0, size * .01)
        elif kind == "shake":
            x += size * .02 * (1 if left % 2 else -1)
        values.append(x)
        left -= 1
    return values


def pulses(level: list[int], what: str, high_ns: int, low_ns: int, period: int) -> list[str]:
    """Each pulse is long enough and far enough from the next."""
    mistakes, since = [], None
    for tick in range(1, len(level)):
        if level[tick] == level[tick - 1]:
            continue
        if since is not None:
            least = high_ns if level[tick - 1] else low_ns
            if (tick - since) * period < least:
                mistakes.append(f"{what} {'high' if level[tick - 1] else 'low'} for "
                                f"{(tick - since) * period} ns at tick {tick}, at least {least}")
        since = tick
    return mistakes


def edges(level: list[int], rising: bool) -> list[int]:
    return [t for t in range(1, len(level)) if level[t] != level[t - 1] and bool(level[t]) == rising]


def apart(first: list[int], then: list[int], least: int, period: int, what: str) -> list[str]:
    """From the last of `first` to each of `then` (same tick included) passes `least` ns."""
    mistakes, at, last = [], 0, None
    for tick in then:
        while at < len(first) and first[at] <= tick:
            last = first[at]
            at += 1
        if last is not None and (tick - last) * period < least:
            mistakes.append(f"{what}: {(tick - last) * period} ns at tick {tick}, at least {least}")
    return mistakes


def check_step_dir(c: Channel, step: list[int], direction: list[int], period: int) -> tuple[list[str], int]:
    turns = sorted(edges(direction, True) + edges(direction, False))
    mistakes = pulses(step, "step", c.steplen, c.stepspace, period)
    mistakes += apart(edges(step, False), turns, c.dirhold, period, "step end to dir")
    if c.dirsetup >= 10:        # shorter ones mean: no matter
        mistakes += apart(turns, edges(step, True), c.dirsetup, period, "dir to step")
    return mistakes, sum(-1 if direction[t] else 1 for t in edges(step, True))


def check_up_down(c: Channel, up: list[int], down: list[int], period: int) -> tuple[list[str], int]:
    mistakes = pulses(up, "up", c.steplen, c.stepspace, period)
    mistakes += pulses(down, "down", c.steplen, c.stepspace, period)
    mistakes += [f"up and down at tick {t}" for t in range(len(up)) if up[t] and down[t]][:1]
    mistakes += apart(edges(up, False), edges(down, True), c.dirhold, period, "up to down")
    mistakes += apart(edges(down, False), edges(up, True), c.dirhold, period, "down to up")
    return mistakes, len(edges(up, True)) - len(edges(down, True))


def check_phases(c: Channel, bits: list[int], period: int) -> tuple[list[str], int]:
    states, mistakes, net, last, way = STATES[c.type], [], 0, None, 0
    for tick in range(1, len(bits)):
        if bits[tick] == bits[tick - 1]:
            continue
        step = (states.index(bits[tick]) - states.index(bits[tick - 1])) % len(states)
        turn = 1 if step == 1 else -1 if step == len(states) - 1 else 0
        if turn == 0:
            mistakes.append(f"jump from {bits[tick - 1]} to {bits[tick]} at tick {tick}")
        least = c.steplen + (c.dirhold if turn != way and way else 0)
        if last is not None and (tick - last) * period < least:
            mistakes.append(f"state for {(tick - last) * period} ns at tick {tick}, at least {least}")
        net, last, way = net + turn, tick, turn
    return mistakes, net


def run(seed: int) -> list[str]:
    rng = random.Random(seed)
    period = rng.choice([10000, 20000, 25000, 40000, 50000, 100000])
    channels, parts = [], []
    for n in range(5):
        kind = rng.choice([0, 0, 1, 1, *PHASES])
        times = [rng.choice([1, 1, rng.randint(100, 4 * period)]) for _ in range(4)]
        channels.append(Channel(kind, rng.random() < .3, *times))
    for n, c in enumerate(channels):
        setp = [("position-scale", rng.choice([-1, 1]) * 10 ** rng.uniform(1, 3)), ("steplen", c.steplen)]
        if c.type < 2:
            setp.append(("stepspace", c.stepspace))
        if c.type == 0:
            setp.append(("dirsetup", c.dirsetup))
        setp.append(("dirhold" if c.type == 0 else "dirdelay", c.dirhold))
        if rng.random() < .5:
            setp += [("maxvel", 10 ** rng.uniform(-1, 2)), ("maxaccel", 10 ** rng.uniform(0, 4))]
        enable, on, rows = [], 1, []
        for k, x in enumerate(wild(rng)):
            on ^= rng.random() < .01
            rows.append(f"{x!r} {int(on and k >= SETTLE)}")
        parts.append(Part("", [(f"stepgen.{n}.{p}", v) for p, v in setp], [],
                          [(f"stepgen.{n}.{'velocity' if c.velocity else 'position'}-cmd", "float"),
                           (f"stepgen.{n}.enable", "bit")],
                          [(f"stepgen.{n}.{p}", "bit") for p in c.pins()] + [(f"stepgen.{n}.counts", "s32")],
                          rows, sample_in="base", cycles=(SERVO_CYCLES - 1) * SERVO_NS // period))
    parts[0].load = (f"stepgen step_type={','.join(str(c.type) for c in channels)} "
                     f"ctrl_type={','.join('pv'[c.velocity] for c in channels)}")
    parts[0].extra = ["addf stepgen.make-pulses base"]
    parts[-1].functions = ["stepgen.capture-position", "stepgen.update-freq"]
    samples = Session(str(seed)).run(parts, threads=f"loadrt threads name1=base period1={period} "
                                                    f"name2=thread period2={SERVO_NS}")
    mistakes = []
    begin = SETTLE * SERVO_NS // period
    for c, rows in zip(channels, samples):
        columns = [[int(v) for v in column] for column in zip(*rows)]
        outs = [column[begin:] for column in columns[:-1]]
        if c.type == 0:
            wrong, net = check_step_dir(c, outs[0], outs[1], period)
        elif c.type == 1:
            wrong, net = check_up_down(c, outs[0], outs[1], period)
        else:
            wrong, net = check_phases(c, [sum(b << i for i, b in enumerate(bits)) for bits in zip(*outs)], period)
        moved = columns[-1][-1] - columns[-1][begin]
        if abs(net - moved) > SERVO_NS // period + 1:
            wrong.append(f"{net} steps, but counts changed by {moved}")
        mistakes += [f"seed {seed}, base {period} ns, {c}: {w}" for w in wrong[:3]]
    return mistakes


if __name__ == "__main__":
    seeds = [int(s) for s in sys.argv[1:]] or range(4)
    found = [mistake for seed in seeds for mistake in run(seed)]
    print("\n".join(found) or "timing kept")
    sys.exit(bool(found))
