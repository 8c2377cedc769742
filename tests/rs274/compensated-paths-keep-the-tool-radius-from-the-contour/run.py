# SPDX-License-Identifier: GPL-2.0-or-later
"""Property: every point of an offset path lies exactly one tool radius from the programmed contour, for
random contours of lines and arcs, both sides, XY and XZ; FP-098: G70 never rapids through the part."""
import math
import random
from harness import *


def segments(points):
    return list(zip(points, points[1:]))


class Line:
    def __init__(self, a, b):
        self.a, self.b = a, b

    def distance(self, p):
        dx, dy = self.b[0] - self.a[0], self.b[1] - self.a[1]
        length = dx * dx + dy * dy
        t = max(0, min(1, ((p[0] - self.a[0]) * dx + (p[1] - self.a[1]) * dy) / length)) if length else 0
        return math.hypot(p[0] - self.a[0] - t * dx, p[1] - self.a[1] - t * dy)

    def points(self):
        return [(self.a[0] + (self.b[0] - self.a[0]) * k / 40, self.a[1] + (self.b[1] - self.a[1]) * k / 40)
                for k in range(41)]


class Arc:
    def __init__(self, a, b, centre, turn):
        self.a, self.b, self.centre = a, b, centre
        self.radius = math.hypot(a[0] - centre[0], a[1] - centre[1])
        self.start = math.atan2(a[1] - centre[1], a[0] - centre[0])
        end = math.atan2(b[1] - centre[1], b[0] - centre[0])
        self.sweep = turn * (turn * (end - self.start) % (2 * math.pi))

    def distance(self, p):
        angle = math.atan2(p[1] - self.centre[1], p[0] - self.centre[0])
        along = (angle - self.start) % (2 * math.pi) if self.sweep > 0 else -((self.start - angle) % (2 * math.pi))
        if abs(along) <= abs(self.sweep):
            return abs(math.hypot(p[0] - self.centre[0], p[1] - self.centre[1]) - self.radius)
        return min(math.dist(p, self.a), math.dist(p, self.b))

    def points(self):
        return [(self.centre[0] + self.radius * math.cos(self.start + self.sweep * k / 40),
                 self.centre[1] + self.radius * math.sin(self.start + self.sweep * k / 40)) for k in range(41)]


def bulge(r, a, b, tool):
    """An arc from a to b, or None; wide enough for the tool on either side."""
    chord = math.dist(a, b)
    radius = max(chord * r.uniform(.6, 3), tool * 1.3)
    turn = r.choice([1, -1])
    height = math.sqrt(radius * radius - chord * chord / 4)
    middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
    centre = (middle[0] - turn * height * (b[1] - a[1]) / chord, middle[1] + turn * height * (b[0] - a[0]) / chord)
    return Arc(a, b, centre, turn)


ran = arcs = 0
for seed in range(260):
    r = random.Random(seed)
    tool = r.uniform(.5, 3)
    # A contour that walks around a centre: corners of all kinds.
    n = r.randint(4, 9)
    turn = 1 if r.random() < .5 else -1
    corners = [tuple((20 + r.uniform(0, 12)) * f(turn * 5.2 * k / n) for f in (math.cos, math.sin)) for k in range(n)]
    contour = [bulge(r, a, b, tool) if r.random() < .4 else Line(a, b) for a, b in segments(corners)]
    entry = (corners[0][0] * 1.6, corners[0][1] * 1.6)
    plane, first, second, i, j = r.choice([("G17", "X", "Y", "I", "J"), ("G18", "Z", "X", "K", "I")])
    text = [f"G21 {plane} G90 F100\nG0 {first}{entry[0]:.7f} {second}{entry[1]:.7f}\n"
            f"{r.choice(['G41.1', 'G42.1'])} D{2 * tool:.7f}",
            f"G1 {first}{corners[0][0]:.7f} {second}{corners[0][1]:.7f}"]
    for e in contour:
        end = f"{first}{e.b[0]:.7f} {second}{e.b[1]:.7f}"
        text.append(f"G1 {end}" if isinstance(e, Line) else
                    f"{'G3' if e.sweep > 0 else 'G2'} {end} {i}{e.centre[0] - e.a[0]:.7f} {j}{e.centre[1] - e.a[1]:.7f}")
    run = rs274("\n".join(text + ["G40", f"G0 {first}{entry[0]:.7f} {second}{entry[1]:.7f}", "M2"]) + "\n")
    if run.status:
        check("gouging" in run.error or "entry" in run.error or "not less than arc" in run.error,
              f"seed {seed}: {run.error}")
        continue
    ran += 1
    at = None
    for name, v in run.moves()[1:-1]:  # without the rapids before and after
        to = (v[0], v[1]) if name == "ARC_FEED" or plane == "G17" else (v[2], v[0])
        if at:
            move = Line(at, to) if name != "ARC_FEED" else Arc(at, to, (v[2], v[3]), 1 if v[4] > 0 else -1)
            arcs += name == "ARC_FEED"
            for p in move.points():
                d = min(e.distance(p) for e in contour)
                # a kink of up to 0.05 rad gets no join: the path dips there by r (1 - cos 0.05)
                check(tool * .99874 - 3e-4 < d < tool + 3e-4, f"seed {seed}: {d} from the contour, radius {tool}")
        at = to
check(ran > 60 and arcs > 150, f"only {ran} contours with {arcs} arcs could be cut")

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
                            check(x >= x0 + (x1 - x0) * (z - z0) / (z1 - z0) - 1e-6,
                                  f"FP-098 P{passes}: rapid through the part at Z{z} X{x}")
            at = to
done()
