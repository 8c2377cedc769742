# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the preview is looked at from; no widgets here.

Model space is inches, x y z to the right, back and up. A matrix is 16 numbers, row-major:
clip = matrix * (x, y, z, 1); the window shows -w <= x, y <= w, y up; less z is nearer.
"""

import math

ZOOM_STEP_PX = 16        # pixels of a drag that zoom by ZOOM_FACTOR
ZOOM_FACTOR = 1.25
DEGREES_PER_PX = 0.5
SNAP_DEG = 3.0
MIN_SIZE, MAX_SIZE = 0.1, 6000.0    # inches across the window
DEPTH = 4.0              # window sizes before and behind the centre that have a depth of their own
EYE = 2.5                # distance of the eye in perspective, in window sizes

# (right, up, outward) of the fixed views
FIXED = {
    "z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "z2": ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
    "x": ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
    "y": ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    "y2": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "lathe": ((0, 0, 1), (-1, 0, 0), (0, -1, 0)),
    "lathe2": ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
}
NUMBERS = {"z": 1, "z2": 2, "x": 3, "y": 4, "y2": 4, "lathe": 4, "lathe2": 4, "p": 5}
LATHE = {"y": "lathe", "y2": "lathe2"}      # as the operator stands: Z to the right, X towards him or away
CYCLE = ("z", "z2", "x", "y", "p")


def snapped(angle):
    """The angle, or the multiple of 90 degrees that it is close to."""
    nearest = 90.0 * round(angle / 90.0)
    return nearest if abs(angle - nearest) < SNAP_DEG else angle


class Camera:
    """A direction, a centre and a size (inches over the smaller side of the window)."""

    def __init__(self):
        self.view = "p"          # name of the view, "" after a free rotation
        self.lat, self.lon = -60.0, 335.0
        self.centre = [0.0, 0.0, 0.0]
        self.size = 10.0

    @property
    def number(self):
        """1 Z, 2 Z2, 3 X, 4 Y or Y2, 5 P, 0 rotated."""
        return NUMBERS.get(self.view, 0)

    def set_view(self, name):
        self.view = name
        if name == "p":
            self.lat, self.lon = -60.0, 335.0

    def next_view(self):
        return CYCLE[(CYCLE.index(self.view) + 1) % len(CYCLE)] if self.view in CYCLE else CYCLE[0]

    def basis(self):
        """Vectors to the right, up and towards the eye."""
        if self.view in FIXED:
            return FIXED[self.view]
        a, b = math.radians(self.lat), math.radians(self.lon)
        ca, sa, cb, sb = math.cos(a), math.sin(a), math.cos(b), math.sin(b)
        return (cb, -sb, 0.0), (ca * sb, ca * cb, -sa), (sa * sb, sa * cb, ca)

    def fit(self, low, high):
        """Looks at a box."""
        self.centre = [(a + b) / 2 for a, b in zip(low, high)]
        right, up, _ = self.basis()
        spans = [sum(abs(axis[i]) * (high[i] - low[i]) for i in range(3)) for axis in (right, up)]
        self.size = min(MAX_SIZE, max(MIN_SIZE, 1.25 * max(*spans, 0.5)))

    def matrix(self, width, height):
        right, up, out = self.basis()
        half = self.size / 2
        sx, sy = (half * width / height, half) if width > height else (half, half * height / width)
        rows = []
        for vector, scale in ((right, 1 / sx), (up, 1 / sy)):
            rows.append([c * scale for c in vector] + [-scale * sum(c * p for c, p in zip(vector, self.centre))])
        depth = 0.0 if self.view in FIXED else 1 / (EYE * self.size)
        towards = sum(c * p for c, p in zip(out, self.centre))
        near = [-c / (DEPTH * self.size) for c in out] + [towards / (DEPTH * self.size)]
        last = [-c * depth for c in out] + [1 + depth * towards]
        return rows[0] + rows[1] + near + last

    def pixel(self, point, width, height):
        """(x, y) of a point in the window, or None behind the eye."""
        m = self.matrix(width, height)
        x, y, w = (sum(m[4 * r + i] * point[i] for i in range(3)) + m[4 * r + 3] for r in (0, 1, 3))
        if w <= 1e-6:
            return None
        return width / 2 * (1 + x / w), height / 2 * (1 - y / w)

    def pan(self, dx, dy, width, height):
        """Moves the picture by pixels."""
        per_pixel = self.size / min(width, height)
        right, up, _ = self.basis()
        for i in range(3):
            self.centre[i] += per_pixel * (dy * up[i] - dx * right[i])

    def rotate(self, dx, dy):
        if self.view in FIXED:
            self.lat, self.lon = {"z": (0, 0), "z2": (0, 270), "x": (-90, 270), "y": (-90, 0), "y2": (90, 0)}[self.view]
        self.view = ""
        self.lat = (self.lat + DEGREES_PER_PX * dy) % 360.0
        self.lon = (self.lon + DEGREES_PER_PX * dx) % 360.0

    def end_rotation(self):
        """At the end of a drag: close to a multiple of 90 degrees becomes exact."""
        self.lat, self.lon = snapped(self.lat), snapped(self.lon)

    def zoom(self, factor):
        self.size = min(MAX_SIZE, max(MIN_SIZE, self.size * factor))

    def zoom_by_drag(self, dy):
        self.zoom(ZOOM_FACTOR ** (dy / ZOOM_STEP_PX))

    def zoom_in(self):
        self.size = max(MIN_SIZE, self.size / 1.1 - 0.2)

    def zoom_out(self):
        self.size = min(MAX_SIZE, self.size * 1.1 + 0.2)
