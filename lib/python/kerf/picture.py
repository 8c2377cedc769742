# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws a tool path as a PNG: three views (isometric, from above, from the front)."""

import math

from PIL import Image, ImageDraw

from . import imagefont

SIZE = (1600, 1000)        # pixels of the result
OVERSAMPLE = 2             # drawn larger and scaled down: smooth lines
BACKGROUND, FRAME, INK = (250, 250, 247), (205, 205, 200), (40, 44, 52)
FEED, RAPID, DEEP = (0, 92, 175), (214, 120, 20), (0, 150, 110)
GRID = (228, 228, 224)


def isometric(p):
    """Right-handed view from the front right, above; y of the result points up."""
    x, y, z = p
    a = math.radians(30)
    return (x - y) * math.cos(a), (x + y) * math.sin(a) + z


VIEWS = (("isometric", isometric, (0.0, 0.0, 0.66, 1.0)),
         ("XY, from above", lambda p: (p[0], p[1]), (0.66, 0.0, 1.0, 0.5)),
         ("XZ, from the front", lambda p: (p[0], p[2]), (0.66, 0.5, 1.0, 1.0)))


def nice_step(span):
    """A round distance that divides span into about five parts."""
    power = 10.0 ** math.floor(math.log10(max(span, 1e-9) / 5))
    return next(power * m for m in (1, 2, 5, 10) if span / (power * m) <= 6)


def font(size):
    return imagefont.load("DejaVuSans.ttf", size)


