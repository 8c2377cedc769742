# SPDX-License-Identifier: GPL-2.0-or-later
"""The command of a touch-off, and the check of what was typed. No widgets here."""

import math
import os
import re
import tempfile

import gcode
from kerf.language import _

from .settings import MM_PER_INCH

G8_ACTIVE = 80           # modal code: lathe radius mode
G21_ACTIVE = 210
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)")      # of the G-code language


def unit_text(letter, settings, stat, metric):
    """Unit shown behind the value."""
    if settings.axis_type(letter) == "ANGULAR":
        return "°"
    unit = "mm" if metric else "in"
    if settings.lathe and letter == "X":
        unit += " radius" if G8_ACTIVE in stat.gcodes else " diameter"
    return unit


def scale_text(letter, settings, stat, metric):
    """Factor from the units shown to the program's units."""
    if settings.axis_type(letter) == "ANGULAR":
        return "%.12f" % 1.0
    scale = (1 / MM_PER_INCH if metric else 1.0) * (MM_PER_INCH if G21_ACTIVE in stat.gcodes else 1.0)
    return "%.12f" % scale


def brackets(text):
    """What is wrong with the brackets, or None."""
    depth = 0
    for c in text:
        depth += (c == "[") - (c == "]")
        if depth < 0:
            return _("Unbalanced [")
    return _("Unbalanced [") if depth else None


class Checker:
    """Evaluates expressions with an interpreter of its own, on a private parameter file."""

    def __init__(self, settings, parameter_file):
        self.settings, self.file = settings, parameter_file

    def __call__(self, text):
        """(value, None) or (None, what is wrong)."""
        text = text.strip()
        if not text:
            return None, _("Enter a number")
        wrong = brackets(text)
        if wrong:
            return None, wrong
        if NUMBER.fullmatch(text):
            return float(text), None
        with tempfile.NamedTemporaryFile("w", suffix=".ngc", delete=False) as f:
            # no rotation, radius or offset touches the length of this move
            f.write(f"G91 G0 Z0\nG1 F100 Z[{text}]\nM2\n")
        try:
            result = gcode.load(f.name, self.file, ["G20"], ini=self.settings.ini_path)
        finally:
            os.unlink(f.name)
        if result.error:
            return None, result.error.splitlines()[0]
        positions, last = memoryview(result.positions), result.n_vertices - 1
        return (math.copysign(result.cutting_length, positions[last, 2] - positions[last - 1, 2] if last > 0 else 0.0),
                None)
