#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What users of other libraries had to find out: limiters stand still when their input does,
an axis limiter looks at its enable pins, buttons become on and off pulses for held buttons and
for pushed ones, and a selector out of range selects something defined."""

from __future__ import annotations

import sys

sys.path.insert(0, "..")
from harness import Part, Session  # noqa: E402

failures = 0


def check(what: str, good: bool) -> None:
    global failures
    print(f"{what}: {'yes' if good else 'NO'}")
    failures += not good


def column(samples: list[list[str]], n: int, kind=float) -> list:
    return [kind(row[n]) for row in samples]


N = 3000
limiters = [
    Part(f"limit{order} names=lim{order}", [(f"lim{order}.{k}", v) for k, v in limits], [f"lim{order}"],
         [(f"lim{order}.in", "float")], [(f"lim{order}.out", "float")],
         [f"{7.3 if k < 1000 else -2.1:f} " for k in range(N)])
    for order, limits in ((1, []), (2, [("maxv", 50)]), (3, [("maxv", 50), ("maxa", 300)]))
]
for order, samples in zip((1, 2, 3), Session().run(limiters)):
    out = column(samples, 0)
    check(f"limit{order} reaches its input and stands still",
          set(out[900:1000]) == {7.3} and set(out[2500:]) == {-2.1})

# Two ranges that both hold the feedback; which one counts is told by the enables alone.
enables = [(0, 0), (1, 0), (0, 1), (1, 1), (0, 0)]
rows = [f"{a} {b} " for a, b in enables for _ in range(20)]
part = Part("limit_axis names=la personality=2",
            [("la.min-limit-00", -1), ("la.max-limit-00", 1), ("la.min-range-00", -9), ("la.max-range-00", 9),
             ("la.min-limit-01", -2), ("la.max-limit-01", 2), ("la.min-range-01", -9), ("la.max-range-01", 9)],
            ["la"], [("la.enable-00", "bit"), ("la.enable-01", "bit")],
            [("la.max-output", "float"), ("la.min-output", "float"), ("la.error-no-range", "bit")], rows)
samples = Session().run([part])[0]
ends = [samples[20 * i + 19] for i in range(5)]
check("limit_axis: no range enabled is an error", [int(e[2]) for e in ends] == [1, 0, 0, 0, 1])
check("limit_axis: limits are those of the enabled range",
      [(float(e[1]), float(e[0])) for e in ends[1:4]] == [(-1, 1), (-2, 2), (-1, 1)])

# A held switch: on while closed, off when opened. A pushed button: each push turns over.
for module, pushes, wanted in (("toggle2nist", [(20, 60)], ["on", "off"]),
                               ("momentary2nist", [(20, 30), (60, 70)], ["on", "off"])):
    rows = ["1 " if any(a <= k < b for a, b in pushes) else "0 " for k in range(120)]
    part = Part(f"{module} names=b", [], ["b"], [("b.in", "bit")], [("b.on", "bit"), ("b.off", "bit")], rows)
    # What the pulses switch: a flip-flop.
    part.load += "\nloadrt flipflop names=lamp"
    part.functions.append("lamp")
    part.extra = ["net o0-0 lamp.set", "net o0-1 lamp.reset", "net lit lamp.out b.is-on"]
    part.outputs.append(("lamp.data", "bit"))
    part.outputs.pop()
    samples = Session().run([part])[0]
    on, off = column(samples, 0, int), column(samples, 1, int)
    pulses = [word for k in range(1, 120) for word, row in (("on", on), ("off", off)) if row[k] and not row[k - 1]]
    check(f"{module} makes one pulse per change", pulses == wanted)
    check(f"{module}: pulses end by themselves", not on[-1] and not off[-1] and sum(on) <= 110 and sum(off) <= 110)

# Selectors: every value of 32 bits; out of range the last input counts, always the same one.
selectors = [0, 1, 3, 4, 5, 100, 65536, 2147483647]
mux = Part("mux_generic config=ff4", [(f"mux-gen.00.in-float-{i:02d}", 10 + i) for i in range(4)], ["mux-gen.00"],
           [("mux-gen.00.sel-int", "u32")], [("mux-gen.00.out-float", "float")], [f"{s} " for s in selectors])
samples = Session().run([mux])[0]
check("mux_generic: a selector out of range gives the last input",
      column(samples, 0) == [10 + min(s, 3) for s in selectors])
sys.exit(1 if failures else 0)
