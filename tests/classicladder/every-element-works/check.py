#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a ladder project that has every element, one rung or chart for each, and compares
the outputs of each scan (1 ms) with a model written here."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "../lib")
from clp import Part, Session, line, rung_part  # noqa: E402

CYCLES = 400

def rungs() -> list[dict[tuple[int, int], str]]:
    return [
        {(0, 0): "1-0-50/0", **line(1, 9), (9, 0): "50-0-60/0"},                     # 0 contact
        {(0, 0): "2-0-50/0", **line(1, 9), (9, 0): "51-0-60/1"},                     # 1 NC contact, NC coil
        {(0, 0): "3-0-50/0", **line(1, 9), (9, 0): "50-0-60/2"},                     # 2 rising
        {(0, 0): "4-0-50/0", **line(1, 9), (9, 0): "50-0-60/3"},                     # 3 falling
        {(0, 0): "1-0-50/0", **line(1, 9), (9, 0): "52-0-60/4",                      # 4 set, reset
         (0, 1): "1-0-50/1", **line(1, 9, 1), (9, 1): "53-0-60/4"},
        {(0, 0): "1-0-50/0", (1, 0): "9-0-0/0", **line(2, 9), (9, 0): "50-0-60/5",   # 5 or, joined at column 1
         (0, 1): "1-0-50/1", (1, 1): "9-1-0/0"},
        {(0, 0): "1-0-50/0", (1, 0): "99-0-0/0", (2, 0): "13-0-0/0", (1, 1): "99-0-0/0", (2, 1): "99-0-0/0",
         **line(3, 9), (9, 0): "50-0-60/6"},                                         # 6 IEC timer TON
        {(0, 0): "1-0-50/0", (1, 0): "99-0-0/0", (2, 0): "11-0-0/0", (1, 1): "99-0-0/0", (2, 1): "99-0-0/0",
         **line(3, 9), (9, 0): "50-0-60/7"},                                         # 7 monostable
        {(0, 0): "1-0-50/1", (0, 2): "1-0-50/0", (1, 0): "99-0-0/0", (2, 0): "12-0-0/0",
         **{(x, y): "99-0-0/0" for x in (1, 2) for y in (1, 2, 3)},
         **line(3, 9, 1), (9, 1): "50-0-60/8"},                                      # 8 counter, done output
        {(0, 0): "9-0-0/0", (1, 0): "99-0-0/0", (2, 0): "99-0-0/0", (3, 0): "20-0-0/0", **line(4, 9),
         (9, 0): "50-0-60/9"},                                                       # 9 compare
        {**line(0, 7), (7, 0): "99-0-0/0", (8, 0): "99-0-0/0", (9, 0): "60-0-0/1"},  # 10 operate
        {(0, 0): "1-0-50/1", **line(1, 9), (9, 0): "54-0-0/13"},                     # 11 jump over 12
        {(0, 0): "9-0-0/0", **line(1, 9), (9, 0): "50-0-0/5"},                       # 12 sets %B5
        {(0, 0): "1-0-0/5", **line(1, 9), (9, 0): "50-0-60/10",                      # 13 copies %B5
         (0, 1): "9-0-0/0", **line(1, 9, 1), (9, 1): "53-0-0/5"},
        {(0, 0): "1-0-50/2", **line(1, 9), (9, 0): "55-0-0/3"},                      # 14 call subroutine 3
        {(0, 0): "1-0-30/1", **line(1, 9), (9, 0): "50-0-60/12"},                    # 15 step 1 of the chart
        {(0, 0): "1-0-0/0[200/0]", **line(1, 9), (9, 0): "50-0-60/13"},              # 16 indexed bit
        {(0, 0): "9-0-0/0", **line(1, 7), (7, 0): "99-0-0/0", (8, 0): "99-0-0/0", (9, 0): "60-0-0/2"},   # 17
        {(0, 0): "1-0-30/0", **line(1, 9), (9, 0): "50-0-60/14"},                    # 18 step 0 of the chart
        {(0, 0): "1-0-50/2", (0, 3): "1-0-50/0", (1, 0): "99-0-0/0", (2, 0): "12-0-0/1",
         **{(x, y): "99-0-0/0" for x in (1, 2) for y in (1, 2, 3)},
         **line(3, 9), (9, 0): "50-0-60/15"},                                        # 19 counter, empty output
    ]


