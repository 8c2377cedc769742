# SPDX-License-Identifier: GPL-2.0-or-later
"""A writer of G-code for generators: runs of short cuts become few lines and arcs.

    g = Gcode(safetyheight=.04, tolerance=.001, units="G20", target=lambda line: print(line))
    g.begin(); g.set_feed(10); g.rapid(0, 0); g.cut(z=-.1); g.cut(1, 1); g.end()

target is called with each line. Consecutive cuts are held back until something else comes; then
the chain is replaced by lines and arcs that stay within the tolerance of every point.
"""
import math


def _distances(points, first, last):
    """Squared distance of each point between first and last to the segment from first to last."""
    (ax, ay, az), (bx, by, bz) = points[first], points[last]
    dx, dy, dz = bx - ax, by - ay, bz - az
    length = dx * dx + dy * dy + dz * dz or 1.0
    found = []
    for x, y, z in points[first + 1:last]:
        x, y, z = x - ax, y - ay, z - az
        t = (x * dx + y * dy + z * dz) / length
        t = 0.0 if t < 0 else 1.0 if t > 1 else t
        x, y, z = x - t * dx, y - t * dy, z - t * dz
        found.append(x * x + y * y + z * z)
    return found


LONG = 64  # points
RUN_UP_S = 3
# Plane codes: the axes that the arc turns in, its normal axis and the centre words.
_PLANES = {17: (0, 1, 2, "IJ"), 18: (2, 0, 1, "KI"), 19: (1, 2, 0, "JK")}


def _circle(a, b, c):
    """(centre x, centre y, radius) through three points of a plane, None when they are in line."""
    ax, ay, bx, by = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    d = 2 * (ax * by - ay * bx)
    if abs(d) < 1e-12:
        return None
    p, q = ax * ax + ay * ay, bx * bx + by * by
    x, y = (by * p - ay * q) / d, (ax * q - bx * p) / d
    return a[0] + x, a[1] + y, math.hypot(x, y)


