# SPDX-License-Identifier: GPL-2.0-or-later
"""latency-plot: a moving chart of the latencies of the base and servo thread."""

import argparse
import time
from collections import deque

from .. import clock
from .session import Platform, halcmd, measuring, run_tool

POINTS = 600   # that are kept


class IntervalTrace:
    """Largest latency of each thread since the look before, and since the start or reset().

    rows[name]: (time of day in s, latency in us, the largest so far in us), the newest last.
    """

    def __init__(self, threads: list[tuple[str, int]]):
        import hal
        self.hal, self.threads, self.start, self.count = hal, threads, time.time(), 0
        self.rows = {name: deque(maxlen=POINTS) for name, _ in threads}
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
        self.count += 1
        for n, (name, period) in enumerate(self.threads):
            latency = max(self.hal.get_p(f"timedelta.{n}.max") - period, period - self.hal.get_p(f"timedelta.{n}.min"))
            self.worst[name] = max(self.worst[name], latency)
            self.rows[name].append((time.time(), latency / 1000, self.worst[name] / 1000))
            self.hal.set_p(f"timedelta.{n}.reset", "1")
        clock.sleep(0.005)
        for n in range(len(self.threads)):
            self.hal.set_p(f"timedelta.{n}.reset", "0")

    def reset(self):
        """The largest latencies are those from now on."""
        self.worst = dict.fromkeys(self.worst, 0)

    def line(self) -> str:
        return "  ".join(f"{name}: last {self.rows[name][-1][1] * 1000:.0f} worst deviation {self.worst[name]} ns"
                         for name, _ in self.threads)


def options(arguments: list[str]) -> argparse.Namespace:
    p = argparse.ArgumentParser(prog="latency-plot", add_help=False, allow_abbrev=False,
                                description="Strip chart of thread latencies.")
    p.add_argument("-b", "--base", type=int, default=25000, metavar="ns", help="base period (25000)")
    p.add_argument("-s", "--servo", type=int, default=1000000, metavar="ns", help="servo period (1000000)")
    p.add_argument("-t", "--time", type=int, default=1000, metavar="ms",
                   help="time between points (1000; 100 to 10000)")
    kind = p.add_mutually_exclusive_group()
    kind.add_argument("--relative", action="store_true", default=True, help="times since the start (default)")
    kind.add_argument("--actual", dest="relative", action="store_false", help="times of day")
    p.add_argument("-H", "--hal", action="store_true", help="nothing: accepted as ever")
    p.add_argument("--nox", action="store_true", help="no window: a line per point")
    p.add_argument("--points", type=int, default=0, metavar="n", help="end after n points (0: never)")
    p.add_argument("-h", "-?", "--help", action="help", help="this text")
    o = p.parse_args(arguments)
    if not 100 <= o.time <= 10000:
        p.error(f"--time {o.time}: must be 100 to 10000 ms")
    if o.base < 5000 or o.servo < o.base:
        p.error("periods must be at least 5000 ns, and the servo period not below the base period")
    return o


def print_lines(trace: IntervalTrace, o: argparse.Namespace):
    while not o.points or trace.count < o.points:
        clock.sleep(o.time / 1000)
        with measuring():
            trace.sample()
        print(trace.line(), flush=True)


def main(arguments: list[str]) -> int:
    o = options(arguments)

    def work():
        banner = Platform().banner()
        trace = IntervalTrace(([("base", o.base)] if o.base < o.servo else []) + [("servo", o.servo)])
        if o.nox:
            print(banner, flush=True)
            print_lines(trace, o)
        else:
            from .strip_chart import show_strips
            show_strips(trace, o, banner)
    return run_tool("latency-plot", work, own_session=True)
