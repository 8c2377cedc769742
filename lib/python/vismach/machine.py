# SPDX-License-Identifier: GPL-2.0-or-later
"""What the programs of the supplied machines share: pins, statements of the command line, tools, links of arms."""

import math
import sys

import hal
from OpenGL import GL

from .parts import Capture, Collection, Color, HalTranslate, Transform
from .shapes import Box, CylinderZ

GREY, BLUE, RED, YELLOW, WHITE = ((.6, .6, .65, 1), (.35, .5, .75, 1), (.8, .3, .25, 1), (.95, .8, .25, 1),
                                  (.85, .85, .85, 1))
STEEL = (.75, .78, .8, 1)


def statements(names):
    """Runs the words of the command line as Python statements in `names` (globals of the program): NAME=value."""
    for word in sys.argv[1:]:
        try:
            exec(word, names)
        except Exception as error:
            sys.exit(f"{names.get('NAME', 'vismach')}: {word}: {type(error).__name__}: {error}")


def component(name, pins, bits=(), out=None):
    """The component of a machine: float inputs, bit inputs, float outputs {pin: value}. It is ready."""
    comp = hal.component(name)
    for pin in pins:
        comp.newpin(pin, hal.HAL_FLOAT, hal.HAL_IN)
    for pin in bits:
        comp.newpin(pin, hal.HAL_BIT, hal.HAL_IN)
    for pin, value in (out or {}).items():
        comp.newpin(pin, hal.HAL_FLOAT, hal.HAL_OUT)
        comp[pin] = value
    comp.ready()
    return comp


class ToolZ(CylinderZ):
    """A cutter from the origin down: pins of its length and of its radius (times `share`)."""

    def __init__(self, comp, length, radius, share=1.0, thin=1.0):
        super().__init__(comp, length, 0, 0, 0)
        self.length, self.radius, self.share, self.thin = length, radius, share, thin

    def coords(self):
        radius = max(self.comp[self.radius] * self.share, self.thin)
        return [-self.comp[self.length], radius, 0, radius]


def tool(comp, length, radius, share=1.0, thin=1.0):
    """A cutter with its capture at the tip: (parts, capture)."""
    tip = Capture()
    return [Color(YELLOW, [ToolZ(comp, length, radius, share, thin)]), HalTranslate([tip], comp, length, 0, 0, -1)], tip


class Free(Transform):
    """A transform whose matrix (columns, as numpy) comes from a function."""

    def __init__(self, parts, matrix):
        super().__init__(parts)
        self.matrix = matrix

    def place(self):
        GL.glMultMatrixd(self.matrix().T.copy())


class Link(Transform):
    """A joint of an arm by its modified Denavit-Hartenberg numbers (mm, degrees); offset: its
    angle when the pin is 0."""

    def __init__(self, parts, comp, pin, a, alpha, d, offset):
        super().__init__(parts)
        self.comp, self.pin, self.numbers = comp, pin, (a, alpha, d, offset)

    def place(self):
        """All in one matrix: OpenGL keeps 32."""
        a, alpha, d, offset = self.numbers
        GL.glRotated(alpha, 1, 0, 0)
        GL.glTranslated(a, 0, 0)
        GL.glRotated(offset + self.comp[self.pin], 0, 0, 1)
        GL.glTranslated(0, 0, d)


def arm(comp, links, hand, size, base_height):
    """A robot of turning joints; links: (pin, a, alpha, d, offset). (model, capture at the
    hand, capture at the base)."""
    tip, base = Capture(), Capture()
    parts = [hand, tip]
    for number, (pin, a, alpha, d, offset) in reversed(list(enumerate(links))):
        after = links[number + 1] if number + 1 < len(links) else None
        half, radius = (.068, .05) if number % 2 else (.06, .06)      # axes that cross: one shows through the other
        body = [Color(BLUE if number % 2 else YELLOW,
                      [CylinderZ(-size * half, size * radius, size * half, size * radius)])]
        if after and abs(after[1]) > size * .05:
            body.append(Color(GREY, [Box(0, -size * .035, -size * .035, after[1], size * .035, size * .035)]))
        if abs(d) > size * .05:
            body.append(Color(GREY, [CylinderZ(-d, size * .04, 0, size * .04)]))
        parts = [Link([*body, *parts], comp, pin, a, alpha, d, offset)]
    stand = Color(STEEL, [Box(-size * .15, -size * .15, -base_height, size * .15, size * .15,
                              -base_height + size * .03),
                          CylinderZ(-base_height, size * .1, 0, size * .08)])
    return Collection([base, stand, *parts]), tip, base


def rad(degrees):
    return math.radians(degrees)