def project() -> str:
    parts = rungs()
    last = len(parts) - 1
    subroutine = {(0, 0): "9-0-0/0", **line(1, 9), (9, 0): "50-0-60/11"}
    none = ",".join(["-1"] * 10)
    text = "_FILES_CLASSICLADDER\n"
    text += "_FILE-general.txt\nPERIODIC_REFRESH=1\nSIZE_NBR_RUNGS=100\n_/FILE-general.txt\n"
    text += "_FILE-timers_iec.csv\n2,3,0\n_/FILE-timers_iec.csv\n"              # 0.3 s
    text += "_FILE-monostables.csv\n2,2\n_/FILE-monostables.csv\n"              # 0.2 s
    text += "_FILE-counters.csv\n3\n_/FILE-counters.csv\n"
    text += ("_FILE-arithmetic_expressions.csv\n#VER=2.0\n0000,--@270/0@*2+1>MAXI(7,-(-@270/0@))\n"
             "0001,@280/0@:=(@270/0@+$10)/3-'A'&255|ABS(-1)\n0002,@280/1@=@280/1@+1\n"
             "_/FILE-arithmetic_expressions.csv\n")
    text += ("_FILE-sections.csv\n#VER=1.0\n#NAME000=Main\n#NAME001=Sub\n#NAME002=Chart\n"
             f"000,0,-1,0,{last},0\n001,0,3,{last + 1},{last + 1},0\n002,1,-1,0,0,0\n_/FILE-sections.csv\n")
    for number, cells in enumerate(parts):
        text += rung_part(number, cells, -1 if number == last else number + 1)
    text += rung_part(last + 1, subroutine, -1)
    text += ("_FILE-sequential.csv\n#VER=1.0\nS0,1,0,0,1,1\nS1,0,1,0,1,3\n"
             f"T0,1,-1,-1,-1,-1,-1,-1,-1,-1,-1,0,-1,-1,-1,-1,-1,-1,-1,-1,-1,{none},{none},0,1,2\n"
             f"T1,0,-1,-1,-1,-1,-1,-1,-1,-1,-1,1,-1,-1,-1,-1,-1,-1,-1,-1,-1,{none},{none},0,1,4\n"
             "C0,0,50/1\nC1,0,50/2\nN0,0,1,1,a comment, with a comma\n_/FILE-sequential.csv\n")
    text += "_FILE-symbols.csv\n#VER=1.0\n%I0,START,start button\n_/FILE-symbols.csv\n"
    text += "_FILE-unknown.txt\nwhatever\n_/FILE-unknown.txt\n_/FILES_CLASSICLADDER\n"
    return text


class Model:
    """What the outputs should be; one call of scan() per millisecond."""

    def __init__(self):
        self.i0 = 0
        self.rest = 0                   # ms of a unit of the timer; outlives a restart
        self.latch = self.ton = self.mono = self.mono_value = self.count = self.index_bits = 0
        self.begun = self.down = self.down_before = 0
        self.step = self.b5 = self.steps_word = self.call = 0

    def scan(self, i0: int, i1: int, i2: int, w: int) -> list[int]:
        rising, falling = i0 and not self.i0, not i0 and self.i0
        self.latch = 0 if i1 else (1 if i0 else self.latch)
        ton = i0 and self.ton >= 3
        if not i0:
            self.ton = 0
        elif self.ton < 3:
            self.rest += 1
            self.ton, self.rest = self.ton + self.rest // 100, self.rest % 100
        if rising and self.mono_value == 0:
            self.mono_value, self.mono = 200, 1
        if self.mono_value > 0:
            self.mono_value -= 1
        else:
            self.mono = 0
        if rising:
            self.count += 1
        if i1:
            self.count = 0
        if rising:
            self.down, self.down_before = (self.down or 10000) - 1, self.down
        if i2:
            self.down, self.down_before = 0, self.down
        half = (w + 16) / 3
        quotient = int(half)                            # toward zero
        qw0 = ((quotient - 65) & 255) | 1
        copied = not i1
        if i2:
            self.call = 1
        out = [i0, i0, rising, falling, self.latch, i0 or i1, ton, self.mono, self.count == 3,
               w * 2 + 1 > max(7, w), copied, self.call, self.step == 1, 0, self.begun and self.step == 0,
               self.down == 9999 and self.down_before == 0]
        self.begun = 1          # steps show from the first pass over the chart on
        self.steps_word += 1
        if self.step == 0 and i1:
            self.step = 1
        if self.step == 1 and i2:
            self.step = 0
        self.i0 = i0
        return [int(bool(o)) for o in out] + [qw0, self.steps_word]


def stimulus(k: int) -> tuple[int, int, int, int]:
    i0 = int(10 <= k < 20 or 30 <= k < 33 or 40 <= k < 370)
    i1 = int(25 <= k < 28 or k == 200)
    i2 = int(100 <= k < 103 or k == 210)
    return i0, i1, i2, (k * 7) % 23 - 5


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "project.clp"
        path.write_text(project())
        inputs = [(f"classicladder.0.in-{n:02d}", "bit") for n in range(3)] + [("classicladder.0.s32in-00", "s32")]
        outputs = [(f"classicladder.0.out-{n:02d}", "bit") for n in range(16)]
        outputs += [(f"classicladder.0.s32out-{n:02d}", "s32") for n in range(2)]
        rows = [" ".join(map(str, stimulus(k))) for k in range(CYCLES)]
        part = Part(f"classicladder_rt numPhysOutputs=16\nloadusr -w classicladder --nogui {path}", [],
                    ["classicladder.0.refresh"], inputs, outputs, rows)
        samples = Session().run([part])[0]
    model, mistakes = Model(), 0
    for k, got in enumerate(samples):
        want = model.scan(*stimulus(k))
        if [int(v) for v in got] != want:
            print(f"scan {k}, inputs {stimulus(k)}:\n  got      {' '.join(got)}\n  expected {' '.join(map(str, want))}")
            mistakes += 1
            if mistakes > 3:
                break
    print(f"{len(samples)} scans, {mistakes} wrong")
    return mistakes != 0


if __name__ == "__main__":
    sys.exit(main())
