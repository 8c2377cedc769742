# SPDX-License-Identifier: GPL-2.0-or-later
"""How long the program runs: the planner of motion on paper (kerf-time, a process of its own). No widgets here.

The figures come while the machine is used; until then the sum of lengths by feeds stands for them.
Units: seconds of the machine; overrides 1 = 100 %.
"""

import bisect
import os
import subprocess
import threading
from array import array
from dataclasses import dataclass

SETTLE_S = 0.5           # overrides must rest so long before the times are found out anew
NEAR = 60                # entries beside the present one that a line is looked for in


@dataclass(frozen=True)
class Rates:
    """What the operator may turn while a program runs. max_velocity: machine units a second."""
    feed: float = 1.0
    rapid: float = 1.0
    spindle: float = 1.0
    max_velocity: float = 1e9

    @staticmethod
    def of(stat):
        return Rates(round(stat.feedrate, 3), round(stat.rapidrate, 3), round(stat.spindle[0]["override"], 3),
                     round(stat.max_velocity, 6))

    def words(self):
        """Options of kerf-time; an override of 0 has no end: as if it were 100 %."""
        return ["-f", str(self.feed or 1), "-r", str(self.rapid or 1), "-s", str(self.spindle or 1), "-v",
                str(max(self.max_velocity, 1e-6))]


def between(xs, ys, x):
    """y at x by straight lines between the points; before and behind them the nearest one's. xs do not fall."""
    i = bisect.bisect_right(xs, x) - 1
    if i < 0 or i + 1 == len(xs):
        return ys[max(0, i)] if ys else 0.0
    return ys[i] + (x - xs[i]) / (xs[i + 1] - xs[i]) * (ys[i + 1] - ys[i])


class Times:
    """When moves begin. numbers, lines, seconds: parallel and in order; total: None while not known."""

    def __init__(self, rates):
        self.rates = rates
        self.numbers, self.lines, self.seconds = array("q"), array("q"), array("d")
        self.total = None
        self.complete = False        # total is the program's end
        self.endless = False         # not found in kerf-time's time, at no overrides
        self.reason = ""             # why it is not
        self.waits = None            # tool changes, spindle starts, user codes, waits for inputs, stops

    def read(self, stream):
        for text in stream:
            words = text.split(None, 2)
            if len(words) == 3 and words[0].isdigit():
                self.lines.append(int(words[0]))
                self.numbers.append(int(words[1]))
                self.seconds.append(float(words[2]))
            elif words and words[0] == "waits":
                self.waits = tuple(int(n) for n in text.split()[1:])
            elif words and words[0] in ("end", "stopped", "endless"):
                self.complete, self.endless = words[0] == "end", words[0] == "endless"
                self.total, self.reason = float(words[1]), words[2].strip() if len(words) > 2 else ""

    def number_at(self, seconds):
        return between(self.seconds, self.numbers, seconds)

    def seconds_at(self, number):
        return between(self.numbers, self.seconds, number)

    def place(self, line, seconds):
        """(earliest, latest) time at which this line may run, near `seconds`; None: not known."""
        here = max(0, bisect.bisect_right(self.seconds, seconds) - 1)
        best = None
        for i in range(max(0, here - NEAR), min(len(self.lines), here + NEAR)):
            if self.lines[i] == line or (i + 1 < len(self.lines) and self.lines[i] < line < self.lines[i + 1]):
                first, last = (self.seconds[i],
                               self.seconds[i + 1] if i + 1 < len(self.seconds)
                               else max(self.total or 0.0, self.seconds[i]))
                distance = max(first - seconds, seconds - last, 0.0)
                if best is None or distance < best[0]:
                    best = distance, first, last
        return best[1:] if best else None


class Estimate:
    """The times of one program, and how far it is."""

    def __init__(self, ini_path, waits):
        self.ini_path, self.waits = ini_path, waits
        self.child = self.reader = self.times = self.job = None
        self.at = 0.0            # of the times in use
        self.line = None
        self.last = None         # when follow() looked
        self.wanted, self.wanted_since = None, 0.0

    def start(self, path, init_codes, block_delete, rates):
        """Another program, or the same one from another start."""
        self.cancel()
        self.times, self.at, self.line = None, 0.0, None
        self.job = (path, init_codes, block_delete)
        self.find_out(rates)

    def find_out(self, rates):
        self.cancel()
        self.wanted = rates
        path, init_codes, block_delete = self.job
        words = [word for code in init_codes for word in ("-i", code)]
        try:
            self.child = subprocess.Popen(["nice", "-n", "10", "kerf-time", "-ini", self.ini_path, "-p",
                                           str(os.getpid()), "-b", str(int(block_delete)), *rates.words(),
                                           *self.waits.words(), *words, path],
                                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                          stderr=subprocess.DEVNULL, text=True,
                                          cwd=os.path.dirname(os.path.abspath(self.ini_path)))
        except OSError:
            return                   # the sum of lengths stays
        fresh = Times(rates)

        def read(child):
            fresh.read(child.stdout)
            child.wait()
        self.reader = threading.Thread(target=read, args=(self.child,), daemon=True)
        self.reader.fresh = fresh
        self.reader.start()

    def cancel(self, wait=False):
        """Ends the process; what is known stays."""
        if self.child and self.child.poll() is None:
            self.child.kill()
        if self.reader and wait:
            self.reader.join()
        self.child = self.reader = None          # a reader ends with its process

    def wait(self):
        """Until the times are known."""
        if self.reader:
            self.reader.join()
        self.take()

    def take(self):
        """Uses what the process found out."""
        if self.reader is None or self.reader.is_alive():
            return
        fresh, self.reader, self.child = self.reader.fresh, None, None
        if fresh.total is None:
            return
        if self.times:
            self.at = fresh.seconds_at(self.times.number_at(self.at))
        self.times = fresh

    @property
    def total(self):
        """Seconds of the whole program at the overrides of now, or None."""
        return self.times.total * self.scale() if self.times and self.times.complete else None

    def scale(self):
        """Until the times are found out anew: by the overrides' ratio."""
        known = self.times.rates.feed if self.times else 0
        return known / self.wanted.feed if known and self.wanted and self.wanted.feed else 1.0

    @property
    def remaining(self):
        return max(0.0, self.times.total - self.at) * self.scale() if self.times and self.times.complete else None

    def follow(self, now, rates, running, moving, line):
        """Once in a cycle. now: the machine's clock; moving: the program is neither paused nor held."""
        self.take()
        if self.job is None:
            return
        if rates != self.wanted:
            self.wanted, self.wanted_since = rates, now
        known = self.reader.fresh.rates if self.reader else self.times.rates if self.times else None
        endless = self.reader is None and self.times is not None and self.times.endless
        if (known is not None and known != rates and now - self.wanted_since > SETTLE_S and rates.feed > 0
                and not endless):
            self.find_out(rates)
        passed, self.last = (now - self.last if self.last is not None else 0.0), now
        if not running or self.times is None:
            if not running:
                self.at, self.line = 0.0, None
            return
        if moving:
            self.at = min(self.at + passed / self.scale(), self.times.total)
        if line > 0:
            place = self.times.place(line, self.at)
            if place:
                first, last = place
                self.at = min(max(self.at, first), last)
            self.line = line


def clock_text(seconds):
    """h:mm:ss, without hours that are none."""
    s = int(seconds)
    return f"{s // 3600}:{s // 60 % 60:02d}:{s % 60:02d}" if s >= 3600 else f"{s // 60}:{s % 60:02d}"
