# SPDX-License-Identifier: GPL-2.0-or-later
"""Lines, planes, grids and axes that follow pins."""

import math

import numpy as np
from OpenGL import GL

from .parts import value_of
from .shapes import Mesh, frustum, triangles

GRID = 10               # distance of lines
PARALLEL = 1e-9         # length of a vector that has no direction


class Guide:
    """With lighting off for lines; values(): its arguments as numbers."""

    def __init__(self, comp, *names):
        self.comp, self.names = comp, names

    def values(self):
        return [float(value_of(self.comp, name)) for name in self.names]


def basis(normal, direction=None):
    """Columns x, y, z of a frame whose z is the normal; None when the normal has no direction."""
    length = np.linalg.norm(normal)
    if not length > PARALLEL:
        return None
    z = np.asarray(normal) / length
    for helper in (direction, (1, 0, 0), (0, 1, 0)):
        if helper is None:
            continue
        x = np.asarray(helper, dtype=float) - np.dot(helper, z) * z
        if np.linalg.norm(x) > 1e-6:
            x /= np.linalg.norm(x)
            return np.column_stack((x, np.cross(z, x), z))
    return None


def inside(origin, frame, draw):
    """Draws in a frame."""
    matrix = np.identity(4)
    matrix[:3, :3], matrix[:3, 3] = frame, origin
    GL.glPushMatrix()
    GL.glMultMatrixd(np.ascontiguousarray(matrix.T))
    draw()
    GL.glPopMatrix()


def plane(size):
    GL.glBegin(GL.GL_QUADS)
    GL.glNormal3d(0, 0, 1)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        GL.glVertex3d(x * size, y * size, 0)
    GL.glEnd()


def grid(size):
    """Lines each GRID from -size to size."""
    count = int(size // GRID)
    at = np.arange(-count, count + 1) * GRID
    lines = [((x, -size, 0), (x, size, 0)) for x in at] + [((-size, y, 0), (size, y, 0)) for y in at]
    GL.glPushAttrib(GL.GL_ENABLE_BIT)
    GL.glDisable(GL.GL_LIGHTING)
    points = np.array(lines, dtype=float).reshape(-1, 3)
    GL.glEnableClientState(GL.GL_VERTEX_ARRAY)
    GL.glVertexPointer(3, GL.GL_DOUBLE, 0, points)
    GL.glDrawArrays(GL.GL_LINES, 0, len(points))
    GL.glDisableClientState(GL.GL_VERTEX_ARRAY)
    GL.glPopAttrib()


def rod(start, vector, radius):
    """A cylinder from a point along a vector."""
    frame = basis(vector)
    if frame is None:
        return
    mesh = Mesh()
    frustum(mesh, 0, radius, float(np.linalg.norm(vector)), radius, lambda a, u, v: (u, v, a))
    inside(start, frame, lambda: triangles(*mesh.arrays()))


class HalLine(Guide):
    """A cylinder from point 1 along vector 2 times stretch."""

    def __init__(self, comp, x1, y1, z1, x2, y2, z2, stretch, r=5):
        super().__init__(comp, x1, y1, z1, x2, y2, z2, stretch, r)

    def draw(self):
        *numbers, stretch, radius = self.values()
        rod(numbers[:3], np.array(numbers[3:]) * stretch, radius)


class HalPlaneFromNormal(Guide):
    paint = staticmethod(plane)

    def __init__(self, comp, x, y, z, vx, vy, vz, s=500):
        super().__init__(comp, x, y, z, vx, vy, vz, s)

    def draw(self):
        *numbers, size = self.values()
        frame = basis(numbers[3:])
        if frame is not None:
            inside(numbers[:3], frame, lambda: self.paint(size))


class HalGridFromNormal(HalPlaneFromNormal):
    paint = staticmethod(grid)


class HalCoordsFromNormalAndDirection(Guide):
    """Red x, green y and blue z."""

    def __init__(self, comp, ox, oy, oz, xx, xy, xz, zx, zy, zz, stretch, r=5):
        super().__init__(comp, ox, oy, oz, xx, xy, xz, zx, zy, zz, stretch, r)

    def draw(self):
        n = self.values()
        frame = basis(n[6:9], n[3:6])
        if frame is None:
            return
        for column, color in enumerate(((1, 0, 0), (0, 1, 0), (0, 0, 1))):
            GL.glPushAttrib(GL.GL_CURRENT_BIT)
            GL.glColor3d(*color)
            rod(n[:3], frame[:, column] * n[9], n[10])
            GL.glPopAttrib()


class HalGridFromNormalAndDirection(Guide):
    def __init__(self, comp, ox, oy, oz, xx, xy, xz, zx, zy, zz, s=500):
        super().__init__(comp, ox, oy, oz, xx, xy, xz, zx, zy, zz, s)

    def draw(self):
        n = self.values()
        frame = basis(n[6:9], n[3:6])
        if frame is not None:
            inside(n[:3], frame, lambda: grid(n[9]))


class HalGrid(Guide):
    """On z = 0."""

    def __init__(self, comp, s=500):
        super().__init__(comp, s)

    def draw(self):
        size, = self.values()
        if math.isfinite(size):
            grid(size)
