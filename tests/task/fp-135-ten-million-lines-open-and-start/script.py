# SPDX-License-Identifier: GPL-2.0-or-later
import os
import resource

import gcode
from mill import *
from process_sizes import sizes

LINES = 10_000_000
BOUND_KB = 4000              # of more memory than with a program of 1000 lines
HEAD, PAIR, END = "G21 G90 G94 G64 P0.1 F6000\n", "G1X1\nG1X0\n", "M2\n"


def write(name, lines):
    block = PAIR * 5000
    with open(name, "w") as f:
        f.write(HEAD)
        for _ in range(lines // 10000):
            f.write(block)
        f.write(PAIR * (lines % 10000 // 2) + END)
    return str(Path(name).resolve())


def weight():
    """kB of private memory of task."""
    return sum(kb for name, (kb, _) in sizes({"milltask"}).items())


def run(path):
    """Opens and starts a program; (memory after the opening, when 300 lines have been done, the line read at least)."""
    mode(MODE_AUTO)
    c.program_open(path)
    need(lambda s: s.file == path and s.interp_state == INTERP_IDLE, "opening", 120)
    opened = weight()
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line > 2, "start", 60)
    need(lambda s: s.motion_line > 300, "300 lines", 600)
    running, line = weight(), s.read_line
    c.abort()
    need(lambda s: s.interp_state == INTERP_IDLE, "the abort")
    return opened, running, line


def read(path):
    """Reads all of it; (moves, kB of memory at most more than before)."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    p = gcode.load(path, "var", ["G21"], keep_path=False)
    return p.n_moves, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, p.error


on()
short, long = write("short.ngc", 1000), write("long.ngc", LINES)
run(short)
few, many = run(short), run(long)
print("task: memory as with 1000 lines: opened", many[0] - few[0] < BOUND_KB, "running", many[1] - few[1] < BOUND_KB,
      "reads a bounded number of lines ahead:", many[2] < 300 + 5000)
read(short)
moves, more, error = read(long)
print("read whole:", moves, error or "no error", "memory:", more < BOUND_KB or more, messages())
os.remove(long)
