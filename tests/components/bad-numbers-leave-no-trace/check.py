#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Every recorded component gets values that are not numbers, or infinite, on all its float
inputs in the middle of its recording. At the end its outputs must be numbers again, if
they were numbers in the recording."""

from __future__ import annotations

import sys

sys.path.insert(0, "..")
from harness import HalFailed, Session  # noqa: E402
from replay import batches, read  # noqa: E402

BAD_CYCLES = {60: "nan", 90: "inf", 91: "-inf", 120: "nan", 121: "nan", 122: "inf"}
ARCHIVE = "../recorded-behaviour-is-reproduced/recordings.tar.xz"


def is_number(text: str) -> bool:
    return "nan" not in text and "inf" not in text


def spoil(rows: list[str], inputs: list[tuple[str, str]]) -> list[str]:
    spoiled = list(rows)
    for cycle, bad in BAD_CYCLES.items():
        words = rows[cycle].split()
        spoiled[cycle] = " ".join(bad if kind == "float" else word for word, (_, kind) in zip(words, inputs))
    return spoiled


def main() -> int:
    recordings = [r for r in read(ARCHIVE) if any(kind == "float" for _, kind in r.part.inputs)]
    for recording in recordings:
        recording.part.rows = spoil(recording.part.rows, recording.part.inputs)
    mistakes, checked = [], 0
    for group in batches(recordings):
        try:
            samples = Session().run([r.part for r in group], group[0].thread_ns)
        except HalFailed as error:
            mistakes.append(str(error))
            continue
        for recording, got in zip(group, samples):
            if len(got) < len(recording.outputs):
                mistakes.append(f"{recording.name}: only {len(got)} cycles")
                continue
            for (pin, _), value, was in zip(recording.part.outputs, got[-1], recording.outputs[-1]):
                checked += 1
                if is_number(was) and not is_number(value):
                    mistakes.append(f"{recording.name}: {pin} is {value} after all")
    print("\n".join(mistakes) or "no trace")
    return bool(mistakes) or checked < 500


if __name__ == "__main__":
    sys.exit(main())
