# SPDX-License-Identifier: GPL-2.0-or-later
"""Property: every point of an offset path lies one tool radius from the programmed contour (never
nearer), for random contours of lines and arcs, both sides; FP-098: G70 never rapids through the part."""
import math
import random
from harness import *


def segments(points):
    return list(zip(points, points[1:]))


def distance(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    t = max(0, min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) if length else 0
    return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)


def arc_points(start, v):
    cx, cy = v[2], v[3]
    a0, a1 = math.atan2(start[1] - cy, start[0] - cx), math.atan2(v[1] - cy, v[0] - cx)
    if v[4] > 0 and a1 <= a0:
        a1 += 2 * math.pi
    if v[4] < 0 and a1 >= a0:
        a1 -= 2 * math.pi
    radius = math.hypot(start[0] - cx, start[1] - cy)
    return [(cx + radius * math.cos(a0 + (a1 - a0) * k / 16), cy + radius * math.sin(a0 + (a1 - a0) * k / 16)) for k in range(1, 17)]


ran = 0
for seed in range(150):
    r = random.Random(seed)
    radius, side = r.uniform(.5, 3), r.choice(["G41.1", "G42.1"])
    # A contour that walks around a centre: no self-intersection, corners of all kinds.
    n = r.randint(4, 9)
    turn = 1 if r.random() < .5 else -1
    contour = [((20 + r.uniform(0, 12)) * math.cos(turn * 5.5 * k / n), (20 + r.uniform(0, 12)) * math.sin(turn * 5.5 * k / n)) for k in range(n)]
    entry = (contour[0][0] * 1.6, contour[0][1] * 1.6)
    text = [f"G21 G17 G90 F100\nG0 X{entry[0]:.6f} Y{entry[1]:.6f}\n{side} D{2 * radius:.6f}"]
    text += [f"G1 X{x:.6f} Y{y:.6f}" for x, y in contour] + ["G40", f"G0 X{entry[0]:.6f} Y{entry[1]:.6f}", "M2"]
    run = rs274("\n".join(text) + "\n")
    if run.status:
        check("gouging" in run.error or "entry" in run.error, f"seed {seed}: {run.error}")
        continue
    ran += 1
    moves = run.moves()[1:-1]  # without the rapids before and after
    path = [(moves[0][1][0], moves[0][1][1])]
    for name, v in moves[1:]:
        path += [(v[0], v[1])] if name != "ARC_FEED" else arc_points(path[-1], v)
    closest = 1e9
    for a, b in segments(path):
        for k in range(21):
            p = (a[0] + (b[0] - a[0]) * k / 20, a[1] + (b[1] - a[1]) * k / 20)
            d = min(distance(p, *s) for s in segments(contour))
            closest = min(closest, d)
            # one radius away, on its side; only the ends of short chords of joins dip by their sagitta
            check(d > radius * .995 - 1e-3, f"seed {seed}: {d} from the contour, radius {radius}")
    check(closest < radius * 1.01, f"seed {seed}: path stays {closest} away")
check(ran > 60, f"only {ran} contours could be cut")

# FP-098
contour = [(2, 10), (-10, 10), (-20, 14), (-30, 12), (-40, 20)]  # Z, X
for passes in 1, 2, 3:
    for comp in "", "G42.1 D1 L0\n":
        sub = "o100 sub\n" + "\n".join(f"G1 X{x} Z{z}" for z, x in contour) + "\no100 endsub\n"
        run = rs274(f"G21 G18 G90 F100\n{sub}G0 X25 Z5\n{comp}G70 Q100 X25 Z5 D2 E0 P{passes}\nG40\nM2\n")
        check(run.status == 0, f"FP-098 P{passes}: {run.error}")
        at = None
        for name, v in run.moves():
            to = (v[2], v[0]) if name != "ARC_FEED" else (v[0], v[1])
            if name == "STRAIGHT_TRAVERSE" and at:
                for k in range(1, 40):
                    z, x = at[0] + (to[0] - at[0]) * k / 40, at[1] + (to[1] - at[1]) * k / 40
                    for (z0, x0), (z1, x1) in segments(contour):
                        if z1 < z < z0:
                            check(x >= x0 + (x1 - x0) * (z - z0) / (z1 - z0) - 1e-6, f"FP-098 P{passes}: rapid through the part at Z{z} X{x}")
            at = to
done()
