#!/usr/bin/python3
import math
import time

import gcode
import numpy as np
from axis.camera import Camera
from kerf.glpath import PLOT_RECORD
from kerf_raster import Drawing, Raster


def write(name, lines):
    with open(name, "w") as f:
        f.write("\n".join(["G21 G90 F3000", "G0 X0 Y0 Z0", *lines, "M2", ""]))
    return name


def load(name, **other):
    return gcode.load(name, "var", ["G21"], **other)


def furthest(path, kept):
    """Greatest distance of a left-out vertex from the straight piece that stands for it."""
    worst = 0.0
    for a, b in zip(kept, kept[1:]):
        if b > a + 1:
            whole, left = path[b] - path[a], path[a + 1:b] - path[a]
            along = np.clip(left @ whole / max(float(whole @ whole), 1e-30), 0, 1)
            worst = max(worst, float(np.linalg.norm(left - along[:, None] * whole, axis=1).max()))
    return worst


wave = [f"G1 X{(i % 400) * 0.5 if i // 400 % 2 == 0 else 200 - (i % 400) * 0.5:.3f} Y{i // 400 * 0.5:.3f} "
        f"Z{math.sin(i / 40):.3f}" for i in range(120000)]
program = load(write("wave.ngc", wave))
drawing = Drawing(program.positions, program.kinds, program.lines)
path = np.array(drawing.vertices)
print("vertices:", len(path), "levels:", drawing.levels > 3, "few are needed:", len(drawing.index(1)) < len(path) / 4)
for level in range(1, drawing.levels):
    kept = np.array(drawing.index(level))
    if furthest(path, kept) > drawing.tolerance(level):
        print("level", level, "is further than its tolerance")
    if kept[0] != 0 or kept[-1] != len(path) - 1 or (np.diff(kept.astype(int)) <= 0).any():
        print("level", level, "loses an end or the order")
camera = Camera()
camera.set_view("z")
camera.fit(*drawing.extents)
matrix = camera.matrix(800, 600)
for budget in (0, 8000, 2000, 1200):
    level, first, count, vertices, exact = drawing.choose(matrix, 800, 600, 0.7, budget)
    print("budget", budget, "kept:", budget == 0 or vertices <= budget, "exact:", exact)
whole = drawing.choose(matrix, 800, 600, 0.0, 0)
print("all vertices:", sum(whole[2]) - len(whole[2]) + 1 == len(path))
camera.size /= 20
near = drawing.choose(camera.matrix(800, 600), 800, 600, 0.7, 0)
print("zoomed in: fewer vertices:", near[3] < len(path) / 4, "finer:", near[0] <= level)

# a vertex and its line: there and back
for line in (5, 4711, 119000):
    (first, last), = drawing.spans(line)
    middle = (path[first] + path[last - 1]) / 2
    zoom = Camera()
    zoom.set_view("z")
    zoom.size, zoom.centre = 0.2, [float(v) for v in middle]
    print("line", line, "picked:", drawing.pick(zoom.matrix(400, 400), 400, 400, 200, 200))
print("nothing picked:", drawing.pick(camera.matrix(400, 400), 400, 400, 200, -5000.0))

# zigzag over the whole part: no level is small, thinned all the same
zigzag = load(write("zigzag.ngc", [f"G1 X{200 * (i % 2)} Y{i / 100:.2f}" for i in range(20000)]))
d = Drawing(zigzag.positions, zigzag.kinds, zigzag.lines)
chosen = d.choose(matrix, 800, 600, 0.7, 5000)
print("zigzag:", chosen[3] <= 6000, "exact:", chosen[4])

# kept coarser beyond a number of vertices: extents, lengths and times stay exact
thin = load("wave.ngc", max_vertices=10000)
print("thinned:", thin.thinned, "vertices:", thin.n_vertices <= 10000, "moves:", thin.n_moves == program.n_moves,
      "extents:", thin.extents == program.extents, "lengths:",
      math.isclose(thin.cutting_length, program.cutting_length), "last vertex:",
      tuple(memoryview(thin.positions)[thin.n_vertices - 1, i] for i in range(2)) ==
      tuple(memoryview(program.positions)[program.n_vertices - 1, i] for i in range(2)))
program.release_path()
print("released:", program.n_vertices, "moves:", program.n_moves > 0)

# an endless program ends when it is told to; what was read is there
began = time.monotonic()
endless = load(write("endless.ngc", ["o1 while [1]", "G1 X1", "G1 X0", "o1 endwhile"]), progress=lambda line: True,
               max_vertices=100000)
print("endless: stopped:", endless.aborted, "moves:", endless.n_moves > 100)

# heights of a foam cutter's planes
foam = load(write("foam.ngc", ["(AXIS,XY_Z_POS,25.4)", "(AXIS,UV_Z_POS,50.8)", "G1 X1"]))
print("foam:", round(foam.foam_z, 6), round(foam.foam_w, 6))
foam = load(write("foam.ngc", ["(AXIS,XY_Z_POS,much)", "(PREVIEW,UV_Z_POS,1x)", "G1 X1"]))
print("unreadable:", round(foam.foam_z, 6), foam.foam_w)
foam = load(write("foam.ngc", ["(AXIS,XY_Z_POS)", "G20", "(AXIS,UV_Z_POS,2)", "G1 X1"]))
print("no number:", foam.foam_z, "inches:", foam.foam_w)

# a rotary move is a curve
turn = load(write("turn.ngc", ["G0 Y20", "G1 A90"]))
d = Drawing(turn.positions, turn.kinds, turn.lines, geometry="XYZ!A")
p = np.array(d.vertices) * 25.4
print("rotary: vertices:", len(p), "end:", [round(float(abs(v)), 3) for v in p[-1]], "radius kept:",
      bool(np.allclose(np.hypot(p[-9:, 1], p[-9:, 2]), 20)))
for wrong in ((np.zeros((3, 9)), turn.kinds, turn.lines),
              (np.zeros((3, 9), np.float32), np.zeros(2, np.uint8), np.zeros(3, np.int32))):
    try:
        Drawing(*wrong)
    except ValueError as e:
        print("refused:", e)

# the live plot: drawn in parts as it grows, the picture is that of the whole; a machine that has run for hours costs
# no more than its end
records = np.zeros(1000, PLOT_RECORD)
records["p"] = np.random.default_rng(1).uniform(-1, 1, (1000, 3))
records["q"] = records["p"] * 0.5
records["c"] = records["d"] = np.where(np.arange(1000)[:, None] % 3 == 0, (255, 0, 0, 255), (0, 0, 255, 255))
view = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
for second in (False, True):
    whole, parts = Raster(300, 200), Raster(300, 200)
    whole.draw_plot(records.tobytes(), view, 0, 1000, second)
    for first, last in ((0, 301), (300, 650), (649, 1000)):
        parts.draw_plot(records.tobytes(), view, first, last, second)
    # what is drawn later lies above: with a second path only the coloured pixels are compared
    shown = [np.frombuffer(r.ppm(), np.uint8)[15:].reshape(-1, 3).any(axis=1) for r in (whole, parts)]
    print("plot in parts:", (shown[0] == shown[1]).all() and shown[0].sum() > 1000,
          "" if second else whole.ppm() == parts.ppm())
