#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""histobinstream and latencybinstream send their bins over a HAL stream when asked."""

from __future__ import annotations

import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

SAMPLES = [0.5, 1.5, 1.5, 2.5, -1.0, 9.0, 3.999, 4.0]       # 4 bins from 0, low and high tail
READ = """
import hal, sys
c = hal.component("reader")
s = hal.stream(c, int(sys.argv[1]), "u")
c.ready()
while (record := s.read()) is not None: print(record[0])
"""
mistakes: list[str] = []


def near(what: str, got: str, want: float) -> None:
    if abs(float(got) - want) > 1e-5 * max(1, abs(want)):
        mistakes.append(f"{what} is {got}, expected {want}")


def session_of(name: str, lines: list[str], rows: list[str], key: int, pins: list[str]) -> tuple[list[int], list[str]]:
    """What came over the stream, and the values of the pins then."""
    session = Session(name)
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            Path(folder, "set-up.hal").write_text("\n".join(lines) + "\n")
            status, _, errors = session.command(folder, "halcmd", "-f", f"{folder}/set-up.hal")
            if status:
                sys.exit(errors)
            session.command(folder, "halstreamer", feed="\n".join(rows) + "\n")
            session.command(folder, "halcmd", "start")
            session.command(folder, "kerf-clock", "sleep", str(len(rows) * 0.001 + 0.01))
            _, text, errors = session.command(folder, "/usr/bin/python3", "-c", READ, str(key))
            values = [session.command(folder, "halcmd", "getp", pin)[1].strip() for pin in pins]
            return [int(n) for n in text.split()], values
        finally:
            session.command(folder, "realtime", "stop")


def histogram(method: int) -> None:
    # The call that clears takes no sample.
    rows = ["100 1 0"] + [f"{x} 0 0" for x in SAMPLES] + [f"{SAMPLES[-1]} 0 1"]
    bins, values = session_of("histogram", [
        "loadrt histobinstream keys=4711", "loadrt threads name1=t", "loadrt streamer depth=50 cfg=fbb",
        "setp histobinstream.0.nbins 4", f"setp histobinstream.0.method {method}",
        "net i0 streamer.0.pin.0 => histobinstream.0.input", "net i1 streamer.0.pin.1 => histobinstream.0.reset",
        "net i2 streamer.0.pin.2 => histobinstream.0.stream", "net ok streamer.0.empty", "addf streamer.0 t",
        "addf histobinstream.0 t"], rows, 4711,
        [f"histobinstream.0.{p}" for p in ("nsamples", "mean", "variance", "input-min", "input-max", "stream-error")])
    if len(bins) != 6:
        mistakes.append(f"histogram {method}: {bins}")
    n = int(values[0])
    if n not in (len(SAMPLES), len(SAMPLES) + 1):
        mistakes.append(f"histogram {method}: {n} samples")
    taken = (SAMPLES + SAMPLES[-1:])[:n]
    wanted = [sum(x < 0 for x in taken)] + [sum(b <= x < b + 1 for x in taken) for b in range(4)] + [
        sum(x >= 4 for x in taken)]
    if bins != wanted:
        mistakes.append(f"histogram {method}: {bins}, expected {wanted} of {taken}")
    near("mean", values[1], statistics.fmean(taken))
    near("variance", values[2], statistics.variance(taken))
    near("input-min", values[3], min(taken))
    near("input-max", values[4], max(taken))
    if values[5] != "FALSE":
        mistakes.append("histogram: stream-error")


def latency() -> None:
    # In virtual time every cycle is exactly on time: all in bin 0.
    rows = ["1 0"] + ["0 0"] * 9 + ["0 1"]
    bins, values = session_of("latency", [
        "loadrt latencybinstream keys=4712", "loadrt threads name1=t", "loadrt streamer depth=50 cfg=bb",
        "setp latencybinstream.0.maxbinnumber 5", "setp latencybinstream.0.nsbinsize 100",
        "net i1 streamer.0.pin.0 => latencybinstream.0.reset", "net i2 streamer.0.pin.1 => latencybinstream.0.stream",
        "addf streamer.0 t", "addf latencybinstream.0 t"], rows, 4712,
        [f"latencybinstream.0.{p}" for p in ("latency", "latency-max", "latency-min", "variance", "stream-error")])
    if len(bins) != 2 * 5 + 3 or bins[:6] != [0] * 6 or not 8 <= bins[6] <= 10 or any(bins[7:]):
        mistakes.append(f"latency: {bins}")
    if values != ["0", "0", "0", "0", "FALSE"]:
        mistakes.append(f"latency: {values}")


if __name__ == "__main__":
    histogram(0)
    histogram(1)
    latency()
    print("\n".join(mistakes) or "all bins arrive")
    sys.exit(bool(mistakes))