class View:
    """One projection in its rectangle of the picture."""

    def __init__(self, draw, title, project, box, points, unit):
        self.draw, self.title, self.project, self.unit = draw, title, project, unit
        w, h = SIZE[0] * OVERSAMPLE, SIZE[1] * OVERSAMPLE
        self.left, self.top, self.right, self.bottom = box[0] * w, box[1] * h, box[2] * w, box[3] * h
        flat = [project(p) for p in points]
        self.low = [min(f[i] for f in flat) for i in (0, 1)]
        self.high = [max(f[i] for f in flat) for i in (0, 1)]
        margin = 46 * OVERSAMPLE
        least = 1e-6 if max(self.high[i] - self.low[i] for i in (0, 1)) > 1e-6 else 1.0    # a point lies in one unit
        spans = [max(self.high[i] - self.low[i], least) for i in (0, 1)]
        self.scale = min((self.right - self.left - 2 * margin) / spans[0],
                         (self.bottom - self.top - 2 * margin) / spans[1])
        self.cx = (self.left + self.right) / 2 - self.scale * (self.low[0] + self.high[0]) / 2
        self.cy = (self.top + self.bottom) / 2 + self.scale * (self.low[1] + self.high[1]) / 2

    def pixel(self, p):
        u, v = self.project(p)
        return self.cx + self.scale * u, self.cy - self.scale * v

    def frame(self):
        d = self.draw
        if self.project is not isometric:
            self.grid()
        d.rectangle((self.left, self.top, self.right - 1, self.bottom - 1), outline=FRAME, width=OVERSAMPLE)
        d.text((self.left + 12 * OVERSAMPLE, self.top + 8 * OVERSAMPLE), self.title, fill=INK,
               font=font(15 * OVERSAMPLE))

    def grid(self):
        seen = max(self.right - self.left, self.bottom - self.top) / self.scale
        step = nice_step(max(self.high[0] - self.low[0], self.high[1] - self.low[1], seen / 4))
        small = font(10 * OVERSAMPLE)
        u = math.ceil((self.left - self.cx) / self.scale / step) * step
        while self.cx + self.scale * u < self.right:
            x = self.cx + self.scale * u
            self.draw.line((x, self.top, x, self.bottom), fill=GRID, width=OVERSAMPLE)
            self.draw.text((x + 3 * OVERSAMPLE, self.bottom - 16 * OVERSAMPLE), f"{u:g}", fill=INK, font=small)
            u += step
        v = math.ceil((self.cy - self.bottom) / self.scale / step) * step
        while self.cy - self.scale * v > self.top:
            y = self.cy - self.scale * v
            self.draw.line((self.left, y, self.right, y), fill=GRID, width=OVERSAMPLE)
            if y > self.top + 30 * OVERSAMPLE and y < self.bottom - 20 * OVERSAMPLE:
                self.draw.text((self.left + 4 * OVERSAMPLE, y - 13 * OVERSAMPLE), f"{v:g}", fill=INK, font=small)
            v += step

    def path(self, path):
        """Runs of equal colour, each drawn as one polyline; rapids first, cuts on top."""
        zs = [p[2] for p, kind in path if kind in (2, 3)]
        z_low, z_high = (min(zs), max(zs)) if zs else (0.0, 0.0)
        for rapid in (True, False):
            run, colour = [], None
            for (p0, _), (p1, kind) in zip(path, path[1:]):
                if (kind == 1) != rapid:
                    wanted = None
                elif rapid:
                    wanted = RAPID
                else:        # darker blue to green with depth
                    t = (p1[2] - z_low) / (z_high - z_low) if z_high > z_low else 1.0
                    t = round(t * 8) / 8
                    wanted = tuple(round(DEEP[i] + t * (FEED[i] - DEEP[i])) for i in range(3))
                if wanted != colour and run:
                    self.polyline(run, colour)
                    run = []
                if wanted:
                    if not run:
                        run = [self.pixel(p0)]
                    run.append(self.pixel(p1))
                colour = wanted
            if run:
                self.polyline(run, colour)

    def polyline(self, run, colour):
        self.draw.line(run, fill=colour, width=(1 if colour == RAPID else 2) * OVERSAMPLE, joint="curve")

    def axes(self, points):
        """A small tripod in the corner of the isometric view."""
        if self.project is not isometric:
            return
        length = 0.09 * (self.bottom - self.top)
        ox, oy = self.left + 1.8 * length, self.bottom - 1.2 * length
        for name, direction, colour in (("X", (1, 0, 0), (190, 40, 40)), ("Y", (0, 1, 0), (30, 140, 50)),
                                        ("Z", (0, 0, 1), (40, 70, 190))):
            u, v = isometric(direction)
            tip = (ox + length * u, oy - length * v)
            self.draw.line((ox, oy, *tip), fill=colour, width=3 * OVERSAMPLE)
            self.draw.text((tip[0] + 4 * OVERSAMPLE, tip[1] - 8 * OVERSAMPLE), name, fill=colour,
                           font=font(14 * OVERSAMPLE))
        lows = [min(p[i] for p in points) for i in range(3)]
        highs = [max(p[i] for p in points) for i in range(3)]
        size = " x ".join(f"{h - l:.1f}" for l, h in zip(lows, highs))
        self.draw.text((self.left + 12 * OVERSAMPLE, self.top + 32 * OVERSAMPLE),
                       f"extents {size} {self.unit}", fill=INK, font=font(12 * OVERSAMPLE))
        self.draw.text((self.right - 190 * OVERSAMPLE, self.bottom - 30 * OVERSAMPLE), "feed", fill=FEED,
                       font=font(13 * OVERSAMPLE))
        self.draw.text((self.right - 130 * OVERSAMPLE, self.bottom - 30 * OVERSAMPLE), "rapid", fill=RAPID,
                       font=font(13 * OVERSAMPLE))


def draw(path, filename, unit):
    """Writes the picture. path: list of ((x, y, z), motion type) in machine units."""
    image = Image.new("RGB", (SIZE[0] * OVERSAMPLE, SIZE[1] * OVERSAMPLE), BACKGROUND)
    canvas = ImageDraw.Draw(image)
    path = [(tuple(p), k) for p, k in path] or [((0.0, 0.0, 0.0), 1)]
    points = [p for p, _ in path]
    for title, project, box in VIEWS:
        view = View(canvas, title, project, box, points, unit or "units")
        view.frame()
        view.path(path)
        view.axes(points)
    image.resize(SIZE, Image.LANCZOS).save(filename)
