# SPDX-License-Identifier: GPL-2.0-or-later
"""Lines and labels of the preview beside the program: grid, axes, extents, limits, tool. Inches."""

import math

import numpy as np

CIRCLE = 24              # pieces of a circle
AXIS_LENGTH = 1.0
ORIGIN_MM = 2.0          # radius of the mark at machine zero


def runs(*polylines):
    """Vertices and kinds (1 a piece, 0 a jump) of several polylines."""
    points = [p for line in polylines for p in line]
    kinds = [0 if i == 0 else 1 for line in polylines for i in range(len(line))]
    return np.array(points, np.float32).reshape(-1, 3), np.array(kinds, np.uint8)


def circle(centre, radius, u, v, count=CIRCLE):
    """Points of a circle in the plane of two unit vectors."""
    angles = [2 * math.pi * k / count for k in range(count + 1)]
    return [tuple(c + radius * (math.cos(a) * p + math.sin(a) * q) for c, p, q in zip(centre, u, v)) for a in angles]


def box(low, high):
    """The twelve edges of a box."""
    corner = [(low[0] if i & 1 == 0 else high[0], low[1] if i & 2 == 0 else high[1], low[2] if i & 4 == 0 else high[2])
              for i in range(8)]
    edges = [(a, b) for a in range(8) for b in (a ^ 1, a ^ 2, a ^ 4) if a < b]
    return runs(*[(corner[a], corner[b]) for a, b in edges])


def axes(origin, rotation_deg=0.0):
    """Three single lines of X, Y and Z from the program's origin, as arrays in that order."""
    t = math.radians(rotation_deg)
    directions = ((math.cos(t), math.sin(t), 0.0), (-math.sin(t), math.cos(t), 0.0), (0.0, 0.0, 1.0))
    return [runs([origin, tuple(o + AXIS_LENGTH * d for o, d in zip(origin, direction))]) for direction in directions]


def origin_mark():
    """Three circles around machine zero."""
    r = ORIGIN_MM / 25.4
    x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    return runs(*[circle((0, 0, 0), r, u, v) for u, v in ((x, y), (x, z), (y, z))])


def grid(step, centre, size, plane, rotation_deg=0.0):
    """Lines every `step` over a square of twice `size` around the centre; plane: indices of its axes."""
    if step <= 0 or size / step > 200:
        return runs()
    i, j = plane
    t = math.radians(rotation_deg) if plane == (0, 1) else 0.0
    lines = []
    for a, b in ((i, j), (j, i)):
        first = math.ceil((centre[a] - size) / step)
        for k in range(first, math.floor((centre[a] + size) / step) + 1):
            ends = []
            for side in (-1, 1):
                p = [0.0, 0.0, 0.0]
                p[a], p[b] = k * step, centre[b] + side * size
                if t:
                    p[0], p[1] = p[0] * math.cos(t) - p[1] * math.sin(t), p[0] * math.sin(t) + p[1] * math.cos(t)
                ends.append(tuple(p))
            lines.append(ends)
    return runs(*lines)


def across(way):
    """Two unit vectors at right angles to X or Z."""
    return ((0, 1, 0), (0, 0, 1)) if way[0] else ((1, 0, 0), (0, 1, 0))


def cone(tip, radius, height, up=1, way=(0, 0, 1)):
    """A wire cone that stands on its tip, along `way`; up -1: from the other side."""
    top = circle(tuple(t + up * height * d for t, d in zip(tip, way)), radius, *across(way))
    sides = [(tip, top[k]) for k in range(0, CIRCLE, 3)]
    return runs(top, *sides)


def cone_faces(tip, radius, height, way=(0, 0, 1)):
    """Triangles of the cone's side."""
    top = circle(tuple(t + height * d for t, d in zip(tip, way)), radius, *across(way))
    return np.array([p for a, b in zip(top, top[1:]) for p in (tip, a, b)], np.float32)


def cylinder_faces(bottom, radius, height):
    """Triangles of a cylinder's side and bottom."""
    low = circle(bottom, radius, (1, 0, 0), (0, 1, 0))
    high = circle((bottom[0], bottom[1], bottom[2] + height), radius, (1, 0, 0), (0, 1, 0))
    return np.array([p for a, b, c, d in zip(low, low[1:], high, high[1:]) for p in (a, b, c, c, b, d, bottom, a, b)],
                    np.float32)


def crosses(places, half=0.0078125):
    """Marks of dwells or a user's M codes. places: bytes, rows of four float32: x y z and plane (0 XY, 1 XZ, 2 YZ)."""
    rows = np.frombuffer(places, np.float32).reshape(-1, 4)
    arms = np.zeros((3, 4, 3), np.float32)          # plane, end, axis
    for plane, (i, j) in enumerate(((0, 1), (0, 2), (1, 2))):
        arms[plane, :, i], arms[plane, :, j] = (-half, half, -half, half), (-half, half, half, -half)
    ends = rows[:, None, :3] + arms[rows[:, 3].astype(int)]
    return ends.reshape(-1, 3), np.tile(np.array([0, 1], np.uint8), 2 * len(rows))


