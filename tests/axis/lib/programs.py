# SPDX-License-Identifier: GPL-2.0-or-later
"""Seeded programs for tests of the preview, and the scenes of a mill without a window."""
import os
from types import SimpleNamespace

import gcode
import linuxcnc
from axis import reading, settings
from axis.compose import Composer

TOP = os.path.abspath(os.path.dirname(__file__) + "/../../..")
SHOWN = dict(show_program=True, show_rapids=True, program_alpha=False, show_live_plot=False, show_tool=False,
             show_extents=True, show_offsets=False, show_machine_limits=False, grid_size=0.0, highlight_line=-1,
             metric=1, coord_type=0, display_type=0)
TOOLS = [(n, 0.0, 0.0, 7.0 * n, *[0.0] * 6, 6.0, 0.0, 0.0, 0) for n in range(6)]
MILL = settings.read(linuxcnc.ini(TOP + "/configs/sim/mill/mill.ini"))


def program(r):
    """Text with offsets, rotation, G92, tool lengths, both units and arcs in every plane. r: random.Random."""
    unit = r.choice((1.0, 25.4))

    def v(reach=60.0):
        return f"{r.uniform(-reach, reach) / unit:.4f}"
    lines = ["G21" if unit == 1.0 else "G20", f"G90 F{100 / unit:.3f} G17"]
    for _ in range(r.randint(6, 14)):
        lines.append(r.choice((
            f"G0 X{v()} Y{v()} Z{v()}", f"G1 X{v()} Y{v()}", f"G1 Z{v()}",
            f"G10 L2 P1 X{v(20)} Y{v(20)} Z{v(20)} R{r.choice((0, 30, -45))}",
            f"G92 X{v(20)} Z{v(20)}", "G92.1", f"G43 H{r.randint(1, 5)}", "G49", f"G53 G0 Z{v()}",
            f"G5{r.randint(4, 6)}", f"G17 G1 X0 Y0\nG2 X0 Y0 I{v(30)} J{v(30)}",
            f"G18 G1 X0 Z0\nG3 X0 Z0 I{v(30)} K{v(30)} Y{v()}\nG17",
            f"G19 G1 Y0 Z0\nG2 Y0 Z0 J{v(30)} K{v(30)}\nG17")))
    return "\n".join(lines + ["G1 X0 Y0", "M2", ""])


def composer():
    return Composer(MILL, SimpleNamespace(**SHOWN))


def load(path, var, composer):
    """A program read into a composer: gcode.Program."""
    loaded = gcode.load(path, var, ["G21"], tools=TOOLS, axis_mask=7, linear_units=1.0)
    composer.set_program(reading.Program.of(loaded, 60.0),
                         [reading.drawing(loaded, *place) for place in composer.places()])
    return loaded
