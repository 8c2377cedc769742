# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes ladder projects (.clp) and runs them scan by scan, for the tests of this folder.

A rung is a dict (x, y) -> cell text; the functions here give cells of one element, to be joined with |.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "components"))
from harness import Part, Session  # noqa: E402

FREE, BLOCK = "0-0-0/0", "99-0-0/0"
Cells = dict[tuple[int, int], str]
# Element codes
NO, NC, RISING, FALLING, WIRE = 1, 2, 3, 4, 9
TIMER, MONOSTABLE, COUNTER, IEC, COMPARE = 10, 11, 12, 13, 20
COIL, COIL_NC, SET, RESET, JUMP, CALL, OPERATE = 50, 51, 52, 53, 54, 55, 60
# Variable types
B, X, I, Q, W = 0, 30, 50, 60, 200


def line(first: int, until: int, y: int = 0) -> Cells:
    """Connections from column first to before until."""
    return {(x, y): "9-0-0/0" for x in range(first, until)}


def cell(x: int, y: int, element: int, variable: str = "0/0", top: int = 0) -> Cells:
    return {(x, y): f"{element}-{top}-{variable}"}


def block(x: int, y: int, element: int, number: int, height: int) -> Cells:
    """A block two cells wide, by its right column."""
    cells = {(c, r): BLOCK for c in (x - 1, x) for r in range(y, y + height)}
    return cells | {(x, y): f"{element}-0-0/{number}"}


def wide(x: int, y: int, element: int, number: int) -> Cells:
    """A comparison or an assignment, by its rightmost cell."""
    return {(x - 2, y): BLOCK, (x - 1, y): BLOCK, (x, y): f"{element}-0-0/{number}"}


def row(contacts: list[tuple[int, str]], coil: tuple[int, str], y: int = 0) -> Cells:
    """Contacts in series, and a coil in the last column."""
    cells = {(x, y): f"{element}-0-{variable}" for x, (element, variable) in enumerate(contacts)}
    return cells | line(len(contacts), 9, y) | {(9, y): f"{coil[0]}-0-{coil[1]}"}


def rung_part(number: int, cells: Cells, following: int, label: str = "") -> str:
    lines = [";Rung", "#VER=2.0", f"#LABEL={label}", "#COMMENT=", f"#PREVRUNG={number - 1}", f"#NEXTRUNG={following}"]
    lines += [" , ".join(cells.get((x, y), FREE) for x in range(10)) for y in range(6)]
    return f"_FILE-rung_{number}.csv\n" + "\n".join(lines) + f"\n_/FILE-rung_{number}.csv\n"


def part(name: str, lines: list[str]) -> str:
    return f"_FILE-{name}\n" + "".join(f"{text}\n" for text in lines) + f"_/FILE-{name}\n"


def step(number: int, page: int = 0, initial: bool = False) -> str:
    return f"S{number},{int(initial)},{number},{page},{number % 16},{number // 16}"


def transition(number: int, before: list[int], after: list[int], condition: str, page: int = 0) -> list[str]:
    def ten(values: list[int]) -> str:
        return ",".join(map(str, (values + [-1] * 10)[:10]))
    return [f"T{number},{ten(after)},{ten(before)},{ten([])},{ten([])},{page},1,1", f"C{number},0,{condition}"]


def project(rungs: list[Cells] | dict[int, list[Cells]], parts: dict[str, list[str]]) -> str:
    """rungs: of one main section, or of several by the number of their subroutine (None: main).
    Parts named in `parts` are added; sections.csv there takes the place of ours."""
    sections = rungs if isinstance(rungs, dict) else {-1: rungs}
    text, first, listed = "", 0, []
    for index, (subroutine, some) in enumerate(sections.items()):
        last = first + len(some) - 1
        listed.append(f"{index:03d},0,{subroutine},{first},{last},0")
        for number, cells in enumerate(some, first):
            text += rung_part(number, cells, -1 if number == last else number + 1)
        first = last + 1
    parts = {"sections.csv": ["#VER=1.0", *listed]} | parts
    return "_FILES_CLASSICLADDER\n" + "".join(part(n, p) for n, p in parts.items()) + text + "_/FILES_CLASSICLADDER\n"


def run(text: str, inputs: list[tuple[str, str]], outputs: list[tuple[str, str]], rows: list[str], load: str = "",
        as_folder: bool = False) -> list[list[str]]:
    """Samples of the outputs, a scan of 1 ms each. Pins are named without `classicladder.0.`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "project.clp"
        if as_folder:
            path.mkdir()
            for piece in text.split("_FILE-")[1:]:
                name, _, body = piece.partition("\n")
                (path / name).write_text(body.split("_/FILE")[0])
        else:
            path.write_bytes(text.encode("latin-1"))

        def pins(some: list[tuple[str, str]]) -> list[tuple[str, str]]:
            return [(f"classicladder.{name}" if "ladder-state" in name else f"classicladder.0.{name}", kind)
                    for name, kind in some]
        work = Part(f"classicladder_rt {load}\nloadusr -w classicladder --nogui {path}", [],
                    ["classicladder.0.refresh"], pins(inputs), pins(outputs), rows)
        return Session().run([work])[0]


def bits(kind: str, numbers: range) -> list[tuple[str, str]]:
    return [(f"{kind}-{n:02d}", {"in": "bit", "out": "bit"}.get(kind, kind[:3] if kind[0] == "s" else "float"))
            for n in numbers]


def compare(what: str, samples: list[list[str]], model, rows: list[str]) -> int:
    """Prints the first differences; their number."""
    mistakes = 0
    for k, got in enumerate(samples):
        want = [str(int(v)) if not isinstance(v, float) else f"{v:.6f}" for v in model(*map(float, rows[k].split()))]
        if got != want:
            mistakes += 1
            if mistakes < 3:
                print(f"{what}: scan {k}, inputs {rows[k]}\n  got      {' '.join(got)}\n  expected {' '.join(want)}")
    print(f"{what}: {len(samples)} scans, {mistakes} wrong")
    return mistakes
