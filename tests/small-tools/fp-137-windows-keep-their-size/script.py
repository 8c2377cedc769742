# SPDX-License-Identifier: GPL-2.0-or-later
# The status viewer in front of a busy machine, and the chart of latencies: thousands of looks, and their
# memory stays what it was. What leaks grows with each look.
import random
import tkinter
from collections import deque
from types import SimpleNamespace

from kerf.haltools.latency_plot import POINTS, IntervalTrace
from kerf.haltools.strip_chart import show_strips
from kerf.tktools import linuxcnctop
from mill import *

LOOKS = 700


def private_kb():
    lines = Path("/proc/self/smaps_rollup").read_text().splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith("Private_"))


def judge(what, sizes):
    """Sizes after each third: the last third adds nothing worth naming."""
    print(f"{what}: {'grows ' + str(sizes) if sizes[2] - sizes[1] > 300 else 'keeps its size'}")


on()
program("o1 while [1]\nG0 X1\nG1 F6000 X0 Y1\nG1 Y0\n(MSG, round)\no1 endwhile\nM2\n")
c.auto(AUTO_RUN, 0)
root = tkinter.Tk()
window = linuxcnctop.Window(root, s)
root.after_cancel(window.timer)
sizes = []
for n in range(1, 3 * LOOKS + 1):
    sleep(0.01)
    poll()
    window.update()
    root.update()
    e.poll()
    if n % LOOKS == 0:
        sizes.append(private_kb())
judge("linuxcnctop", sizes)
root.destroy()
c.abort()


class Intervals(IntervalTrace):
    """With numbers in place of two realtime threads."""

    def __init__(self):
        self.threads, self.start, self.count, self.sizes = [("base", 25000), ("servo", 1000000)], 0, 0, []
        self.rows = {name: deque(maxlen=POINTS) for name, _ in self.threads}
        self.worst = dict.fromkeys(self.rows, 0)

    def sample(self):
        self.count += 1
        for name, rows in self.rows.items():
            latency = random.randrange(100000)
            self.worst[name] = max(self.worst[name], latency)
            rows.append((self.count, latency / 1000, self.worst[name] / 1000))
        if self.count % LOOKS == 0:
            self.sizes.append(private_kb())


trace = Intervals()
show_strips(trace, SimpleNamespace(relative=True, points=3 * LOOKS, time=1), "no machine")
judge("latency-plot", trace.sizes)
