#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Speed and memory of rs274 and of the gcode module on five kinds of programs.

usage: rs274-bench.py [LINES [COMMAND...]]   (COMMAND: another rs274 to measure, e.g. one before a change)
Prints, for each kind: lines executed a second, peak memory of the process (at least this script's own). Then the same
for gcode.load on short lines. Numbers are of this machine and load: compare runs made together.
"""
import os
import random
import subprocess
import sys
import tempfile
import time

LINES = int(sys.argv[1]) if len(sys.argv) > 1 else 200000
COMMAND = sys.argv[2:] or ["rs274"]


def short_lines(n):
    r = random.Random(1)
    yield "G21 G90 F1000"
    for _ in range(n):
        yield f"G1 X{r.uniform(0, 100):.3f} Y{r.uniform(0, 100):.3f}"


def arcs(n):
    yield "G21 G91 F1000"
    for i in range(n):
        yield f"G{2 + i % 2} X{i % 7 + 1} Y1 R{i % 7 + 9}.5" if i % 3 else f"G3 X2 Y0 I1 J0 Z.{i % 10}"


def loops(n):
    yield "G21 G91 F1000"
    yield "o1 sub"
    yield "o2 if [#1 gt 2]"
    yield "G1 X#1 Y#2"
    yield "o2 else"
    yield "G1 X-#1 Y-#2"
    yield "o2 endif"
    yield "o1 endsub"
    yield f"o3 repeat [{n // 8}]"
    yield "#5=[#5+1]"
    yield "o1 call [#5 mod 5] [2]"
    yield "o3 endrepeat"


def expressions(n):
    yield "G21 G90 F1000"
    yield "#1=1"
    for i in range(n):
        yield f"#<v{i % 9}>=[#1*{i % 13}.5 + sin[{i % 360}]] G1 X[#1+cos[{i % 360}]*{i % 20}] Y[[#1+2]**2/3 mod 7]"


def cycles(n):
    yield "G21 G90 F1000 M3 S100"
    yield "G99 G83 X0 Y0 Z-3 R2 Q1"
    for i in range(n):
        yield f"X{i % 100} Y{i % 17}"


def measure(command, path):
    start = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    return time.monotonic() - start, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, status


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        open("t.tbl", "w").close()
        for kind in (short_lines, arcs, loops, expressions, cycles):
            with open("p.ngc", "w") as f:
                f.writelines(line + "\n" for line in kind(LINES))
                f.write("M2\n" if kind is not cycles else "G80\nM2\n")
            wall, cpu, mb, status = measure([*COMMAND, "-t", "t.tbl", "-v", "p.var", "-g", "p.ngc"], "p.ngc")
            print(f"rs274 {kind.__name__:12} {LINES / cpu:10.0f} lines/s of CPU  {wall:6.2f} s  {mb:6.1f} MB  "
                  f"{'' if status == 0 else 'FAILED'}")
            if kind is short_lines and len(sys.argv) < 3:
                code = "import gcode; p = gcode.load('p.ngc'); print(len(p.lines))"
                wall, cpu, mb, status = measure(["/usr/bin/python3", "-c", code], "p.ngc")
                print(f"gcode {kind.__name__:12} {LINES / cpu:10.0f} lines/s of CPU  {wall:6.2f} s  {mb:6.1f} MB  "
                      f"{'' if status == 0 else 'FAILED'}")


main()
