# SPDX-License-Identifier: GPL-2.0-or-later
"""Positions of the status channel in the system that programs use."""

import math

from .inivalues import LETTERS


def relative(stat, position):
    """Nine values in machine units, without tool offset, work offset, rotation and G92."""
    p = [position[i] - stat.tool_offset[i] - stat.g5x_offset[i] for i in range(9)]
    if stat.rotation_xy:
        t = math.radians(-stat.rotation_xy)
        p[0], p[1] = p[0] * math.cos(t) - p[1] * math.sin(t), p[0] * math.sin(t) + p[1] * math.cos(t)
    return [p[i] - stat.g92_offset[i] for i in range(9)]


def coordinate(stat, letter):
    """What a program calls the present place of an axis, in machine units; None: the machine has no such axis."""
    i = LETTERS.index(letter.upper())
    return relative(stat, stat.actual_position)[i] if stat.axis_mask & (1 << i) else None
