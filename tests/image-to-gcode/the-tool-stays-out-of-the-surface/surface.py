# SPDX-License-Identifier: GPL-2.0-or-later
"""Programs of every pattern, direction, tool and roughing: no point of the cut is deeper than the shape allows
(checked pixel by pixel), rapids across are above it, and the lowest level is reached."""
import math
import re
from dataclasses import replace

import numpy

from kerf import relief

SIZE = 0.5
rows, columns = numpy.mgrid[0:24, 0:36]
PICTURE = numpy.clip(1 - numpy.hypot(columns - 14, rows - 11) / 14, 0, 1)
PICTURE[16:, 26:] = 0.8  # a step
BASE = relief.Settings(units=1, pixel_size=SIZE, depth=5, tool_diameter=3, pixelstep=3, safety_height=2, tolerance=0.01,
                       feed_rate=600, plunge_feed_rate=200, expand=0)
WORD = re.compile(r"([A-Z])(-?[\d.]+)")


def moves(lines):
    """(code, from, to, feed) of each motion; arcs as their chords' points."""
    at, code, feed, plane = (0.0, 0.0, 0.0), 0, 0.0, 17
    for line in lines:
        words = WORD.findall(line)
        centre = [0.0, 0.0, 0.0]
        to = list(at)
        moves_here = False
        for letter, value in words:
            if letter == "G" and float(value) in (0, 1, 2, 3):
                code = int(value)
            elif letter == "G" and float(value) in (17, 18, 19):
                plane = int(value)
            elif letter == "F":
                feed = float(value)
            elif letter in "XYZ":
                to["XYZ".index(letter)] = float(value)
                moves_here = True
            elif letter in "IJK":
                centre["IJK".index(letter)] = float(value)
                moves_here = True
        if not moves_here:
            continue
        if code < 2:
            yield code, at, tuple(to), feed
        else:
            i, j = {17: (0, 1), 18: (2, 0), 19: (1, 2)}[plane]
            cx, cy = at[i] + centre[i], at[j] + centre[j]
            a, b = math.atan2(at[j] - cy, at[i] - cx), math.atan2(to[j] - cy, to[i] - cx)
            turn = (a - b) % (2 * math.pi) if code == 2 else (b - a) % (2 * math.pi)
            radius, before = math.hypot(at[i] - cx, at[j] - cy), at
            for n in range(1, 9):
                angle = a + (-turn if code == 2 else turn) * n / 8
                point = list(to)
                point[i], point[j] = cx + radius * math.cos(angle), cy + radius * math.sin(angle)
                yield 1, before, tuple(point), feed
                before = tuple(point)
        at = tuple(to)


def edge(settings, d):
    """Height of the tool's edge above its tip, by geometry of its own."""
    kind, radius = relief.TOOLS[settings.tool_type], settings.tool_diameter / 2
    if kind == "Ball End":
        return radius - math.sqrt(radius ** 2 - d ** 2)
    return 0.0 if kind == "Flat End" else d / math.tan(math.radians(int(kind[:2]) / 2))


def check(name, bottom=-4.9, **changes):
    settings, lines = replace(BASE, **changes), []
    percent = []
    relief.convert(PICTURE, settings, lines.append, percent.append)
    surface = relief.heights(PICTURE, settings)
    high = surface.shape[0]
    pixels = [(dy, dx, edge(settings, math.hypot(dx, dy) * SIZE)) for dy in range(-3, 4)
              for dx in range(-3, 4) if math.hypot(dx, dy) * SIZE <= settings.tool_diameter / 2]
    deepest, worst, wrong = 0.0, 0.0, []
    for code, start, end, feed in moves(lines):
        if code == 0:
            if min(start[2], end[2]) < settings.safety_height - 1e-6 and start[:2] != end[:2]:
                wrong.append(("rapid", start, end))
            continue
        deepest = min(deepest, end[2])
        if start[:2] == end[:2] and end[2] < start[2] and start[2] > 0 and feed != settings.plunge_feed_rate:
            wrong.append(("feed of a plunge", start, end, feed))
        length = max(1, int(math.dist(start, end) / SIZE * 2))
        for n in range(length + 1):
            x, y, z = (a + (b - a) * n / length for a, b in zip(start, end))
            column, row = x / SIZE, high - 1 - y / SIZE
            if abs(column - round(column)) > 0.02 or abs(row - round(row)) > 0.02:
                continue
            column, row = round(column), round(row)
            allowed = max(surface[row + dy, column + dx] - e
                          for dy, dx, e in pixels if 0 <= row + dy < high and 0 <= column + dx < surface.shape[1])
            worst = max(worst, allowed - z)
    good = (worst <= settings.tolerance * 2.5 and not wrong and deepest <= bottom and lines[-1] == "M2"
            and percent[-1] == 100)
    print(f"{name}: {'clear' if good else f'WRONG {worst} {wrong[:2]} {deepest}'}")


for pattern in range(4):
    check(relief.PATTERNS[pattern], pattern=pattern)
for converter in range(5):
    check(relief.CONVERTERS[converter], converter=converter)
for kind in range(5):
    check(relief.TOOLS[kind], tool_type=kind)
for bounded in (1, 2):
    check(relief.BOUNDED[bounded], pattern=2, bounded=bounded, contact_angle=30)
check("roughing", roughing_offset=0.5, roughing_depth=1.5)
check("border", expand=2)
check("inverted", -4.3, invert=True, normalize=True)  # the ball does not reach into the cone
for changes in (dict(depth=0), dict(pixelstep=0), dict(pixel_size=0.0001), dict(contact_angle=90), dict(tool_type=9),
                dict(feed_rate=float("nan"))):
    try:
        relief.convert(PICTURE, replace(BASE, **changes), print)
    except relief.Mistake as mistake:
        print(mistake)
