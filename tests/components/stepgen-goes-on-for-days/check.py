#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""stepgen runs over the ends of 32-bit counts and of its 64-bit accumulator, forward, backward
and to and fro, as a channel does that starts at 0: the same pulses in the same ticks, counts
that wrap, and positions that go on."""

from __future__ import annotations

import sys

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

CYCLES, SERVO_NS, BASE_NS = 60, 1000000, 20000
TICKS = CYCLES * SERVO_NS // BASE_NS
RATE = 15000                # steps/s: 15 in a cycle
# Steps made before. A year at 15 kHz is 2^38.8; 2^35 and 2^36 are where the accumulator, in
# units of 2^-28 step, changes sign and wraps.
PRESETS = [0, 2**31 - 400, 2**32 - 400, 2**35 - 400, 2**36 - 400, 2**39 - 400,
           -(2**31) + 400, -(2**35) + 400, -(2**36) + 400]
SPAN_BITS = 32


class TreeSession(Session):
    """With the realtime host of ./tree, which has the module."""

    def command(self, folder: str, *words: str, feed: str | None = None) -> tuple[int, str, str]:
        if words == ("realtime", "start"):
            words = ("tree/bin/rtapi_app", "start")
        return super().command(folder, *words, feed=feed)


def way(cycle: int, sign: int) -> float:
    """Forward, beyond the end that lies 400 steps ahead, and back."""
    return sign * (1 if cycle < 45 else -1)


def wrapped(count: int) -> int:
    return (count + 2**(SPAN_BITS - 1)) % 2**SPAN_BITS - 2**(SPAN_BITS - 1)


def commands(control: str, preset: int, sign: int) -> list[str]:
    speeds = [RATE * way(cycle, sign) for cycle in range(CYCLES)]
    if control == "v":
        return [repr(float(s)) for s in speeds]
    sums = [sum(speeds[:n]) / 1e9 * SERVO_NS for n in range(CYCLES)]
    return [repr(preset + s) for s in sums]


def run(control: str, presets: list[int], sign: int) -> list[list[list[str]]]:
    n = range(len(presets))
    session = TreeSession(f"days{control}")
    rows = [commands(control, p, sign) for p in presets]
    pin = ("velocity" if control == "v" else "position") + "-cmd"
    servo = Part(f"stepgen_days step_type={','.join('0' for _ in n)} ctrl_type={','.join(control for _ in n)} "
                 f"preset={','.join(map(str, presets))}",
                 [(f"stepgen.{i}.{name}", v) for i in n for name, v in (("steplen", BASE_NS), ("stepspace", BASE_NS))],
                 ["stepgen.capture-position", "stepgen.update-freq"],
                 [(f"stepgen.{i}.{pin}", "float") for i in n] + [(f"stepgen.{i}.enable", "bit") for i in n],
                 [x for i in n for x in ((f"stepgen.{i}.counts", "s32"), (f"stepgen.{i}.position-fb", "float"))],
                 [" ".join([*values, *(str(int(cycle > 0)) for _ in n)]) for cycle, values in enumerate(zip(*rows))])
    fast = Part("", [], [], [], [x for i in n for x in ((f"stepgen.{i}.step", "bit"), (f"stepgen.{i}.dir", "bit"))],
                [], cycles=TICKS, extra=["addf stepgen.make-pulses base"], sample_in="base")
    return session.run([servo, fast], SERVO_NS,
                       f"loadrt threads name1=base period1={BASE_NS} name2=thread period2={SERVO_NS}")


def compare(control: str, presets: list[int], sign: int) -> list[str]:
    servo, fast = run(control, [0] + presets, sign)
    mistakes = []
    if len(servo) != CYCLES or len(fast) < TICKS - SERVO_NS // BASE_NS:
        mistakes.append(f"{control}: {len(servo)} cycles and {len(fast)} ticks")
    tops = [max(abs(int(row[0])) for row in servo)]
    if tops[0] < 500:
        mistakes.append(f"{control}: only {tops[0]} steps")
    for channel, preset in enumerate(presets, 1):
        for cycle, row in enumerate(servo):
            counts, position = int(row[2 * channel]), float(row[2 * channel + 1])
            own, at = int(row[0]), float(row[1])
            if counts != wrapped(preset + own) or abs(position - (preset + at)) > 1e-3:
                mistakes.append(f"{control} after {preset} steps, cycle {cycle}: counts {counts} position {position}, "
                                f"from 0: {own} {at}")
                break
        for tick, row in enumerate(fast):
            if row[2 * channel:2 * channel + 2] != row[:2]:
                mistakes.append(f"{control} after {preset} steps, tick {tick}: step and dir {row[2 * channel:][:2]}, "
                                f"from 0: {row[:2]}")
                break
    return mistakes


def main() -> int:
    mistakes = []
    for control in "vp":
        for sign in (1, -1):
            presets = [p for p in PRESETS[1:] if (p > 0) == (sign > 0)]
            mistakes += compare(control, presets, sign)
    print("\n".join(mistakes) or "goes on")
    return bool(mistakes)


if __name__ == "__main__":
    sys.exit(main())
