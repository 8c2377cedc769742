# SPDX-License-Identifier: GPL-2.0-or-later
"""Thread latency: how far the times between two wake-ups are from the period.

Realtime part: component latencybinstream in each thread counts latencies (ns) in bins; this
module loads it, asks for its figures once a second and keeps extremes that never shrink.
"""

import argparse
import math
import sys
from dataclasses import dataclass, field

from .. import clock
from .session import SETTLE_S, Platform, each_second, fetch, halcmd, pulse, run_tool

KEY = 22000             # shared memory key of the first stream
MAX_BINS = 1000         # bins that the component has, each side
FIELDS = ("latency-min", "latency-max", "latency-avg", "variance")


@dataclass
class ThreadFigures:
    """Figures of one thread so far; ns."""
    thread: str
    period_ns: int
    bin_ns: int
    bins: int                                    # on each side of zero
    minimum: int | None = None
    maximum: int | None = None
    sdev: float = 0.0
    counts: list[int] = field(default_factory=list)   # low tail, bins from -bins to +bins, high tail

    def update(self, low: int, high: int, variance: float, counts: list[int] | None):
        """Takes new figures; the extremes only ever grow."""
        if low <= high:
            self.minimum = low if self.minimum is None else min(self.minimum, low)
            self.maximum = high if self.maximum is None else max(self.maximum, high)
        self.sdev = math.sqrt(max(variance, 0.0))
        if counts:
            self.counts = counts

    def line(self, elapsed_s: float) -> str:
        low, high = self.minimum or 0, self.maximum or 0
        return (f"{int(elapsed_s):5d} s {self.thread:>6s} min:{low / 1e3:8.3f} us max:{high / 1e3:8.3f} us "
                f"sdev:{self.sdev / 1e3:8.3f} us")


class LatencyMeter:
    """Threads with latencybinstream in them; a component of ours reads the streams."""

    def __init__(self, threads: list[ThreadFigures], name: str = "latency-histogram"):
        import hal
        self.hal = hal
        self.figures = threads
        words = []
        for number, t in enumerate(threads, 1):
            words += [f"name{number}={t.thread}", f"period{number}={t.period_ns}"]
        halcmd("loadrt", "threads", *words)
        halcmd("loadrt", "latencybinstream", f"count={len(threads)}",
               "keys=" + ",".join(str(KEY + i) for i in range(len(threads))))
        self.component = hal.component(name)
        self.component.ready()
        self.streams = {}
        for i, t in enumerate(threads):
            halcmd("addf", f"latencybinstream.{i}", t.thread)
            halcmd("setp", f"latencybinstream.{i}.maxbinnumber", str(t.bins))
            halcmd("setp", f"latencybinstream.{i}.nsbinsize", str(t.bin_ns))
            self.streams[f"latencybinstream.{i}"] = hal.stream(self.component, KEY + i, "u")
        halcmd("start")
        clock.sleep(SETTLE_S)
        self.reset()

    def reset(self):
        """Forgets what was measured."""
        for t in self.figures:
            t.minimum = t.maximum = None
            t.counts = []
        pulse(*(f"{prefix}.reset" for prefix in self.streams))

    def read(self):
        """Fetches the figures of all threads."""
        for t, prefix, counts in zip(self.figures, self.streams, fetch(self.streams)):
            low, high, _, variance = (self.hal.get_p(f"{prefix}.{f}") for f in FIELDS)
            t.update(low, high, variance, counts)

    def lines(self, elapsed_s: float) -> list[str]:
        """Reads, too."""
        self.read()
        return [t.line(elapsed_s) for t in self.figures]

    def close(self):
        self.component.exit()


def options(arguments: list[str]) -> argparse.Namespace:
    p = argparse.ArgumentParser(prog="latency-histogram", allow_abbrev=False,
                                description="Histogram of the latencies of one or two threads.")
    p.add_argument("--base", type=int, default=25000, metavar="ns", help="base period (25000, at least 5000)")
    p.add_argument("--servo", type=int, default=1000000, metavar="ns", help="servo period (1000000, at least 25000)")
    p.add_argument("--bbinsize", type=int, default=100, metavar="ns", help="width of a bin of the base thread (100)")
    p.add_argument("--sbinsize", type=int, default=100, metavar="ns", help="width of a bin of the servo thread (100)")
    p.add_argument("--bbins", type=int, default=200, metavar="n", help="bins of the base thread (200)")
    p.add_argument("--sbins", type=int, default=200, metavar="n", help="bins of the servo thread (200)")
    p.add_argument("--logscale", type=int, default=1, choices=(0, 1), help="counts on a logarithmic scale (1)")
    p.add_argument("--text", default="", help="a note to be shown")
    p.add_argument("--show", action="store_true", help="show counts beyond the bins")
    p.add_argument("--nobase", action="store_true", help="servo thread only")
    p.add_argument("--verbose", action="store_true")
    p.add_argument("--nox", action="store_true", help="no window: a line per second and thread")
    p.add_argument("--seconds", type=int, default=0, metavar="n", help="end after n seconds (0: never)")
    o = p.parse_args(arguments)
    if o.base < 5000:
        p.error(f"--base {o.base}: must be at least 5000 ns")
    if o.servo < 25000:
        p.error(f"--servo {o.servo}: must be at least 25000 ns")
    for name in ("bbinsize", "sbinsize"):
        size = getattr(o, name)
        if size < 10 or size % 10:
            p.error(f"--{name} {size}: must be a multiple of 10 ns")
    for name in ("bbins", "sbins"):
        bins = getattr(o, name)
        if bins < 1:
            p.error(f"--{name} {bins}: must be at least 1")
        if bins > MAX_BINS - 1:
            print(f"latency-histogram: --{name} {bins}: {MAX_BINS - 1} bins are used, the most there are",
                  file=sys.stderr)
            setattr(o, name, MAX_BINS - 1)
    return o


def threads_of(o: argparse.Namespace) -> list[ThreadFigures]:
    """Fastest first, as HAL wants them."""
    servo = ThreadFigures("servo", o.servo, o.sbinsize, o.sbins)
    if o.nobase or o.base >= o.servo:
        return [servo]
    return [ThreadFigures("base", o.base, o.bbinsize, o.bbins), servo]


def main(arguments: list[str]) -> int:
    o = options(arguments)

    def work():
        platform = Platform()
        print(platform.banner(), flush=True)
        if o.text:
            print(o.text)
        meter = LatencyMeter(threads_of(o))
        try:
            if o.nox:
                each_second(meter.lines, o.seconds, 1.0 - 2 * SETTLE_S)
            else:
                from .latency_view import show_histograms
                show_histograms(meter, o, platform)
        finally:
            meter.close()
    return run_tool("latency-histogram", work, own_session=True)
