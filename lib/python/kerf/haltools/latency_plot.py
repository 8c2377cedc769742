# SPDX-License-Identifier: GPL-2.0-or-later
"""latency-plot: a moving chart of the intervals of the base and servo thread. Times are ns."""

import argparse
import sys
from collections import deque

from .. import clock
from .session import Platform, RealtimeSession, ToolError, halcmd

POINTS = 300   # of a chart


class IntervalTrace:
    """Largest deviation (or interval) of each thread in each of the last POINTS looks."""

    def __init__(self, threads: list[tuple[str, int]], relative: bool):
        import hal
        self.hal, self.threads, self.relative = hal, threads, relative
        self.values = {name: deque(maxlen=POINTS) for name, _ in threads}
        self.worst = {name: 0 for name, _ in threads}
        words = []
        for n, (name, period) in enumerate(threads, 1):
            words += [f"name{n}={name}", f"period{n}={period}"]
        halcmd("loadrt", "threads", *words)
        halcmd("loadrt", "timedelta", f"count={len(threads)}")
        for n, (name, _) in enumerate(threads):
            halcmd("addf", f"timedelta.{n}", name)
        halcmd("start")

    def sample(self):
        """One look: the extremes since the last one; then they start anew."""
        for n, (name, period) in enumerate(self.threads):
            high = self.hal.get_p(f"timedelta.{n}.max")
            low = self.hal.get_p(f"timedelta.{n}.min")
            deviation = max(high - period, period - low)
            self.worst[name] = max(self.worst[name], deviation)
            self.values[name].append(deviation if self.relative else high)
            self.hal.set_p(f"timedelta.{n}.reset", "1")
        clock.sleep(0.005)
        for n in range(len(self.threads)):
            self.hal.set_p(f"timedelta.{n}.reset", "0")

    def line(self) -> str:
        return "  ".join(f"{name}: last {self.values[name][-1]} worst deviation {self.worst[name]} ns"
                         for name, _ in self.threads)


def options(arguments: list[str]) -> argparse.Namespace:
    p = argparse.ArgumentParser(prog="latency-plot", add_help=False, allow_abbrev=False,
                                description="Strip chart of thread intervals.")
    p.add_argument("-b", "--base", type=int, default=25000, metavar="ns", help="base period (25000)")
    p.add_argument("-s", "--servo", type=int, default=1000000, metavar="ns", help="servo period (1000000)")
    p.add_argument("-t", "--time", type=int, default=1000, metavar="ms", help="time between points (1000; 100 to 10000)")
    kind = p.add_mutually_exclusive_group()
    kind.add_argument("--relative", action="store_true", default=True, help="deviation from the period (default)")
    kind.add_argument("--actual", dest="relative", action="store_false", help="interval")
    p.add_argument("--nox", action="store_true", help="no window: a line per point")
    p.add_argument("--points", type=int, default=0, metavar="n", help="end after n points (0: never)")
    p.add_argument("-h", "-H", "--hal", "--help", action="help", help="this text")
    o = p.parse_args(arguments)
    if not 100 <= o.time <= 10000:
        p.error(f"--time {o.time}: must be 100 to 10000 ms")
    if o.base < 5000 or o.servo < o.base:
        p.error("periods must be at least 5000 ns, and the servo period not below the base period")
    return o


def print_lines(trace: IntervalTrace, o: argparse.Namespace):
    count = 0
    while not o.points or count < o.points:
        clock.sleep(o.time / 1000)
        trace.sample()
        print(trace.line(), flush=True)
        count += 1


def main(arguments: list[str]) -> int:
    o = options(arguments)
    clock.join("latency-plot")
    try:
        with RealtimeSession():
            platform = Platform()
            threads = [("base", o.base)] if o.base < o.servo else []
            trace = IntervalTrace(threads + [("servo", o.servo)], o.relative)
            try:
                if o.nox:
                    print(platform.banner(), flush=True)
                    print_lines(trace, o)
                else:
                    from .latency_view import show_strips
                    show_strips(trace, o, platform, POINTS)
            except KeyboardInterrupt:
                pass
    except ToolError as problem:
        print(f"latency-plot: {problem}", file=sys.stderr)
        return 1
    finally:
        clock.leave()
    return 0
