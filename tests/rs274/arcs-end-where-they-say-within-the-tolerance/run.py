# SPDX-License-Identifier: GPL-2.0-or-later
"""Property: start and end of every arc lie equally far from its centre, in three planes and
two formats. FP-099: near-straight arcs up to a radius of 10^6 sweep only their chord.
FP-109: rounded CAM output and R semicircles run; the tolerance is configurable."""
import math
import random
from harness import *

letters = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}
index = {17: (0, 1), 18: (2, 0), 19: (1, 2)}
for seed in range(200):
    r = random.Random(seed)
    plane = r.choice([17, 18, 19])
    a, b, i, j = letters[plane]
    x, y = r.uniform(-20, 20), r.uniform(-20, 20)
    g = r.choice(["G2", "G3"])
    if r.random() < .5:
        radius, t0, t1 = r.uniform(1, 30), r.uniform(0, 7), r.uniform(0, 7)
        cx, cy = x - radius * math.cos(t0), y - radius * math.sin(t0)
        ex, ey = cx + radius * math.cos(t1), cy + radius * math.sin(t1)
        words = f"{a}{ex:.6f} {b}{ey:.6f} {i}{cx - x:.6f} {j}{cy - y:.6f}"
    else:
        ex, ey = r.uniform(-20, 20), r.uniform(-20, 20)
        radius = math.hypot(ex - x, ey - y) / 2 * r.uniform(1, 3)
        words = f"{a}{ex:.6f} {b}{ey:.6f} R{radius * r.choice([1, -1]):.6f}"
    run = rs274(f"G21 G{plane} F100\nG0 {a}{x:.6f} {b}{y:.6f}\n{g} {words}\nM2\n")
    check(run.status == 0, f"seed {seed}: {run.error}")
    arc = [v for n, v in run.moves() if n == "ARC_FEED"][0]
    check(near(arc[:2], [ex, ey], 2e-4), f"seed {seed}: end {arc}")
    r1, r2 = math.hypot(x - arc[2], y - arc[3]), math.hypot(ex - arc[2], ey - arc[3])
    check(abs(r1 - r2) < 3e-4 and abs(r1 - radius) < 3e-4, f"seed {seed}: radii {r1} {r2} {radius}")
    check((arc[4] > 0) == (g == "G3"), f"seed {seed}: turn")

import gcode
import tempfile
for radius in (1e2, 1e3, 1e4, 1e5, 1e6):  # FP-099
    for chord in (0.05, 1):
        for g in "G2", "G3":
            sign = -1 if g == "G2" else 1
            with tempfile.NamedTemporaryFile("w", suffix=".ngc") as f:
                f.write(f"G21 G17 G90 G91.1 F100\nG0 X0 Y0\nG1 X1\n{g} X{1 + chord} Y0 I{chord / 2} "
                        f"J{sign * radius}\nM2\n")
                f.flush()
                p = gcode.load(f.name)
            check(p.result == 1, p.error)
            check(abs(p.cutting_length * 25.4 - 1 - chord) < chord * .01,
                  f"FP-099 R{radius} chord {chord}: length {p.cutting_length * 25.4}")

# FP-109
check(rs274("G21 F100\nG2 X10 Y0 I5.005 J0\nM2\n").status == 0, "5 um off runs")
check(rs274("G21 F100\nG2 X10 Y0 R4.9990\nM2\n").status == 0, "R semicircle within rounding runs")
strict = "[EMC]\nVERSION=1.1\n[TRAJ]\nLINEAR_UNITS=mm\n[RS274NGC]\nCENTER_ARC_RADIUS_TOLERANCE_MM=0.002\n"
check(rs274("G21 F100\nG2 X10 Y0 I5.1 J0\nM2\n", ini=strict).error.startswith("Radius to end of arc differs"),
      "tolerance")
check(rs274("G21 F100\nG2 X10 Y0 I5.0 J0\nM2\n", ini=strict).status == 0, "exact arc")
done()