def _fit_arc(points, plane, tolerance):
    """(clockwise, centre in the plane's two axes) of one arc of less than half a turn through points, or None."""
    i, j, k, _ = _PLANES[plane]
    flat = [(p[i], p[j]) for p in points]
    if any(abs(p[k] - points[0][k]) > 1e-9 for p in points):
        return None
    circle = _circle(flat[0], flat[len(flat) // 2], flat[-1])
    if circle is None or circle[2] > 1e4 * max(tolerance, 1e-6):
        return None
    x, y, r = circle
    angles = []
    for p, q in zip(flat, flat[1:]):
        if abs(math.hypot(q[0] - x, q[1] - y) - r) > tolerance:
            return None
        middle = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
        if r - math.hypot(middle[0] - x, middle[1] - y) > tolerance:
            return None
        step = math.atan2(q[1] - y, q[0] - x) - math.atan2(p[1] - y, p[0] - x)
        angles.append((step + math.pi) % (2 * math.pi) - math.pi)
    if not (all(a > 0 for a in angles) or all(a < 0 for a in angles)) or abs(sum(angles)) > math.pi * .95:
        return None
    return sum(angles) < 0, (x, y)


def simplify(points, tolerance, plane=None):
    """The chain as pieces: ("line", end) or ("arc", end, clockwise, (centre, centre)). Every point of
    the chain lies within tolerance of the pieces. plane: 17 18 19 for arcs, None for lines only."""
    pieces = []

    todo = [(0, len(points) - 1)]
    while todo:
        first, last = todo.pop()
        if last <= first:
            continue
        squares = _distances(points, first, last)
        worst = max(squares, default=0.0)
        if worst <= tolerance * tolerance:
            pieces.append(("line", points[last]))
            continue
        if plane and last - first >= 3:
            arc = _fit_arc(points[first:last + 1], plane, tolerance)
            if arc:
                pieces.append(("arc", points[last]) + arc)
                continue
        at = first + 1 + squares.index(worst)
        if last - first > LONG:  # many teeth of one height: in halves, not one by one
            middle = (first + last) / 2
            at = min((first + 1 + n for n, d in enumerate(squares) if d >= 0.9 * worst), key=lambda n: abs(n - middle))
        todo += [(at, last), (first, at)]
    return pieces


class Gcode:
    def __init__(self, homeheight=1.5, safetyheight=0.04, tolerance=0.001, units="G20", target=print,
                 spindle_speed=1000):
        """spindle_speed: rpm that begin() starts the spindle with; 0: it does not."""
        self.homeheight, self.safetyheight = homeheight, safetyheight
        self.spindle_speed = spindle_speed
        self.tolerance = tolerance
        self.units = units
        self.target = target
        self.metric = units.upper() == "G21"
        self.lastx = self.lasty = self.lastz = self.lasta = None
        self.lastf = None
        self.lastgcode = None
        self.plane = None
        self.cuts = []

    def write(self, line):
        self.target(line)

    def _number(self, value):
        text = ("%.4f" if self.metric else "%.5f") % value
        return text.rstrip("0").rstrip(".") if "." in text else text

    def begin(self):
        """Units, absolute distance, plane XY, feed a minute; up to the safety height; the spindle turns."""
        self.write(self.units)
        self.write("G17 G40 G49 G80 G90 G94")
        self.plane = 17
        self.write("G0 Z%s" % self._number(self.safetyheight))
        self.lastz = self.safetyheight
        self.lastgcode = "G0"
        if self.spindle_speed > 0:
            self.write("S%g M3" % self.spindle_speed)
            self.write("G4 P%d" % RUN_UP_S)

    def end(self):
        self.flush()
        self.safety()
        self.write("M2")

    def exactpath(self):
        self.flush()
        self.write("G61")

    def continuous(self, tolerance=0.0):
        self.flush()
        self.write("G64 P%s" % self._number(tolerance) if tolerance > 0 else "G64")

    def set_plane(self, plane):
        """17, 18 or 19: where arcs may replace cuts."""
        if plane not in _PLANES:
            raise ValueError("plane is 17, 18 or 19")
        if plane != self.plane:
            self.flush()
            self.plane = plane
            self.write("G%d" % plane)

    def set_feed(self, feed):
        """For the cuts that follow."""
        self.flush()
        if feed != self.lastf:
            self.lastf = feed
            self.write("F%s" % self._number(feed))

    def home(self):
        self.flush()
        self.rapid(z=self.homeheight)

    def safety(self):
        self.flush()
        self.rapid(z=self.safetyheight)

    def dwell(self, seconds):
        self.flush()
        self.write("G4 P%s" % self._number(seconds))

    def comment(self, text):
        self.flush()
        self.write("(%s)" % text.replace("(", "[").replace(")", "]"))

    def _words(self, position):
        words = []
        for letter, value, name in zip("XYZA", position, ("lastx", "lasty", "lastz", "lasta")):
            if value is None:
                continue
            last = getattr(self, name)
            if last is None or self._number(last) != self._number(value):
                words.append(letter + self._number(value))
            setattr(self, name, value)
        return " ".join(words)

    def _move(self, code, position, extra=""):
        words = self._words(position)
        if not words and not extra:
            return
        head = "" if code == self.lastgcode else code
        self.lastgcode = code
        self.write(" ".join(w for w in (head, words, extra) if w))

    def rapid(self, x=None, y=None, z=None, a=None):
        self.flush()
        self._move("G0", (x, y, z, a))

    def cut(self, x=None, y=None, z=None, a=None):
        """A feed move; held back to be joined with those that follow."""
        last = self.cuts[-1] if self.cuts else (self.lastx, self.lasty, self.lastz)
        point = tuple(l if v is None else v for v, l in zip((x, y, z), last))
        if a is not None or None in point:
            self.flush()
            self._move("G1", (x, y, z, a))
            return
        if not self.cuts:
            if None in last:
                self._move("G1", (x, y, z, a))
                return
            self.cuts.append(last)
        self.cuts.append(point)

    def flush(self):
        """Writes what is held back."""
        if not self.cuts:
            return
        cuts, self.cuts = self.cuts, []
        for piece in simplify(cuts, self.tolerance, self.plane):
            if piece[0] == "line":
                self._move("G1", piece[1])
                continue
            _, end, clockwise, centre = piece
            i, j, _, letters = _PLANES[self.plane]
            here = (self.lastx, self.lasty, self.lastz)
            self.lastgcode = None
            words = ["%s%s" % (letter, self._number(c - here[n])) for letter, c, n in zip(letters, centre, (i, j))]
            self._move("G2" if clockwise else "G3", end, " ".join(words))
