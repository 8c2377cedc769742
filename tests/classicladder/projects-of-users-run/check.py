#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ladder projects as users write them, each against a model of its own: timers and counters of a conveyor, a chart of
two pages with branches, subroutines and jumps, arithmetic, floats, files of older forms."""

from __future__ import annotations

import random
import sys

sys.path[:0] = ["../lib"]
# noqa: E402
from clp import (CALL, COIL, COIL_NC, COMPARE, COUNTER, IEC, JUMP, MONOSTABLE, NC, NO, OPERATE, RESET, SET, TIMER, WIRE,
                 bits, block, cell, compare, line, project, row, rung_part, run, step, transition, wide)

R = random.Random(11)
WRONG = 0


def done(what: str, samples, model, rows) -> None:
    global WRONG
    WRONG += compare(what, samples, model, rows)


def spells(count: int, cycles: int, short: int, long: int) -> list[list[int]]:
    """Random inputs that stay for a while: a column each."""
    columns = []
    for _ in range(count):
        column, value = [], 0
        while len(column) < cycles:
            column += [value] * R.randint(short, long)
            value ^= 1
        columns.append(column[:cycles])
    return columns


# ---- a conveyor: latch, timers of both kinds, monostable, counter ----------------------------

def conveyor() -> None:
    assign = {**line(0, 7), **wide(9, 0, OPERATE, 0)}
    rungs = [
        # start, stop with its own contact: %I0 start, %I1 stop, %Q0 runs
        {**row([(NO, "50/0"), (NC, "50/1")], (COIL, "60/0")), **cell(0, 1, NO, "60/0"), **cell(1, 1, WIRE, top=1)},
        # old timer %T0: enable %I0, control %I2
        {**cell(0, 0, NO, "50/0"), **cell(0, 1, NO, "50/2"), **block(2, 0, TIMER, 0, 2), **line(3, 9), **line(3, 9, 1),
         (9, 0): "50-0-60/1", (9, 1): "50-0-60/2"},
        {**cell(0, 0, NO, "50/3"), **block(2, 0, MONOSTABLE, 0, 2), **line(3, 9), (9, 0): "50-0-60/3"},
        # counter: reset %I1, preset %I2, up %I3, down %I4
        {**{k: v for n, i in enumerate((1, 2, 3, 4)) for k, v in cell(0, n, NO, f"50/{i}").items()},
         **block(2, 0, COUNTER, 0, 4), **line(3, 9), **line(3, 9, 1), **line(3, 9, 2), (9, 0): "50-0-60/4",
         (9, 1): "50-0-60/5", (9, 2): "50-0-60/6"},
        # IEC timers: off delay, pulse, on delay
        {**cell(0, 0, NO, "50/5"), **block(2, 0, IEC, 0, 2), **line(3, 9), (9, 0): "50-0-60/7"},
        {**cell(0, 0, NO, "50/6"), **block(2, 0, IEC, 1, 2), **line(3, 9), (9, 0): "50-0-60/8"},
        {**cell(0, 0, NC, "50/6"), **block(2, 0, IEC, 2, 2), **line(3, 9), (9, 0): "50-0-60/9"},
        assign, {**assign, **wide(9, 0, OPERATE, 1)}, {**assign, **wide(9, 0, OPERATE, 2)},
        # what a timer and a counter show elsewhere, and a contact of %T0.R
        row([(NO, "10/0"), (NC, "25/0")], (COIL, "60/10")), row([(NO, "11/0"), (NO, "20/0")], (COIL, "60/11")),
        row([(NO, "15/2")], (COIL_NC, "60/12")),
    ]
    text = project(rungs, {
        "general.txt": ["PERIODIC_REFRESH=1", "SIZE_NBR_RUNGS=100", "SIZE_NBR_BITS=20"],
        "timers.csv": ["2,1", "1,7", "0,1"], "monostables.csv": ["2,2"], "counters.csv": ["4"],
        "timers_iec.csv": ["2,1,1", "2,2,2", "1,1,0"],
        "arithmetic_expressions.csv": ["#VER=2.0", "0000,@280/0@:=@231/0@", "0001,@280/1@:=@251/0@",
                                       "0002,@280/2@=@261/1@*1000+@260/1@"]})

    class Model:
        q0 = t = td = tr = m = mq = before3 = up = down = c = previous = old4 = old3 = 0
        tof = tofv = tofrun = o5 = tp = tpv = tprun = o6 = ton = tonv = 0
        rest = [0, 0, 0]

        def units(self, n, base):
            self.rest[n] += 1
            whole, self.rest[n] = divmod(self.rest[n], base)
            return whole

        def __call__(self, *i):
            i = [int(v) for v in i]
            self.q0 = int((i[0] or self.q0) and not i[1])
            if not i[0]:
                self.t, self.td, self.tr = 100, 0, 0
            elif self.t > 0:
                self.t -= i[2]
                self.td, self.tr = 0, 1
            else:
                self.td, self.tr = 1, 0
            if i[3] and not self.before3 and self.m == 0:
                self.m, self.mq = 200, 1
            if self.m > 0:
                self.m -= 1
            else:
                self.mq = 0
            self.before3 = i[3]
            for new, old, by in ((i[3], self.old3, 1), (i[4], self.old4, -1)):
                if new and not old:
                    self.previous, self.c = self.c, (self.c + by) % 10000
            self.old3, self.old4 = i[3], i[4]
            if i[2]:
                self.previous, self.c = self.c, 4
            if i[1]:
                self.previous, self.c = self.c, 0
            if i[5]:
                self.tof, self.tofv, self.tofrun = 1, 0, 0
            else:
                if self.o5:
                    self.tofrun = 1
                if self.tofrun:
                    self.tofv += self.units(0, 100)
                    if self.tofv >= 1:
                        self.tof = self.tofv = self.tofrun = 0
            self.o5 = i[5]
            if i[6] and not self.o6 and not self.tprun:
                self.tp, self.tpv, self.tprun = 1, 0, 1
            elif self.tprun:
                self.tpv += self.units(1, 100)
                if self.tpv >= 2:
                    self.tp = self.tpv = self.tprun = 0
            self.o6 = i[6]
            if i[6]:
                self.ton = self.tonv = 0
            elif self.tonv < 1:
                self.tonv += self.units(2, 1000)
            else:
                self.ton = 1
            empty, full = self.c == 9999 and self.previous == 0, self.c == 0 and self.previous == 9999
            return [self.q0, self.td, self.tr, self.mq, empty, self.c == 4, full, self.tof, self.tp, self.ton,
                    self.td and self.c != 4, self.tr and self.mq, not self.ton, self.t // 100, self.c,
                    self.tpv * 1000 + 2]
    cycles = 4000
    columns = spells(1, cycles, 60, 300) + spells(1, cycles, 5, 500) + spells(1, cycles, 10, 90) + spells(2, cycles, 1, 120) \
        + spells(1, cycles, 20, 160) + spells(1, cycles, 30, 1500)
    columns[1] = [v if k % 900 < 30 else 0 for k, v in enumerate(columns[1])]
    rows = [" ".join(map(str, values)) for values in zip(*columns)]
    outputs = bits("out", range(13)) + bits("s32out", range(3))
    for name, changed in (("conveyor", text), ("conveyor with lines of DOS", text.replace("\n", "\r\n"))):
        done(name, run(changed, bits("in", range(7)), outputs, rows), Model(), rows)


# ---- a press: sequential chart of two pages ----------------------------------------------------

def press() -> None:
    steps = [step(0, 0, True)] + [step(n) for n in range(1, 6)] + [step(10, 1, True), step(11, 1), step(12, 1)]
    ways = [([0], [1, 2], "50/0", 0), ([1], [3], "50/1", 0), ([2], [4], "50/2", 0), ([3, 4], [0], "50/3", 0),
            ([0], [5], "50/4", 0), ([5], [0], "0/0", 0),
            ([10], [11], "50/5", 1), ([11], [12], "50/5", 1), ([12], [10], "50/6", 1)]
    chart = [";a press", "#VER=1.0", *steps]
    for number, (before, after, condition, page) in enumerate(ways):
        chart += transition(number, before, after, condition, page)
    chart += ["N0,0,3,4,both cylinders, then back"]
    shown = [0, 1, 2, 3, 4, 5, 10, 11, 12]
    rungs = [row([(NC, "50/4")], (COIL, "0/0"))] + [row([(NO, f"30/{x}")], (COIL, f"60/{n}"))
                                                    for n, x in enumerate(shown)]
    rungs += [{**line(0, 7), **wide(9, 0, OPERATE, n)} for n in range(2)]
    last = len(rungs) - 1
    text = project(rungs, {"sequential.csv": chart, "arithmetic_expressions.csv": [
        "#VER=2.0", "0000,@280/0@:=@220/1@", "0001,@280/1@:=@220/11@"],
        "sections.csv": ["#VER=1.0", "#NAME000=Press", "#NAME001=Feeder", "#NAME002=Lamps", "000,1,-1,0,0,0",
                         "001,1,-1,0,0,1", f"002,0,-1,0,{last},0"]})

    class Model:
        active = {0, 10}
        since = {}
        b0 = 0

        def __call__(self, *i):
            values = {f"50/{n}": v for n, v in enumerate(i)} | {"0/0": self.b0}
            for x in self.active:
                self.since[x] = self.since.get(x, 0) + 1
            for page in (0, 1):
                for _ in range(50):
                    changed = False
                    for before, after, condition, where in ways:
                        if where == page and values[condition] and set(before) <= self.active:
                            self.active = self.active - set(before) | set(after)
                            for x in before + after:
                                self.since[x] = 0
                            changed = True
                    if not changed:
                        break
            self.b0 = int(not i[4])
            return [x in self.active for x in shown] + [self.since.get(1, 0) // 1000, self.since.get(11, 0) // 1000]
    cycles = 3000
    columns = spells(5, cycles, 1, 300) + spells(2, cycles, 1, 40)
    for n in (5, 6):
        columns[n][600:2200] = [0] * 1600
    columns[1][700:] = [0] * 2300
    columns[5][700] = 1
    rows = [" ".join(map(str, values)) for values in zip(*columns)]
    done("press", run(text, bits("in", range(7)), bits("out", range(9)) + bits("s32out", range(2)), rows),
         Model(), rows)


# ---- sections, subroutines in subroutines, jumps -----------------------------------------------

def jumps() -> None:
    count = [{**line(0, 7), **wide(9, 0, OPERATE, n)} for n in range(5)]
    main = [row([(NO, "50/0")], (CALL, "0/7")), row([(NO, "50/1")], (JUMP, "0/3")), count[0],
            row([(NO, "50/2")], (CALL, "0/8"))]
    inner, outer = [count[1]], [count[2], row([(NO, "50/3")], (CALL, "0/7"))]
    second = [count[3], row([(NO, "50/4")], (JUMP, "0/99")), count[4]]
    text = project({-1: main, 7: inner, 8: outer}, {"arithmetic_expressions.csv": ["#VER=2.0"] + [
        f"{n:04d},@280/{n}@:=@280/{n}@+1" for n in range(5)]})
    first = len(main + inner + outer)
    text = text.replace("_FILE-rung_0.csv", "".join(
        rung_part(first + n, cells, first + n + 1 if n < 2 else -1) for n, cells in enumerate(second))
        + "_FILE-rung_0.csv", 1)
    text = text.replace("_/FILE-sections.csv", f"003,0,-1,{first},{first + 2},0\n_/FILE-sections.csv")

    class Model:
        n = [0] * 5

        def __call__(self, *i):
            if i[0]:
                self.n[1] += 1
            if not i[1]:
                self.n[0] += 1
            if i[2]:
                self.n[2] += 1
                if i[3]:
                    self.n[1] += 1
            self.n[3] += 1
            if not i[4]:        # a jump to nowhere gives the scan up
                self.n[4] += 1
            return self.n
    rows = [" ".join(map(str, values)) for values in zip(*spells(5, 400, 1, 20))]
    done("subroutines and jumps", run(text, bits("in", range(5)), bits("s32out", range(5)), rows, "numRungs=120"),
         Model(), rows)
    endless = project([count[0], row([(NO, "50/0")], (JUMP, "0/1"))],
                      {"arithmetic_expressions.csv": ["0000,@280/0@:=@280/0@+1"]})
    rows = ["0"] * 5 + ["1"] + ["0"] * 5
    left = iter([1, 2, 3, 4, 5] + [6] * 6)     # outputs hold from there on
    done("an endless jump stops the ladder", run(endless, bits("in", range(1)), bits("s32out", range(1)), rows),
         lambda _: [next(left)], rows)


# ---- arithmetic --------------------------------------------------------------------------------

def trunc(a: int, b: int) -> int:
    return int(a / b) if b else 0


def int32(v: int) -> int:
    return (v + 2**31) % 2**32 - 2**31


def arithmetic() -> None:
    a, b = "@270/0@", "@270/1@"
    forms = [
        (f"{a}+{b}*2", lambda a, b: a + b * 2), (f"({a}+{b})*2", lambda a, b: (a + b) * 2),
        (f"{a}-{b}-1", lambda a, b: a - b - 1), (f"{a}/3", lambda a, b: trunc(a, 3)),
        (f"{a}%7", lambda a, b: a - 7 * trunc(a, 7)), (f"{a}&$0F|{b}", lambda a, b: (a & 15) | b),
        (f"!{a}", lambda a, b: int(not a)), (f"{a}^1", lambda a, b: int32(a * a)), (f"-{a}+-3", lambda a, b: -a - 3),
        ("$FF-'A'", lambda a, b: 255 - 65), (f"ABS({a})", lambda a, b: abs(a)),
        (f"MINI({a},{b},5)", lambda a, b: min(a, b, 5)),
        (f"MAXI({a},{b})", lambda a, b: max(a, b)), (f"MOY({a},{b})", lambda a, b: trunc(a + b, 2)),
        (f"AVG({a},{b},@200/0@)", lambda a, b: trunc(a + b, 3)),
        (f" ( {a} - 1 ) * ( {b} + 1 ) ", lambda a, b: (a - 1) * (b + 1))]
    tests = [("<", lambda a, b: a < b), (">", lambda a, b: a > b), ("=", lambda a, b: a == b),
             ("<=", lambda a, b: a <= b), (">=", lambda a, b: a >= b), ("<>", lambda a, b: a != b)]
    expressions = [f"{n:04d},@200/{n + 1}@:={text}" for n, (text, _) in enumerate(forms)]
    base = len(forms)
    expressions += [f"{base + n:04d},{a}{sign}{b}" for n, (sign, _) in enumerate(tests)]
    copies = base + len(tests)
    expressions += [f"{copies + n:04d},@280/{n}@:=@200/{n + 1}@" for n in range(base)]
    expressions += [f"{copies + base:04d},#not yet"]
    rungs = [{**line(0, 7), **wide(9, 0, OPERATE, n)} for n in range(base)]
    rungs += [{**cell(0, 0, WIRE), **wide(3, 0, COMPARE, base + n), **line(4, 9), (9, 0): f"50-0-60/{n}"}
              for n in range(len(tests))]
    rungs += [{**line(0, 7), **wide(9, 0, OPERATE, copies + n)} for n in range(base)]
    rungs += [{**cell(0, 0, WIRE), **wide(3, 0, COMPARE, number), **line(4, 9), (9, 0): f"50-0-60/{n}"}
              for n, number in ((6, copies + base), (7, 99))]      # a comment and an empty one are false
    text = project(rungs, {"arithmetic_expressions.csv": ["#VER=2.0", *expressions]})
    values = [-100, -7, -1, 0, 1, 2, 7, 100, 12345]
    rows = [f"{x} {y}" for x in values for y in values]

    def model(x, y):
        x, y = int(x), int(y)
        return [f(x, y) for _, f in tests] + [0, 0] + [f(x, y) for _, f in forms[:13]]
    load = "numArithmExpr=120 numWords=40 numS32out=20 numBits=40"
    done("arithmetic", run(text, bits("s32in", range(2)), bits("out", range(8)) + bits("s32out", range(13)), rows,
                           load), model, rows)
    rest = run(text, bits("s32in", range(2)), bits("s32out", range(13, 16)), rows, load)
    done("more arithmetic", rest, lambda x, y: [f(int(x), int(y)) for _, f in forms[13:]], rows)


# ---- floats, symbols, unknown parts, older files -----------------------------------------------

def others() -> None:
    old = ["@310/0@:=@300/0@*2", "@280/0@=@300/1@"]       # expressions by their line, no #VER
    rungs = [{**line(0, 7), **wide(9, 0, OPERATE, n)} for n in range(2)]
    rungs += [row([(NO, "50/0[270/0]")], (COIL, "0/0[270/0]")), row([(NO, "0/2")], (SET, "60/0")),
              row([(NO, "50/0")], (RESET, "60/0")), row([(NO, "75/0")], (COIL, "60/1"))]
    text = project(rungs, {
        "arithmetic_expressions.csv": old, "ioconf.csv": ["#VER=1.0", "0,0,0,0,0,8,0", "1,0,0,0,0,8,0"],
        "symbols.csv": ["#VER=1.0", "%I0,START,the green one", "%Q0,LAMP,"], "plans.txt": ["; of somebody's tool", "x"],
        "modbusioconf.csv": ["#VER=1.0"],
        "com_params.txt": ["MODBUS_MASTER_SERIAL_PORT=/dev/ttyS0", "MODBUS_MASTER_SERIAL_SPEED=19200"]})
    rows = [f"{n / 4 - 3} {n * 1.7 - 9} {n % 3} {int(n % 7 == 0)} {int(n % 5 == 2)} {int(n % 4 == 1)}"
            for n in range(60)]

    class Model:
        q0 = b2 = 0

        def __call__(self, f0, f1, index, i0, i1, i2):
            if index == 2:
                self.b2 = i2
            if self.b2:
                self.q0 = 1
            if i0:
                self.q0 = 0
            return [float(int(f0) * 2), int(f1), self.q0, 0]
    inputs = bits("floatin", range(2)) + bits("s32in", range(1)) + bits("in", range(3))
    outputs = bits("floatout", range(1)) + bits("s32out", range(1)) + bits("out", range(2))
    done("floats, indexes, older expressions", run(text, inputs, outputs, rows), Model(), rows)
    bare = "\n".join(t for t in text.splitlines() if not t.startswith(("#VER", ";Rung"))) + "\n"
    done("without versions and comments", run(bare, inputs, outputs, rows), Model(), rows)
    done("a folder of parts", run(text, inputs, outputs, rows, as_folder=True), Model(), rows)


if __name__ == "__main__":
    conveyor()
    press()
    jumps()
    arithmetic()
    others()
    sys.exit(WRONG != 0)
