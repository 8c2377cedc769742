#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Corrects Z for an uneven surface: HAL component z_level_compensation.

While enable-in is TRUE the height at x-pos, y-pos is taken from a map of the points in probe_points.txt
(present folder; x y z a line) and given as counts of scale for the external offset of Z. fade-height is
the Z above which the correction is nothing (0: everywhere whole).
"""

import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock

POLL_S = 0.05
CLEAR_S = 0.1
SCALE = 0.001               # machine units per count
POINTS = "probe_points.txt"
METHODS = ("cubic", "linear", "nearest")


def read_points(path):
    """[(x, y, z)]; x and y to a tenth. Raises ValueError that names the line."""
    points = []
    for number, line in enumerate(Path(path).read_text().splitlines(), 1):
        if not line.strip():
            continue
        try:
            x, y, z = (float(word) for word in line.split()[:3])
        except ValueError:
            raise ValueError(f"{path}:{number}: three numbers (x y z) are expected: {line!r}") from None
        points.append((round(x, 1), round(y, 1), z))
    if len(points) < 4:
        raise ValueError(f"{path}: {len(points)} points; a map needs four or more")
    return points


def triangulate(points):
    """Delaunay triangles (indices) of an (n, 2) array, by adding one point after the other."""
    from numpy import append, array
    middle, size = points.mean(axis=0), 1e4 * (abs(points - points.mean(axis=0)).max() + 1)
    p = append(points, middle + size * array([[-3, -2], [3, -2], [0, 3]]), axis=0)
    n = len(points)

    def circle(t):
        """Centre and squared radius."""
        (ax, ay), (bx, by), (cx, cy) = p[t[1]] - p[t[0]], p[t[2]] - p[t[0]], p[t[0]]
        d = 2 * (ax * by - ay * bx)
        if abs(d) < 1e-9:
            return None
        x, y = (by * (ax * ax + ay * ay) - ay * (bx * bx + by * by)) / d, (
            ax * (bx * bx + by * by) - bx * (ax * ax + ay * ay)) / d
        return cx + x, cy + y, x * x + y * y

    found = {(n, n + 1, n + 2): circle((n, n + 1, n + 2))}
    for i in range(n):
        x, y = p[i]
        hit = [t for t, (cx, cy, r2) in found.items() if (x - cx) ** 2 + (y - cy) ** 2 < r2 * (1 + 1e-12)]
        edges: dict[tuple[int, int], int] = {}
        for t in hit:
            del found[t]
            for edge in ((t[0], t[1]), (t[1], t[2]), (t[0], t[2])):
                edges[edge] = edges.get(edge, 0) + 1
        for (a, b), times in edges.items():
            t = tuple(sorted((a, b, i)))
            if times == 1 and (c := circle(t)):
                found[t] = c
    return [t for t in found if t[2] < n]


class Map:
    """Heights on a grid of 1 unit over the points. Where they say nothing: 0."""

    def __init__(self, points, method):
        from numpy import arange, array, meshgrid, stack
        table = array(points)
        places, heights = table[:, :2], table[:, 2]
        (self.x0, self.y0), (x1, y1) = (int(v) for v in places.min(axis=0)), (int(v) for v in places.max(axis=0))
        self.nx, self.ny = x1 - self.x0 + 1, y1 - self.y0 + 1
        grid = stack(meshgrid(self.x0 + arange(self.nx), self.y0 + arange(self.ny), indexing="ij"), axis=-1)
        if method == "nearest":
            distance = ((grid[:, :, None, :] - places) ** 2).sum(axis=-1)
            self.heights = heights[distance.argmin(axis=-1)]
        else:
            self.heights = self.smooth(grid, places, heights) if method == "cubic" else None
            if self.heights is None:
                self.heights = self.flat(grid, places, heights)
        # FP-075: a smooth surface may overshoot between its points, a correction must not (0
        # is where nothing is known).
        self.heights = self.heights.clip(min(0.0, heights.min()), max(0.0, heights.max()))

    @staticmethod
    def smooth(grid, places, heights):
        """Cubic interpolation needs scipy; without it the map is made of flat triangles."""
        try:
            from numpy import nan_to_num
            from scipy.interpolate import griddata
        except ImportError:
            print("z_level_compensation: python3-scipy is missing: linear instead of cubic", file=sys.stderr)
            return None
        return nan_to_num(griddata(places, heights, grid, method="cubic"))

    @staticmethod
    def flat(grid, places, heights):
        from numpy import array, cross, linalg, zeros
        result, tiny = zeros(grid.shape[:2]), -1e-9
        for t in triangulate(places):
            a, b, c = places[list(t)]
            if abs(cross(b - a, c - a)) < 1e-9:
                continue
            weights = (grid - a) @ linalg.inv(array([b - a, c - a]))
            u, v = weights[..., 0], weights[..., 1]
            inside = (u >= tiny) & (v >= tiny) & (u + v <= 1 - tiny)
            plane = heights[t[0]] + u * (heights[t[1]] - heights[t[0]]) + v * (heights[t[2]] - heights[t[0]])
            result[inside] = plane[inside]
        return result

    def at(self, x, y):
        i = min(max(round(x) - self.x0, 0), self.nx - 1)
        j = min(max(round(y) - self.y0, 0), self.ny - 1)
        return float(self.heights[i, j])


def fade(z, height):
    """Share of the correction at z."""
    if height == 0:
        return 1.0
    return min((height - z) / height, 1.0) if z < height else 0.0


def counts(offset, share):
    return int(int(offset / SCALE) * share)


def spare_machine_moves():
    """FP-074: where the machine has the setting, moves to machine coordinates of Z are made without the offset."""
    try:
        hal.set_p("axis.z.eoffset-work-only", "1")
    except (hal.error, RuntimeError):
        pass


class Compensation:
    """What the component does at each poll. machine(): (is on, work offset of X, of Y)."""

    def __init__(self, pins, machine, folder="."):
        self.pins, self.machine = pins, machine
        self.path = os.path.join(folder, POINTS)
        self.map = self.loaded = self.told = None
        self.fade_height = 0.0
        self.running = False

    def load(self):
        """Reads the points when they are new. False after telling what is wrong."""
        try:
            stamp = (os.stat(self.path).st_mtime_ns, self.pins["method"])
            if stamp != self.loaded:
                number = self.pins["method"]
                if not 0 <= number < len(METHODS):
                    print(f"z_level_compensation: method {number} is unknown (0 cubic, 1 linear, 2 nearest): cubic",
                          file=sys.stderr)
                    number = 0
                self.map, self.loaded = Map(read_points(self.path), METHODS[number]), stamp
            return True
        except (OSError, ValueError, ImportError) as error:
            if self.told != str(error):
                self.told = str(error)
                print(f"z_level_compensation: {error}", file=sys.stderr)
            self.map = self.loaded = None
            return False

    def step(self):
        pins = self.pins
        pins["scale"] = SCALE
        if not pins["enable-in"]:
            if self.running:
                self.running = False
                pins["counts"] = 0
                pins["clear"] = True
                clock.sleep(CLEAR_S)
                pins["clear"] = False
            pins["counts"] = 0
            return
        if not self.running:
            self.fade_height = pins["fade-height"]
            self.running = True
            spare_machine_moves()
        on, x0, y0 = self.machine()
        if not self.load() or not on:
            pins["counts"] = 0
            return
        offset = self.map.at(pins["x-pos"] - x0, pins["y-pos"] - y0)
        pins["counts"] = counts(offset, fade(pins["z-pos"], self.fade_height))


def status_of_the_machine():
    """A function for Compensation that asks the status channel."""
    import linuxcnc
    stat = linuxcnc.stat()

    def machine():
        stat.poll()
        return stat.task_state == linuxcnc.STATE_ON, stat.g5x_offset[0], stat.g5x_offset[1]
    return machine


def main():
    component = hal.component("z_level_compensation")
    for name, kind, direction in (
            ("enable-in", hal.HAL_BIT, hal.HAL_IN), ("scale", hal.HAL_FLOAT, hal.HAL_OUT),
            ("counts", hal.HAL_S32, hal.HAL_OUT), ("clear", hal.HAL_BIT, hal.HAL_IN),
            ("x-pos", hal.HAL_FLOAT, hal.HAL_IN), ("y-pos", hal.HAL_FLOAT, hal.HAL_IN),
            ("z-pos", hal.HAL_FLOAT, hal.HAL_IN), ("fade-height", hal.HAL_FLOAT, hal.HAL_IN),
            ("method", hal.HAL_S32, hal.HAL_IN)):
        component.newpin(name, kind, direction)
    component.ready()
    clock.join("z_level_compensation", 500)
    compensation = Compensation(component, status_of_the_machine())
    while True:
        compensation.step()
        clock.sleep(POLL_S)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
