#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""axis_load_bench.py [LINES...]: what an operator waits for when AXIS opens a program, in real time, on a display of
its own.

For each size (a zigzag surface, see preview_bench.py): seconds until the program is opened and until it is drawn
exactly, the longest time in which the screen did not answer and the longest that it worked for without a look at its
events (on a loaded machine the first says little), the most memory of the screen and of the processes it started, MB;
the frames a second while the view turns, at first (the screen learns what it can draw in time) and later. The largest
also as lines that cross.
"""
import math
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from preview_bench import SIZES, write, write_crossing

top = Path(__file__).resolve().parents[4]


class Gaps:
    """The longest time between two looks of the screen at its events."""

    def __init__(self, root):
        self.root, self.worst, self.worst_work, self.memory, self.going, self.weighed = root, 0.0, 0.0, 0.0, True, 0.0
        self.last, self.last_work = time.monotonic(), time.thread_time()
        self.look()

    def look(self):
        self.worst, self.worst_work = (max(self.worst, time.monotonic() - self.last),
                                       max(self.worst_work, time.thread_time() - self.last_work))
        if self.going:
            if time.monotonic() - self.weighed > 0.2:        # takes long itself
                self.weighed, self.memory = time.monotonic(), max(self.memory, family_mb(os.getpid()))
            self.last, self.last_work = time.monotonic(), time.thread_time()
            self.root.after(5, self.look)


def family_mb(pid):
    """Memory of a process and those that it started, shared pages counted once (Pss)."""
    total, waiting = 0.0, [pid]
    while waiting:
        pid = waiting.pop()
        try:
            with open(f"/proc/{pid}/smaps_rollup") as f:
                total += next(int(line.split()[1]) for line in f if line.startswith("Pss:")) / 1024
            for task in os.listdir(f"/proc/{pid}/task"):
                with open(f"/proc/{pid}/task/{task}/children") as f:
                    waiting += f.read().split()
        except (OSError, StopIteration):
            pass
    return total


def turn(root, preview, frames=90):
    """Frames a second of the first and of the last thirty of a view that turns, by their median."""
    times = []
    for _ in range(frames):
        begin = time.monotonic()
        preview.camera.rotate(5, 2)
        preview.view_changed()
        root.update()
        times.append(time.monotonic() - begin)
    return 1 / statistics.median(times[:30]), 1 / statistics.median(times[-30:])


def measure(ini_path, sizes):
    import tkinter as tk
    from axis.app import App
    root = tk.Tk(className="Axis")
    app = App(root, ini_path)
    app.start(None)
    for _ in range(20):
        app.tick()
        root.update()
    for writer, size in [*((write, size) for size in sizes), (write_crossing, max(sizes))]:
        path = f"{size}.ngc"
        writer(path, size)
        gaps, begin = Gaps(root), time.monotonic()
        app.open_file_guts(path)
        opened = time.monotonic() - begin
        end = time.monotonic() + 2
        exact = math.inf
        while time.monotonic() < end or exact == math.inf and time.monotonic() < end + 30:
            root.update()
            time.sleep(0.002)
            if app.preview.picture.exact:
                exact = min(exact, time.monotonic() - begin)
        gaps.going = False
        root.update()
        first, later = turn(root, app.preview)
        kind = " that cross" if writer is write_crossing else ""
        print(f"{size:8d} lines{kind}: opened in {opened:.2f} s, drawn exactly after {exact:.2f} s, longest silence "
              f"{gaps.worst * 1000:.0f} ms, longest work {gaps.worst_work * 1000:.0f} ms, {gaps.memory:.0f} MB together, "
              f"turned at {first:.0f} to {later:.0f} frames/s ({app.preview.picture.kind}, "
              f"{app.preview.program.n_moves} moves)", flush=True)
        os.remove(path)
    app.close()
    os._exit(0)


def main(sizes):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "mill"
        shutil.copytree(top / "configs/sim/mill", folder)
        ini = (folder / "mill.ini").read_text().replace("DISPLAY = axis",
                                                        "DISPLAY = ./display").replace("HALUI = halui", "")
        (folder / "mill.ini").write_text(ini)
        (folder / "display").write_text(f"#!/bin/sh\nexec /usr/bin/python3 {Path(__file__).resolve()} measure "
                                        f"{folder}/mill.ini {' '.join(map(str, sizes))} > out 2>&1\n")
        (folder / "display").chmod(0o755)
        done = subprocess.run([top / "tests/lib/with-display", "1024x768", "linuxcnc", "-r", "mill.ini"], cwd=folder,
                              env=dict(os.environ, HOME=scratch), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        print((folder / "out").read_text() if (folder / "out").exists() else done.stdout, end="")
        return done.returncode


if __name__ == "__main__":
    if sys.argv[1:2] == ["measure"]:
        measure(sys.argv[2], [int(n) for n in sys.argv[3:]])
    sys.exit(main([int(n) for n in sys.argv[1:]] or SIZES))
