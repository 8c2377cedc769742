# SPDX-License-Identifier: GPL-2.0-or-later
"""Primitives. Arguments are numbers; with a HAL component before them, also names of its pins."""

import math

import hal
import numpy as np
from OpenGL import GL

SIDES = 32              # of round bodies


def triangles(points, normals):
    """Draws triangles: arrays (n, 3), one normal for each point."""
    GL.glEnableClientState(GL.GL_VERTEX_ARRAY)
    GL.glEnableClientState(GL.GL_NORMAL_ARRAY)
    GL.glVertexPointer(3, GL.GL_DOUBLE, 0, np.ascontiguousarray(points, dtype=float))
    GL.glNormalPointer(GL.GL_DOUBLE, 0, np.ascontiguousarray(normals, dtype=float))
    GL.glDrawArrays(GL.GL_TRIANGLES, 0, len(points))
    GL.glDisableClientState(GL.GL_VERTEX_ARRAY)
    GL.glDisableClientState(GL.GL_NORMAL_ARRAY)


class Body:
    """Triangles that stay as they are: given to the driver once (a display list)."""

    def __init__(self, points, normals):
        self.arrays, self.list = (points, normals), None

    def draw(self):
        if self.list is not None:
            GL.glCallList(self.list)
        elif len(self.arrays[0]) and GL.glGetIntegerv(GL.GL_LIST_INDEX):     # in a user's list
            triangles(*self.arrays)
        elif len(self.arrays[0]):
            self.list = GL.glGenLists(1)
            GL.glNewList(self.list, GL.GL_COMPILE)
            try:
                triangles(*self.arrays)
            finally:
                GL.glEndList()
            GL.glCallList(self.list)

    def forget(self):
        if self.list is not None:
            GL.glDeleteLists(self.list, 1)
            self.list = None


def flat_normals(points):
    """Of triangles: one for each point; of triangles without a surface +Z."""
    corners = np.asarray(points, dtype=float).reshape(-1, 3, 3)
    found = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(found, axis=1)
    found[lengths == 0] = 0, 0, 1
    lengths[lengths == 0] = 1
    return np.repeat(found / lengths[:, None], 3, axis=0)


class Mesh:
    """What triangles are made of; kinds of corners that make faces."""

    def __init__(self):
        self.points, self.normals = [], []

    def face(self, corners, normals=None):
        """A convex face; normals by corner, or None for a flat one."""
        for n in range(1, len(corners) - 1):
            three = [corners[0], corners[n], corners[n + 1]]
            self.points += three
            self.normals += [normals[0], normals[n], normals[n + 1]] if normals else list(flat_normals(three))

    def arrays(self):
        return np.array(self.points, dtype=float).reshape(-1, 3), np.array(self.normals, dtype=float).reshape(-1, 3)


class Shape:
    """A primitive: mesh(*numbers) makes it, anew when a pin has changed."""
    comp = None         # a subclass may say its own before or after the shape's start

    def __init__(self, *args):
        if args and (isinstance(args[0], hal.component) or hasattr(args[0], "newpin")):
            self.comp, args = args[0], args[1:]
        wanted = self.arguments
        # a subclass that says its own coords() gives none
        if len(args) != len(wanted) and (args or type(self).coords is Shape.coords):
            raise TypeError(f"{type(self).__name__}({', '.join(wanted)}): {len(args)} arguments were given")
        if self.comp is None and any(isinstance(a, str) for a in args):
            raise TypeError(f"{type(self).__name__}: names of pins need the component as first argument")
        self.args, self.made_of, self.body = args, None, Body((), ())

    def coords(self):
        """The arguments as numbers."""
        return [self.comp[a] if isinstance(a, str) else a for a in self.args]

    def draw(self):
        now = list(self.coords())
        if now != self.made_of:
            mesh = Mesh()
            self.mesh(mesh, *now)
            self.body.forget()
            self.body, self.made_of = Body(*mesh.arrays()), now
        self.body.draw()

    def volume(self):
        return self.volume_of(*self.coords())


def frustum(mesh, a1, r1, a2, r2, place):
    """A capped cone between a1 and a2; place(a, u, v) turns its axis."""
    if a1 > a2:
        a1, r1, a2, r2 = a2, r2, a1, r1
    slope = (r1 - r2) / (a2 - a1) if a2 > a1 else 0
    ring = [(math.cos(2 * math.pi * n / SIDES), math.sin(2 * math.pi * n / SIDES)) for n in range(SIDES)]
    low = [place(a1, r1 * c, r1 * s) for c, s in ring]
    high = [place(a2, r2 * c, r2 * s) for c, s in ring]
    out = [place(slope, c, s) for c, s in ring]
    for n in range(SIDES):
        m = (n + 1) % SIDES
        mesh.face([low[n], low[m], high[m], high[n]], [out[n], out[m], out[m], out[n]])
    mesh.face(low[::-1])
    mesh.face(high)


def frustum_volume(a1, r1, a2, r2):
    return math.pi * abs(a2 - a1) * (r1 * r1 + r1 * r2 + r2 * r2) / 3


class Cylinder(Shape):
    """A frustum along an axis; `laid` gives x, y, z of a place along and across it."""
    volume_of = staticmethod(frustum_volume)

    def mesh(self, mesh, *numbers):
        frustum(mesh, *numbers, self.laid)


class CylinderX(Cylinder):
    arguments = "x1", "r1", "x2", "r2"
    laid = staticmethod(lambda a, u, v: (a, u, v))


