#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Replays recordings of components in HAL and compares every cycle.

replay.py FILE...     FILE: a .vec file, or an archive of them (.tar.xz)

A recording's first line is JSON: `load` (words of loadrt), `setp` (before the start),
`functions` (added to one thread of `thread_ns` between a streamer, which feeds the
inputs, and a sampler, which takes the outputs), `inputs` and `outputs` (name, type). Then one
line a cycle: inputs | outputs. Floats have six decimals: they may differ by 2e-6 + 1e-6
of the value.

Up to eight recordings of different components run in one HAL, in virtual time, and two
such sessions side by side. Exit status 1 if a recording was not reproduced.
"""

from __future__ import annotations

import json
import sys
import tarfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from harness import CHANNELS, HalFailed, Part, Session

SESSIONS = 2                # side by side


@dataclass
class Recording:
    name: str
    thread_ns: int
    part: Part
    outputs: list[list[str]]

    @property
    def module(self) -> str:
        return self.part.load.split()[0]


def parse(name: str, text: str) -> Recording:
    lines = text.splitlines()
    head = json.loads(lines[0])
    body = [line.split("|") for line in lines[1:] if line]
    part = Part(head["load"], head["setp"], head["functions"], head["inputs"], head["outputs"],
                [i.strip() for i, _ in body])
    return Recording(name, head["thread_ns"], part, [o.split() for _, o in body])


def read(path: str) -> list[Recording]:
    if path.endswith(".tar.xz"):
        with tarfile.open(path) as archive:
            return [parse(m.name, archive.extractfile(m).read().decode()) for m in archive if m.isfile()]
    return [parse(Path(path).name, Path(path).read_text())]


def batches(recordings: list[Recording]) -> list[list[Recording]]:
    """Groups with one period and without two recordings of one module."""
    groups: list[list[Recording]] = []
    for recording in recordings:
        for group in groups:
            if len(group) < CHANNELS and group[0].thread_ns == recording.thread_ns \
                    and all(recording.module != other.module for other in group):
                group.append(recording)
                break
        else:
            groups.append([recording])
    return groups


def near(a: str, b: str) -> bool:
    if a == b:
        return True
    try:
        x, y = float(a), float(b)
    except ValueError:
        return False
    return abs(x - y) <= 2e-6 + 1e-6 * abs(x)


def compare(recording: Recording, got: list[list[str]]) -> str:
    """"" or the first difference."""
    for cycle, (values, wanted) in enumerate(zip(got, recording.outputs)):
        for (pin, _), value, want in zip(recording.part.outputs, values, wanted):
            if not near(want, value):
                return f"cycle {cycle}: {pin} is {value}, expected {want}"
    if len(got) < len(recording.outputs):
        return f"{len(got)} cycles, expected {len(recording.outputs)}"
    return ""


def replay(name: str, group: list[Recording]) -> list[str]:
    """"" or what is wrong, for each recording."""
    try:
        samples = Session(name).run([r.part for r in group], group[0].thread_ns)
    except HalFailed as error:
        return [str(error)] * len(group)
    return [compare(r, s) for r, s in zip(group, samples)]


def main(paths: list[str]) -> int:
    groups = batches([recording for path in paths for recording in read(path)])

    def work(number: int) -> list[tuple[str, str]]:
        found = []
        for group in groups[number::SESSIONS]:
            results = replay(str(number), group)
            if any(results) and len(group) > 1:     # one may have disturbed the others
                results = [replay(str(number), [r])[0] for r in group]
            found += [(r.name, result) for r, result in zip(group, results)]
        return found

    with ThreadPoolExecutor(SESSIONS) as pool:
        results = [one for part in pool.map(work, range(SESSIONS)) for one in part]
    for name, result in sorted(results):
        if result:
            print(f"{name}: {result}")
    good = sum(not result for _, result in results)
    print(f"{good} of {len(results)} recordings reproduced")
    return good != len(results)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
