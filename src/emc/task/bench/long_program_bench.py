# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-135: a program of LINES lines (10,000,000), as a surface is milled, is run to its end in virtual time.

Run by tests/task/lib/machine-test as the display of the sample mill. Tells how long opening and starting take, lines a
second of wall time, and the memory of task and of the realtime part at twenty places. Ends with status 1 when it grows.
"""
import math
import os
import sys
import time
from pathlib import Path

from mill import *
from process_sizes import weigh
from session import processes

LINES = int(os.environ.get("LINES", "10000000"))
POINTS, STEP = 2000, 0.1     # of a row; mm
PLACES, BOUND_KB = 20, 2000  # of growth from the first place to the last
report = open(os.environ["REPORT"], "w", buffering=1)


def write(name):
    """Rows there and back, with the third dimension of a wave; every line is a move."""
    wave = [f"X{i * STEP:.3f}Z{60 + 3 * math.sin(i / 80):.4f}\n" for i in range(1, POINTS)]
    there, back = "".join(wave), "".join(reversed(wave))
    left, row = LINES - 4, 0
    with open(name, "w") as f:
        f.write("G21 G90 G17 G94 G64 P0.01 Q0\nG0 X0 Y0 Z60\nG1 F6000\n")
        while left > 0:
            lines = f"Y{row % 400 * 0.25:.3f}\n" + (back if row % 2 else there)
            if left < POINTS:
                lines = "".join(lines.splitlines(True)[:left])
            f.write(lines)
            left -= POINTS
            row += 1
        f.write("M2\n")
    return str(Path(name).resolve())


def tell(*words):
    print(*words, file=report)


def look():
    """{program: (kB of private memory, seconds of CPU)}"""
    found = {}
    for name in ("milltask", "rtapi_app"):
        for pid in processes(name):
            used = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[11:13]
            found[name] = (weigh(Path(f"/proc/{pid}"))[0], sum(map(int, used)) / os.sysconf("SC_CLK_TCK"))
    return found


path = write("long.ngc")
tell("lines", LINES, "bytes", os.path.getsize(path))
on()
mode(MODE_AUTO)
begin = time.monotonic()
c.program_open(path)
need(lambda s: s.file == path and s.state == RCS_DONE, "opening", 1000)
opened = time.monotonic()
c.auto(AUTO_RUN, 0)
need(lambda s: s.motion_line > 2, "start", 60)
started = time.monotonic()
tell(f"opened in {opened - begin:.2f} s, moves {started - opened:.2f} s after the start")
seen = [look()]
for place in range(1, PLACES + 1):
    until(lambda s: s.motion_line >= LINES * place // (PLACES + 1) or s.interp_state == INTERP_IDLE, 1e7, 0.5)
    seen.append(look())
    line, wall = s.motion_line, time.monotonic() - started
    tell(f"line {line:9d}  {wall:8.1f} s  {line / wall:8.0f} lines/s  virtual {clock.now():8.1f} s ",
         "  ".join(f"{name} {kb} kB {(cpu - seen[0][name][1]) / line * 1e6:.1f} us of CPU a line"
                   for name, (kb, cpu) in seen[-1].items()))
need(lambda s: s.interp_state == INTERP_IDLE, "end", 1e7)
grown = {name: seen[-1][name][0] - seen[1][name][0] for name in seen[1]}
tell(f"end after {time.monotonic() - started:.1f} s; kB grown from the first place to the last: {grown}", messages())
os.remove(path)
sys.exit(any(kb > BOUND_KB for kb in grown.values()))
