#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""preview_bench.py: what the preview costs. No machine and no display.

Programs of 10,000, 100,000 and 1,000,000 lines (a zigzag surface): seconds of the processor to read one and to prepare
its drawing, memory that it takes, and frames a second of a moving view (exact to 0.7 pixels, into memory at 1024x768;
with OpenGL the card does this part). Each figure in a process of its own; the median of three.
"""
import math
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

top = Path(__file__).resolve().parents[4]
SIZES = (10_000, 100_000, 1_000_000)
WIDTH, HEIGHT, FRAMES = 1024, 768, 40


def write(path, lines):
    with open(path, "w") as f:
        f.write("G21 G90 F3000\nG0 X0 Y0 Z0\n")
        for i in range(lines - 3):
            row, column = divmod(i, 500)
            f.write(f"G1 X{0.4 * (column if row % 2 == 0 else 499 - column):.3f} Y{row * 0.1:.3f} "
                    f"Z{math.sin(i / 60):.3f}\n")
        f.write("M2\n")


def write_crossing(path, lines):
    """The worst that is drawn: lines of 50 mm in all directions on the same place."""
    random.seed(1)
    x = y = 50.0
    with open(path, "w") as f:
        f.write("G21 G90 F3000\nG0 X50 Y50 Z0\n")
        for _ in range(lines - 3):
            while True:
                angle = random.uniform(0, 2 * math.pi)
                to = x + 50 * math.cos(angle), y + 50 * math.sin(angle)
                if 0 <= min(to) and max(to) <= 100:
                    break
            x, y = to
            f.write(f"G1 X{x:.3f} Y{y:.3f} Z{random.uniform(-5, 0):.3f}\n")
        f.write("M2\n")


def memory_mb():
    with open("/proc/self/status") as f:
        return next(int(line.split()[1]) for line in f if line.startswith("VmRSS")) / 1024


def measure(path):
    """Prints seconds to read, seconds to prepare, MB, frames a second."""
    import gcode
    from axis.camera import Camera
    from kerf_raster import Drawing, Raster
    before, begin = memory_mb(), time.process_time()
    program = gcode.load(path, str(Path(path).with_suffix(".var")), ["G21"])
    read = time.process_time() - begin
    drawing = Drawing(program.points, program.kinds, program.lines)
    program.release_path()
    prepared = time.process_time() - begin - read
    mb = memory_mb() - before
    camera, raster = Camera(), Raster(WIDTH, HEIGHT)
    camera.set_view("p")
    camera.fit(*drawing.extents)
    palette = [(255, 255, 255, 255)] * 3 + [(0, 0, 0, 0)]
    begin = time.process_time()
    for _ in range(FRAMES):
        camera.rotate(3, 1)
        matrix = camera.matrix(WIDTH, HEIGHT)
        raster.clear((0, 0, 0, 255))
        raster.draw_drawing(drawing, palette, matrix)
    print(read, prepared, mb, FRAMES / (time.process_time() - begin),
          resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def main():
    with tempfile.TemporaryDirectory() as scratch:
        for size in SIZES:
            path = Path(scratch) / f"{size}.ngc"
            write(path, size)
            rows = []
            for _ in range(3):
                done = subprocess.run([sys.executable, __file__, path], check=True, stdout=subprocess.PIPE, text=True)
                rows.append([float(v) for v in done.stdout.split()])
            read, prepared, mb, frames, most = (statistics.median(column) for column in zip(*rows))
            print(f"{size:8d} lines: read {read:.2f} s, prepared {prepared:.2f} s, {mb:.0f} MB (at most {most:.0f} MB "
                  f"in the process), {frames:.0f} frames/s in memory")


if __name__ == "__main__":
    sys.path.insert(0, str(top / "lib/python"))
    sys.exit(measure(sys.argv[1]) if len(sys.argv) > 1 else main())
