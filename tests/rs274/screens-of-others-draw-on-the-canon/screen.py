# SPDX-License-Identifier: GPL-2.0-or-later
# A screen that draws with rs274.glcanon.GlCanonDraw, as one that shows a program beside its own controls does.
import os
import sys
import tempfile
from types import SimpleNamespace

import numpy as np
from kerf import gl
from rs274.glcanon import GLCanon, GlCanonDraw
from rs274.interpret import StatMixin

SIZE = 320, 240
PROGRAM = "G21 G90 F600\nG0 X0 Y0 Z5\nG1 Z0\nX50\nG2 X50 Y40 J20 I0\nG1 X0\nY0\nG4 P1\nM2\n"


def status(**other):
    axis = dict(min_position_limit=-100.0, max_position_limit=100.0)
    tool = (0, *[0.0] * 12, 0)
    values = dict(axis=[axis] * 9, tool_offset=[0.0] * 9, g5x_offset=[0.0] * 9, g92_offset=[0.0] * 9, g5x_index=1,
                  rotation_xy=0.0, axis_mask=7, position=[10.0, 20.0, 5.0] + [0.0] * 6, actual_position=[0.0] * 9,
                  joint_position=[1.0] * 9, joint_actual_position=[0.0] * 9,
                  tool_in_spindle=0, tool_table=[tool] * 3, homed=(1, 0, 1) + (0,) * 13,
                  limit=(0, 2) + (0,) * 14, dtg=[0.0] * 9, distance_to_go=0.0, current_vel=2.0, linear_units=1.0,
                  angular_units=1.0, block_delete=False)
    return SimpleNamespace(**values | other)


class Canon(GLCanon, StatMixin):
    def __init__(self, stat, colors, folder):
        GLCanon.__init__(self, colors, "XYZABCUVW")
        StatMixin.__init__(self, stat, False)
        self.parameter_file = folder + "/var"


class Screen(GlCanonDraw):
    """What a toolkit's widget gives, off screen."""

    def __init__(self, stat, off):
        GlCanonDraw.__init__(self, stat)
        self.init_glcanondraw("XYZ")
        self.off, self.calls, self.view, self.hidden = off, [], 2, set()

    def activate(self):
        self.calls.append("activate")
        return True

    def deactivate(self): self.calls.append("deactivate")
    def swapbuffers(self): self.calls.append("swap")
    def winfo_width(self): return SIZE[0]
    def winfo_height(self): return SIZE[1]
    def get_view(self): return self.view
    def get_show_program(self): return "program" not in self.hidden
    def get_show_extents(self): return "extents" not in self.hidden
    def get_show_limits(self): return False
    def get_show_tool(self): return "tool" not in self.hidden
    def user_plot(self): self.calls.append("user_plot")

    def picture(self):
        self.calls.clear()
        self.redraw()
        return self._preview_renderer.pixels().copy()


def changed(a, b):
    return int((np.abs(a.astype(int) - b).max(axis=2) > 30).sum())


with tempfile.TemporaryDirectory() as folder, gl.OffScreen(*SIZE) as off:
    path = folder + "/part.ngc"
    with open(path, "w") as file:
        file.write(PROGRAM)
    stat = status()
    screen = Screen(stat, off)
    empty = screen.picture()
    canon = Canon(stat, screen.colors, folder)
    print("read:", screen.load_preview(path, canon, "G21", "G53 G0 X0"), screen.canon is canon)
    print("extents in mm:", *([round(25.4 * v, 3) for v in e] for e in (canon.min_extents, canon.max_extents)))
    full = screen.picture()
    print("calls:", *screen.calls)
    print("the program appears:", changed(empty, full) > 300)
    for name in ("program", "extents", "tool"):
        screen.hidden = {name}
        print(f"without {name} there is less:", changed(full, screen.picture()) > 20)
    screen.hidden = set()
    screen.get_current_tool = lambda: SimpleNamespace(id=4, diameter=12.0, frontangle=0.0, backangle=0.0, orientation=0)
    print("a tool of the screen's own:", changed(full, screen.picture()) > 50)
    del screen.get_current_tool
    screen.redraw()
    # a point of the line X50 in the picture, and one beside everything
    at = screen._preview_scenes.camera.pixel((1.0, 0.0, 0.0), *SIZE)
    screen.select(*at)
    print("picked line:", screen.get_highlight_line(), "shown:", changed(full, screen.picture()) > 20)
    screen.select(SIZE[0] - 3, SIZE[1] - 3)
    print("picked beside:", screen.get_highlight_line())
    screen.view = 0
    print("another view:", changed(full, screen.picture()) > 300)
    screen.view = 2
    screen.colors["back"] = (0.0, 0.0, 1.0)
    print("its own ground:", list(map(int, screen.picture()[SIZE[1] // 2, SIZE[0] - 2])))
    limits, homed, short, long = screen.posstrs()
    print("\n".join(short + ["--"] + long), limits, homed, sep="\n")
    print("inches:", screen.to_internal_units([25.4, 50.8, 0, 90, 0, 0, 25.4, 0, 0]),
          screen.to_internal_linear_unit(1.0, 1 / 25.4), screen.from_internal_units([1.0] * 4)[2:])
    for size in (1, 9):
        screen.set_cone_basesize(size)
        print("cone:", screen.cone_basesize)
    with open(path, "w") as file:
        file.write("G21\nG1 X1 F100\n(AXIS,stop)\nX9\nM2\n")
    canon = Canon(stat, screen.colors, folder)
    screen.load_preview(path, canon, "G21", "")
    print("stopped:", canon.preview_incomplete, round(25.4 * canon.max_extents[0], 3))
sys.stdout.flush()
os._exit(0)         # OSMesa's context is not to be freed twice