class CylinderY(Cylinder):
    arguments = "y1", "r1", "y2", "r2"
    laid = staticmethod(lambda a, u, v: (v, a, u))


class CylinderZ(Cylinder):
    arguments = "z1", "r1", "z2", "r2"
    laid = staticmethod(lambda a, u, v: (u, v, a))


class Sphere(Shape):
    arguments = "x", "y", "z", "r"

    def mesh(self, mesh, x, y, z, r):
        def at(lat, lon):
            a, b = math.pi * lat / 16 - math.pi / 2, 2 * math.pi * lon / SIDES
            return math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), math.sin(a)
        for lat in range(16):
            for lon in range(SIDES):
                out = [at(lat, lon), at(lat, lon + 1), at(lat + 1, lon + 1), at(lat + 1, lon)]
                mesh.face([(x + r * a, y + r * b, z + r * c) for a, b, c in out], out)

    @staticmethod
    def volume_of(x, y, z, r):
        return 4 / 3 * math.pi * r ** 3


def prism(mesh, corners, low, high, place):
    """A triangle from low to high along the third axis."""
    bottom, top = [place(*c, low) for c in corners], [place(*c, high) for c in corners]
    faces = [bottom, top] + [[bottom[n], bottom[(n + 1) % 3], top[(n + 1) % 3], top[n]] for n in range(3)]
    middle = np.mean(bottom + top, axis=0)
    for face in faces:
        normal = flat_normals(face[:3])[0]
        # outwards
        mesh.face(face if np.dot(normal, np.mean(face, axis=0) - middle) >= 0 else face[::-1])


def triangle_area(x1, y1, x2, y2, x3, y3):
    return abs((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)) / 2


class Triangle(Shape):
    def mesh(self, mesh, *n):
        prism(mesh, [n[0:2], n[2:4], n[4:6]], n[6], n[7], self.place)

    @staticmethod
    def volume_of(*n):
        return triangle_area(*n[:6]) * abs(n[7] - n[6])


class TriangleXY(Triangle):
    arguments = "x1", "y1", "x2", "y2", "x3", "y3", "z1", "z2"

    @staticmethod
    def place(x, y, z):
        return x, y, z


class TriangleXZ(Triangle):
    arguments = "x1", "z1", "x2", "z2", "x3", "z3", "y1", "y2"

    @staticmethod
    def place(x, z, y):
        return x, y, z


class TriangleYZ(Triangle):
    arguments = "y1", "z1", "y2", "z2", "y3", "z3", "x1", "x2"

    @staticmethod
    def place(y, z, x):
        return x, y, z


class ArcX(Shape):
    """A bent bar about X: from x1 to x2, radii r1 to r2, angles a1 to a2, in steps."""
    arguments = "x1", "x2", "r1", "r2", "a1", "a2", "steps"

    def mesh(self, mesh, x1, x2, r1, r2, a1, a2, steps):
        steps = max(int(steps), 1)
        x1, x2 = min(x1, x2), max(x1, x2)
        r1, r2 = min(r1, r2), max(r1, r2)
        a1, a2 = min(a1, a2), max(a1, a2)

        def ring(n):
            a = math.radians(a1 + (a2 - a1) * n / steps)
            y, z = math.cos(a), math.sin(a)
            return [(x1, r1 * y, r1 * z), (x2, r1 * y, r1 * z), (x2, r2 * y, r2 * z), (x1, r2 * y, r2 * z)]
        rings = [ring(n) for n in range(steps + 1)]
        for here, there in zip(rings, rings[1:]):
            for n in range(4):
                m = (n + 1) % 4
                mesh.face([here[n], here[m], there[m], there[n]])
        mesh.face(rings[0][::-1])
        mesh.face(rings[-1])

    @staticmethod
    def volume_of(x1, x2, r1, r2, a1, a2, steps):
        return math.radians(abs(a2 - a1)) / 2 * abs(r2 * r2 - r1 * r1) * abs(x2 - x1)


class Box(Shape):
    arguments = "x1", "y1", "z1", "x2", "y2", "z2"

    def mesh(self, mesh, x1, y1, z1, x2, y2, z2):
        x1, x2, y1, y2, z1, z2 = min(x1, x2), max(x1, x2), min(y1, y2), max(y1, y2), min(z1, z2), max(z1, z2)
        mesh.face([(x1, y1, z2), (x2, y1, z2), (x2, y2, z2), (x1, y2, z2)])
        mesh.face([(x1, y2, z1), (x2, y2, z1), (x2, y1, z1), (x1, y1, z1)])
        mesh.face([(x1, y1, z1), (x2, y1, z1), (x2, y1, z2), (x1, y1, z2)])
        mesh.face([(x2, y2, z1), (x1, y2, z1), (x1, y2, z2), (x2, y2, z2)])
        mesh.face([(x2, y1, z1), (x2, y2, z1), (x2, y2, z2), (x2, y1, z2)])
        mesh.face([(x1, y2, z1), (x1, y1, z1), (x1, y1, z2), (x1, y2, z2)])

    @staticmethod
    def volume_of(x1, y1, z1, x2, y2, z2):
        return abs((x2 - x1) * (y2 - y1) * (z2 - z1))


class BoxCentered(Box):
    def __init__(self, xw, yw, zw):
        super().__init__(-xw / 2, -yw / 2, -zw / 2, xw / 2, yw / 2, zw / 2)


class BoxCenteredXY(Box):
    """On z = 0."""

    def __init__(self, xw, yw, zw):
        super().__init__(-xw / 2, -yw / 2, 0, xw / 2, yw / 2, zw)
