# SPDX-License-Identifier: GPL-2.0-or-later
"""Groups of parts, transforms, colours, captures.

A part has some of these, called in this order in each redraw: apply, capture, draw, traverse, unapply.
Matrices are 4x4 numpy arrays that act on columns; angles are degrees.
"""

import math
import sys

import numpy as np
from OpenGL import GL


MAX_TOLD = 10           # different errors
told = set()


def tell(what):
    """An exception or a text on standard error, once."""
    text = f"vismach: {type(what).__name__}: {what}" if isinstance(what, Exception) else f"vismach: {what}"
    if text not in told and len(told) < MAX_TOLD:
        told.add(text)
        print(text, file=sys.stderr)


def visit(part):
    """One part of a redraw. One that fails leaves the others as they are: it may be well again with other values."""
    for name in ("apply", "capture", "draw", "traverse", "unapply"):
        step = getattr(part, name, None)
        if step is not None:
            try:
                step()
            except Exception as error:
                tell(error)


def modelview():
    """The present matrix."""
    return np.array(GL.glGetDoublev(GL.GL_MODELVIEW_MATRIX), dtype=float).reshape(4, 4).T


def invert(matrix):
    """The inverse of a matrix of rotation and translation."""
    return np.linalg.inv(np.asarray(matrix, dtype=float))


class Collection:
    """Parts that belong together."""

    def __init__(self, parts):
        self.parts, self.vol = parts, 0

    def traverse(self):
        for part in self.parts:
            visit(part)

    def set_volume(self, volume):
        self.vol = volume

    def volume(self):
        """What was set, or the sum over the parts that know theirs."""
        return self.vol or sum(part.volume() for part in self.parts if hasattr(part, "volume"))


class Transform(Collection):
    """Parts in a frame of their own: place() changes the matrix."""

    def apply(self):
        GL.glPushMatrix()
        self.place()

    def unapply(self):
        GL.glPopMatrix()


class Translate(Transform):
    def __init__(self, parts, x, y, z):
        super().__init__(parts)
        self.where = x, y, z

    def place(self):
        GL.glTranslated(*self.where)


class Rotate(Transform):
    def __init__(self, parts, th, x, y, z):
        super().__init__(parts)
        self.where = th, x, y, z

    def place(self):
        GL.glRotated(*self.where)


class Scale(Transform):
    def __init__(self, parts, x, y, z):
        super().__init__(parts)
        self.where = x, y, z

    def place(self):
        GL.glScaled(*self.where)


class HalTranslate(Transform):
    """Along a vector times a pin."""

    def __init__(self, parts, comp, var, x, y, z):
        super().__init__(parts)
        self.comp, self.var, self.where = comp, var, (x, y, z)

    def place(self):
        value = self.comp[self.var]
        GL.glTranslated(*(value * v for v in self.where))


class HalRotate(Transform):
    """About a vector by th times a pin."""

    def __init__(self, parts, comp, var, th, x, y, z):
        super().__init__(parts)
        self.comp, self.var, self.where = comp, var, (th, x, y, z)

    def place(self):
        th, *axis = self.where
        GL.glRotated(th * self.comp[self.var], *axis)


class HalVectorTranslate(Transform):
    """By three pins (or numbers), each times scale."""

    def __init__(self, parts, comp, xvar, yvar, zvar, scale=1):
        super().__init__(parts)
        self.comp, self.names, self.scale = comp, (xvar, yvar, zvar), scale

    def place(self):
        GL.glTranslated(*(self.scale * value_of(self.comp, name) for name in self.names))


class HalVectorRotate(HalRotate):
    """As HalRotate; a subclass may say th, x, y, z by get_values()."""

    def get_values(self):
        return self.where

    def place(self):
        th, *axis = self.get_values()
        GL.glRotated(th * self.comp[self.var], *axis)


class HalRotateEuler(Transform):
    """Three turns in a row; order: digits 1, 2, 3 for x, y, z. Angles and order are numbers or pins."""
    ORDERS = (131, 121, 212, 232, 323, 313, 123, 132, 213, 231, 321, 312)

    def __init__(self, parts, comp, th1, th2, th3, order=123):
        super().__init__(parts)
        self.comp, self.angles, self.order = comp, (th1, th2, th3), order

    def place(self):
        order = value_of(self.comp, self.order)
        if order not in self.ORDERS:
            return
        for angle, axis in zip(self.angles, str(int(order))):
            GL.glRotated(value_of(self.comp, angle), *(float(axis == a) for a in "123"))


class HalScale(Transform):
    """By a vector times a pin."""

    def __init__(self, parts, comp, x, y, z, var):
        super().__init__(parts)
        self.comp, self.var, self.where = comp, var, (x, y, z)

    def place(self):
        value = self.comp[self.var]
        GL.glScaled(*(value * v for v in self.where))


class HalShow(Transform):
    """Parts of one size while the pin has the value, else of another (0: not there)."""

    def __init__(self, parts, comp, const, var, scaleby_true=1, scaleby_false=0):
        super().__init__(parts)
        self.comp, self.const, self.var = comp, const, var
        self.sizes = scaleby_false, scaleby_true
        self.shown = True

    def size(self):
        return self.sizes[self.comp[self.var] == self.const]

    def place(self):
        GL.glScaled(*[self.size()] * 3)

    def traverse(self):
        if self.size():
            super().traverse()


def value_of(comp, name):
    """A number as it is, a string as the name of a pin."""
    return comp[name] if isinstance(name, str) else name


class Capture:
    """Keeps the matrix of its place: t."""

    def __init__(self):
        self.t = np.identity(4)

    def capture(self):
        self.t = modelview()

    def volume(self):
        return 0


class Track(Transform):
    """Stands at a capture and points +Z at another; world: capture of the frame that it stands in."""

    def __init__(self, parts, position, target, world):
        super().__init__(parts)
        self.position, self.target, self.world = position, target, world

    def angles(self):
        """Position and turns (about Y after Z) in the world's frame."""
        inverse = invert(self.world.t)
        here, there = ((inverse @ c.t @ (0, 0, 0, 1))[:3] for c in (self.position, self.target))
        x, y, z = there - here
        return here, math.degrees(math.atan2(math.hypot(x, y), z)), math.degrees(math.atan2(y, x))

    def place(self):
        here, tilt, turn = self.angles()
        GL.glTranslated(*here)
        GL.glRotated(turn, 0, 0, 1)
        GL.glRotated(tilt, 0, 1, 0)


class Color(Collection):
    """Parts of one colour (red, green, blue, opacity)."""

    def __init__(self, color, parts):
        super().__init__(parts)
        self.color = tuple(color)

    def apply(self):
        self.before = [float(v) for v in GL.glGetFloatv(GL.GL_CURRENT_COLOR)]
        GL.glColor4d(*(self.color + (1.0,))[:4])

    def unapply(self):
        GL.glColor4d(*self.before)
