# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs components in a HAL of their own in virtual time: values in, samples out.

Cycle k of the thread takes row k of the inputs; its sample is taken after the
functions. Used by replay.py and by the property tests.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

CHANNELS = 8                # of streamer and sampler
TIMEOUT_S = 100
LETTER = {"float": "f", "bit": "b", "s32": "s", "u32": "u", "s64": "l", "u64": "k"}


@dataclass
class Part:
    """A component under test, with a streamer and a sampler of its own.

    inputs and outputs: (pin, type); rows: a line for halstreamer per cycle;
    functions: run between streamer and sampler, in `thread`.
    """
    load: str
    setp: list[tuple[str, object]]
    functions: list[str]
    inputs: list[tuple[str, str]]
    outputs: list[tuple[str, str]]
    rows: list[str]
    cycles: int = 0
    extra: list[str] = field(default_factory=list)      # more HAL commands, before the start
    sample_in: str = "thread"                           # thread of the sampler

    def __post_init__(self) -> None:
        self.cycles = self.cycles or len(self.rows)


class HalFailed(Exception):
    pass


def script(parts: list[Part], thread_ns: int, threads: str) -> str:
    """HAL commands up to, and without, start."""
    depth = max(max(p.cycles, len(p.rows)) for p in parts) + 50
    feeding = [p for p in parts if p.inputs]
    lines = [f"loadrt {p.load}" for p in parts if p.load]
    lines += [f"setp {name} {value}" for p in parts for name, value in p.setp]
    lines.append(threads or f"loadrt threads name1=thread period1={thread_ns}")
    for module, channels, side in (("streamer", feeding, "inputs"), ("sampler", parts, "outputs")):
        if channels:
            types = ",".join("".join(LETTER[t] for _, t in getattr(p, side)) for p in channels)
            lines.append(f"loadrt {module} depth={','.join([str(depth)] * len(channels))} cfg={types}")
    for channel, part in enumerate(parts):
        if part in feeding:
            source = feeding.index(part)
            lines += [f"net i{channel}-{n} streamer.{source}.pin.{n} => {pin}"
                      for n, (pin, _) in enumerate(part.inputs)]
            lines.append(f"addf streamer.{source} thread")
        lines += [f"net o{channel}-{n} {pin} => sampler.{channel}.pin.{n}"
                  for n, (pin, _) in enumerate(part.outputs)]
        lines += [f"addf {function} thread" for function in part.functions]
        lines += part.extra
        lines.append(f"addf sampler.{channel} {part.sample_in}")
    return "\n".join(lines) + "\n"


class Session:
    """A HAL of its own. Programs write into files, one pair each: a realtime host that they
    start keeps its output open and writes into it later."""

    def __init__(self, name: str = "0"):
        self.env = dict(os.environ, KERF_CLOCK="virtual",
                        KERF_INSTANCE=f"{os.environ.get('KERF_INSTANCE', 'test')}.{name}")
        self.env.pop("KERF_CLOCK_SLOT", None)

    def command(self, folder: str, *words: str, feed: str | None = None) -> tuple[int, str, str]:
        number = len(os.listdir(folder))
        out, err = (os.path.join(folder, f"{number}.{f}") for f in ("out", "err"))
        with open(out, "w") as o, open(err, "w") as e:
            status = subprocess.run(words, stdout=o, stderr=e, env=self.env, timeout=TIMEOUT_S, text=True,
                                    **({"input": feed} if feed is not None else {"stdin": subprocess.DEVNULL})
                                    ).returncode
        return status, Path(out).read_text(), Path(err).read_text()

    def run(self, parts: list[Part], thread_ns: int = 1000000, threads: str = "") -> list[list[list[str]]]:
        """For each part its samples, a list of words per cycle. Raises HalFailed."""
        with tempfile.TemporaryDirectory() as folder:
            commands = os.path.join(folder, "commands.hal")
            Path(commands).write_text(script(parts, thread_ns, threads))
            try:
                self.command(folder, "realtime", "start")
                status, _, errors = self.command(folder, "halcmd", "-f", commands)
                if status:
                    raise HalFailed(f"halcmd: {errors[-300:]}")
                for channel, part in enumerate(p for p in parts if p.inputs):
                    self.command(folder, "halstreamer", "-c", str(channel), feed="\n".join(part.rows) + "\n")
                self.command(folder, "halcmd", "start")
                samples = []
                for channel, part in enumerate(parts):
                    _, text, _ = self.command(folder, "halsampler", "-c", str(channel), "-n", str(part.cycles))
                    samples.append([line.split() for line in text.splitlines() if line != "overrun"])
                return samples
            except subprocess.TimeoutExpired as error:
                raise HalFailed(f"{error.cmd[0]} hangs") from None
            finally:
                self.command(folder, "realtime", "stop")
