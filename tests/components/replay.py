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
import os
import subprocess
import sys
import tarfile
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

CHANNELS = 8                # of streamer and sampler
SESSIONS = 2                # side by side
TIMEOUT_S = 60
LETTER = {"float": "f", "bit": "b", "s32": "s", "u32": "u", "s64": "l", "u64": "k"}


@dataclass
class Recording:
    name: str
    head: dict
    inputs: list[str]       # a line for halstreamer per cycle
    outputs: list[list[str]]

    @property
    def module(self) -> str:
        return self.head["load"].split()[0]


def parse(name: str, text: str) -> Recording:
    lines = text.splitlines()
    body = [line.split("|") for line in lines[1:] if line]
    return Recording(name, json.loads(lines[0]), [i.strip() for i, _ in body], [o.split() for _, o in body])


def read(path: str) -> list[Recording]:
    if path.endswith(".tar.xz"):
        with tarfile.open(path) as archive:
            return [parse(m.name, archive.extractfile(m).read().decode()) for m in archive if m.isfile()]
    return [parse(Path(path).name, Path(path).read_text())]


def batches(recordings: list[Recording]) -> list[list[Recording]]:
    """Groups without two recordings of one module."""
    groups: list[list[Recording]] = []
    for recording in recordings:
        for group in groups:
            if len(group) < CHANNELS and all(recording.module != other.module for other in group):
                group.append(recording)
                break
        else:
            groups.append([recording])
    return groups


def script(group: list[Recording]) -> str:
    """HAL commands up to, and without, start."""
    depth = max(len(r.outputs) for r in group) + 50
    feeding = [r for r in group if r.head["inputs"]]
    lines = [f"loadrt {r.head['load']}" for r in group]
    lines += [f"setp {name} {value}" for r in group for name, value in r.head["setp"]]
    lines.append(f"loadrt threads name1=thread period1={group[0].head['thread_ns']}")
    for module, channels, side in (("streamer", feeding, "inputs"), ("sampler", group, "outputs")):
        if channels:
            types = ",".join("".join(LETTER[t] for _, t in r.head[side]) for r in channels)
            lines.append(f"loadrt {module} depth={','.join([str(depth)] * len(channels))} cfg={types}")
    for channel, recording in enumerate(group):
        if recording in feeding:
            source = feeding.index(recording)
            lines += [f"net i{channel}-{n} streamer.{source}.pin.{n} => {pin}"
                      for n, (pin, _) in enumerate(recording.head["inputs"])]
            lines.append(f"addf streamer.{source} thread")
        lines += [f"net o{channel}-{n} {pin} => sampler.{channel}.pin.{n}"
                  for n, (pin, _) in enumerate(recording.head["outputs"])]
        lines += [f"addf {function} thread" for function in recording.head["functions"]]
        lines.append(f"addf sampler.{channel} thread")
    return "\n".join(lines) + "\n"


def near(a: str, b: str) -> bool:
    if a == b:
        return True
    try:
        x, y = float(a), float(b)
    except ValueError:
        return False
    return abs(x - y) <= 2e-6 + 1e-6 * abs(x)


def compare(recording: Recording, lines: list[str]) -> str:
    """"" or the first difference."""
    got = [line.split() for line in lines if line != "overrun"]
    for cycle, (values, wanted) in enumerate(zip(got, recording.outputs)):
        for (pin, _), value, want in zip(recording.head["outputs"], values, wanted):
            if not near(want, value):
                return f"cycle {cycle}: {pin} is {value}, expected {want}"
    if len(got) < len(recording.outputs):
        return f"{len(got)} cycles, expected {len(recording.outputs)}"
    return ""


class Session:
    """A HAL of its own. Programs write into files: a realtime host that they start
    keeps a pipe open."""

    def __init__(self, number: int, folder: str):
        self.folder = folder
        self.env = dict(os.environ, KERF_CLOCK="virtual",
                        KERF_INSTANCE=f"{os.environ.get('KERF_INSTANCE', 'replay')}.{number}")
        self.env.pop("KERF_CLOCK_SLOT", None)

    def run(self, *words: str, feed: str | None = None) -> tuple[int, str, str]:
        out, err = (os.path.join(self.folder, f) for f in ("out", "err"))
        with open(out, "w") as o, open(err, "w") as e:
            status = subprocess.run(words, stdout=o, stderr=e, env=self.env, timeout=TIMEOUT_S, text=True,
                                    **({"input": feed} if feed is not None else {"stdin": subprocess.DEVNULL})
                                    ).returncode
        return status, Path(out).read_text(), Path(err).read_text()

    def replay(self, group: list[Recording]) -> list[str]:
        """"" or what is wrong, for each recording."""
        commands = os.path.join(self.folder, "commands.hal")
        Path(commands).write_text(script(group))
        try:
            self.run("realtime", "start")
            status, _, errors = self.run("halcmd", "-f", commands)
            if status:
                return [f"halcmd: {errors[-300:]}"] * len(group)
            feeding = [r for r in group if r.head["inputs"]]
            for channel, recording in enumerate(feeding):
                self.run("halstreamer", "-c", str(channel), feed="\n".join(recording.inputs) + "\n")
            self.run("halcmd", "start")
            results = []
            for channel, recording in enumerate(group):
                _, lines, _ = self.run("halsampler", "-c", str(channel), "-n", str(len(recording.outputs)))
                results.append(compare(recording, lines.splitlines()))
            return results
        except subprocess.TimeoutExpired as error:
            return [f"{error.cmd[0]} hangs"] * len(group)
        finally:
            self.run("realtime", "stop")


def main(paths: list[str]) -> int:
    recordings = [recording for path in paths for recording in read(path)]
    groups = batches(recordings)

    def work(number: int) -> list[tuple[str, str]]:
        found = []
        with tempfile.TemporaryDirectory() as folder:
            for group in groups[number::SESSIONS]:
                results = Session(number, folder).replay(group)
                if any(results) and len(group) > 1:     # one may have disturbed the others
                    results = [Session(number, folder).replay([r])[0] for r in group]
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
