#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs components cycle by cycle through tables of inputs and expected outputs.

tables.py FILE...      exit status 1 if a row does not hold

A file has sections:

    == WORDS                loads a component: the words of loadrt. Pins below are
                            relative to its first instance (`abs-s32.0.` for abs_s32)
    prefix NAME             other start of the names; `prefix -`: names are complete
    set PIN VALUE ...       before the start
    functions NAME ...      in this order; without it the one named as the prefix
    thread NS               period, 1000000 without it
    :b in0 in1 | :f out     columns: `:` and a letter gives the type of those after it
                            (b bit, f float (at first), s s32, u u32, l s64, k u64)
    0 1 | 1.5               a row for each cycle: inputs, `|`, outputs after it
    3* 0 1 | 2/3            the same three times; values are Python expressions, k is
                            the number of the cycle
    . 1 | .                 `.`: as in the row above; `-` as an output: anything

Tables come from the documentation of the components, not from runs of them. Floats may differ by
2e-6 + 1e-6 of the value.
"""

from __future__ import annotations

import math
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from harness import CHANNELS, HalFailed, Part, Session

SESSIONS = 2                # side by side
TYPES = {"b": "bit", "f": "float", "s": "s32", "u": "u32", "l": "s64", "k": "u64"}
NAMES = {n: getattr(math, n) for n in dir(math) if not n.startswith("_")} | {
    "TRUE": 1, "FALSE": 0, "int": int, "abs": abs, "max": max, "min": min}


@dataclass
class Table:
    where: str
    load: str
    prefix: str
    setp: list[tuple[str, str]] = field(default_factory=list)
    functions: list[str] = field(default_factory=list)
    thread_ns: int = 1000000
    inputs: list[tuple[str, str]] = field(default_factory=list)
    outputs: list[tuple[str, str]] = field(default_factory=list)
    rows: list[str] = field(default_factory=list)
    wanted: list[list[float | None]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    @property
    def module(self) -> str:
        return self.load.split()[0]

    def full(self, name: str) -> str:
        return name if self.prefix == "-" else f"{self.prefix}.{name}"

    def part(self) -> Part:
        return Part(self.load, [(self.full(n), v) for n, v in self.setp], self.functions or [self.prefix],
                    [(self.full(n), t) for n, t in self.inputs], [(self.full(n), t) for n, t in self.outputs],
                    self.rows, cycles=len(self.wanted))

    def value(self, text: str) -> float | int:
        return eval(text, {"__builtins__": {}}, NAMES | {"k": len(self.wanted)})

    def add_columns(self, words: list[str]) -> None:
        kind, columns = "float", self.inputs
        for word in words:
            if word == "|":
                columns = self.outputs
            elif word[0] == ":":
                kind = TYPES[word[1:]]
            else:
                columns.append((word, kind))

    def add_row(self, words: list[str], line: int) -> None:
        times = int(words.pop(0)[:-1]) if re.fullmatch(r"\d+\*", words[0]) else 1
        bar = words.index("|")
        given, wanted = words[:bar], words[bar + 1:]
        if (len(given), len(wanted)) != (len(self.inputs), len(self.outputs)):
            raise ValueError(f"{len(given)} and {len(wanted)} values, "
                             f"{len(self.inputs)} and {len(self.outputs)} columns")
        if "." in given or "." in wanted:
            before_in, before_out = self.rows[-1].split() if self.rows else [], self.wanted[-1]
        for _ in range(times):
            row = []
            for n, (word, (_, kind)) in enumerate(zip(given, self.inputs)):
                value = before_in[n] if word == "." else self.value(word)
                row.append(str(value) if word == "." else repr(float(value)) if kind == "float" else str(int(value)))
            out = [before_out[n] if word == "." else None if word == "-" else self.value(word)
                   for n, word in enumerate(wanted)]
            self.rows.append(" ".join(row))
            self.wanted.append(out)
            self.lines.append(line)


def read(path: str) -> list[Table]:
    tables: list[Table] = []
    for number, line in enumerate(Path(path).read_text().splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        try:
            if words[0] == "==":
                instance = words[1].removeprefix("hal_").replace("_", "-") + ".0"
                tables.append(Table(f"{path}:{number}", " ".join(words[1:]), instance))
                continue
            table = tables[-1]
            if words[0] == "prefix":
                table.prefix = words[1]
            elif words[0] == "set":
                table.setp += list(zip(words[1::2], words[2::2]))
            elif words[0] == "functions":
                table.functions = words[1:]
            elif words[0] == "thread":
                table.thread_ns = int(words[1])
            elif not table.outputs:
                table.add_columns(words)
            else:
                table.add_row(words, number)
        except Exception as error:
            sys.exit(f"{path}:{number}: {error!r} in {line!r}")
    return tables


def batches(tables: list[Table]) -> list[list[Table]]:
    """Groups with one period and without two tables of one module."""
    groups: list[list[Table]] = []
    for table in tables:
        for group in groups:
            if len(group) < CHANNELS and group[0].thread_ns == table.thread_ns \
                    and all(table.module != other.module for other in group):
                group.append(table)
                break
        else:
            groups.append([table])
    return groups


def holds(value: str, wanted: float | None) -> bool:
    if wanted is None:
        return True
    if isinstance(wanted, int) and "." not in value and value[-1].isdigit():
        return int(value) == wanted
    x = float(value)
    if math.isnan(wanted) or math.isinf(wanted):
        return math.isnan(x) if math.isnan(wanted) else x == wanted
    return abs(x - wanted) <= 2e-6 + 1e-6 * abs(wanted)


def compare(table: Table, got: list[list[str]]) -> list[str]:
    path = table.where.split(":")[0]
    for cycle, (values, wanted, line) in enumerate(zip(got, table.wanted, table.lines)):
        wrong = [f"{name} is {value}, expected {want:.10g}" for (name, _), value, want
                 in zip(table.outputs, values, wanted) if not holds(value, want)]
        if wrong:
            return [f"{path}:{line}: {table.load}, cycle {cycle}: {'; '.join(wrong)}"]
    if len(got) < len(table.wanted):
        return [f"{table.where}: {table.load}: {len(got)} cycles, expected {len(table.wanted)}"]
    return []


def run(name: str, group: list[Table]) -> list[str]:
    try:
        samples = Session(name).run([t.part() for t in group], group[0].thread_ns)
    except HalFailed as error:
        if len(group) == 1:
            return [f"{group[0].where}: {group[0].load}: {error}"]
        return [mistake for table in group for mistake in run(name, [table])]
    return [mistake for table, got in zip(group, samples) for mistake in compare(table, got)]


def main(paths: list[str]) -> int:
    groups = batches([table for path in paths for table in read(path)])
    with ThreadPoolExecutor(SESSIONS) as pool:
        results = pool.map(lambda n: [m for g in groups[n::SESSIONS] for m in run(str(n), g)], range(SESSIONS))
    mistakes = sorted(m for result in results for m in result)
    print("\n".join(mistakes) or "all rows hold")
    return bool(mistakes) or not groups


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