def turned(points, degrees, about):
    """Points rotated in XY about (x, y)."""
    points = np.array(points, np.float32).reshape(-1, 3)
    if degrees:
        t = math.radians(degrees)
        x, y = points[:, 0] - about[0], points[:, 1] - about[1]
        points[:, 0], points[:, 1] = (x * math.cos(t) - y * math.sin(t) + about[0],
                                      x * math.sin(t) + y * math.cos(t) + about[1])
    return points


PLANES = {"A": (1, 2), "B": (0, 2), "C": (0, 1)}


def tilted(points, at, letter, degrees):
    """Points rotated about a rotary axis through `at`."""
    points = np.array(points, np.float32).reshape(-1, 3)
    if len(points) and degrees:
        i, j = PLANES[letter]
        t = math.radians(degrees)
        a, b = points[:, i] - at[i], points[:, j] - at[j]
        points[:, i], points[:, j] = (a * math.cos(t) - b * math.sin(t) + at[i],
                                      a * math.sin(t) + b * math.cos(t) + at[j])
    return points


def placed(nine, geometry, coordinates, offset):
    """((x, y, z), [(letter, degrees)]): where nine axes are drawn, and how the tool is tilted there."""
    respect = "!" in geometry
    turns = respect and any(c in "ABC" and c in coordinates for c in geometry)
    point, sign, tilt = [0.0, 0.0, 0.0], 1.0, []
    for c in geometry:
        n = "XYZABCUVW".find(c)
        if c == "-":
            sign = -1.0
            continue
        if n < 0:
            continue
        if n < 3 or n > 5:
            point[n % 3] += sign * (nine[n] - (offset[n] if turns else 0.0))
        elif turns and c in coordinates:
            degrees = sign * (nine[n] - offset[n])
            i, j = PLANES[c]
            t = math.radians(degrees)
            point[i], point[j] = (point[i] * math.cos(t) - point[j] * math.sin(t),
                                  point[i] * math.sin(t) + point[j] * math.cos(t))
            tilt.append((c, degrees))
        sign = 1.0
    if turns:
        point = [p + o for p, o in zip(point, offset)]
    return tuple(point), tilt


def cylinder(bottom, radius, height):
    low = circle(bottom, radius, (1, 0, 0), (0, 1, 0))
    high = circle((bottom[0], bottom[1], bottom[2] + height), radius, (1, 0, 0), (0, 1, 0))
    return runs(low, high, *[(low[k], high[k]) for k in range(0, CIRCLE, 3)])


# Displacement of a lathe tool's tip from its centre, by orientation
TIP = {1: (1, -1), 2: (1, 1), 3: (-1, 1), 4: (-1, -1), 5: (0, -1), 6: (1, 0), 7: (0, 1), 8: (-1, 0), 9: (0, 0)}


def lathe_tool(position, diameter, front, back, orientation):
    """Profile of a lathe tool in XZ; angles in degrees. Nothing for an orientation that is unknown."""
    if orientation not in TIP:
        return runs()
    r = diameter / 2
    dx, dz = TIP[orientation]
    cx, cy, cz = position[0] + r * dx, position[1], position[2] + r * dz
    if orientation == 9:
        return runs(circle((cx, cy, cz), r, (1, 0, 0), (0, 0, 1)))
    low, high = math.radians(-90 + min(front, back)), math.radians(-270 + max(front, back))
    arc = [(cx - r * math.sin(low + (high - low) * k / 36), cy, cz + r * math.cos(low + (high - low) * k / 36))
           for k in range(37)]
    length = max(0.375, 3 * r)

    def side(end, angle):
        return end[0] + length * math.sin(angle), end[1], end[2] + length * math.cos(angle)
    start = side(arc[0], math.radians(min(front, back)) + math.pi / 2)
    stop = side(arc[-1], math.radians(max(front, back)) - math.pi / 2)
    return runs([start, *arc, stop])


def lathe_cross(at, radius):
    """Cross-hairs at a lathe tool's controlled point."""
    x, y, z = at
    return runs([(x - radius / 2, y, z), (x + radius / 2, y, z)], [(x, y, z - radius / 2), (x, y, z + radius / 2)])


def dimension(low, high, axis, plane_axis, metric, zero=0.0):
    """(vertices, kinds, [(place, text)]) of the extent along one axis, drawn beside the box in plane_axis.

    Labels: least, greatest, difference; positions are told from `zero`."""
    gap = 0.06 * max(h - l for l, h in zip(low, high)) + 0.05
    a, b = list(low), list(low)
    b[axis] = high[axis]
    a[plane_axis] -= gap
    b[plane_axis] -= gap
    ticks = []
    for p in (a, b):
        q, r = list(p), list(p)
        q[plane_axis] -= gap / 3
        r[plane_axis] += gap / 3
        ticks.append((tuple(q), tuple(r)))
    scale = 25.4 if metric else 1.0

    def form(value):
        text = ("%.1f" if metric else "%.2f") % (value * scale)
        return text[1:] if text.strip("-0.") == "" and text[0] == "-" else text
    middle = [(p + q) / 2 for p, q in zip(a, b)]
    labels = [(tuple(a), form(low[axis] - zero)), (tuple(b), form(high[axis] - zero)),
              (tuple(middle), form(high[axis] - low[axis]))]
    return (*runs((tuple(a), tuple(b)), *ticks), labels)
