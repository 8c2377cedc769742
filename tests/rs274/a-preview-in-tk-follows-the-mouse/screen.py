# SPDX-License-Identifier: GPL-2.0-or-later
# A Tk window of somebody's own with a preview (rs274.OpenGLTk and GlCanonDraw): the mouse
# pans, rotates, zooms and picks.
import tempfile
import tkinter

import numpy as np
from rs274 import OpenGLTk, options
from rs274.glcanon import GLCanon, GlCanonDraw

PROGRAM = "G20 G90 F60\nG1 X1\nY1\nX0\nY0\nM2\n"


class Canon(GLCanon):
    def get_axis_mask(self): return 7
    def get_external_length_units(self): return 1 / 25.4
    def get_external_angular_units(self): return 1.0
    def get_tool(self, _number): return (-1,) + (0.0,) * 12 + (0,)
    def get_block_delete(self): return False


class View(OpenGLTk.Opengl, GlCanonDraw):
    def __init__(self, master):
        OpenGLTk.Opengl.__init__(self, master, width=300, height=200, double=1, depth=1)
        GlCanonDraw.__init__(self)
        self.drawn = 0

    def get_view(self): return 2

    def swapbuffers(self):
        self.drawn += 1
        OpenGLTk.Opengl.swapbuffers(self)


def event(*names, **more):
    for name in names:
        view.event_generate(name, **more)
    root.update()


root = tkinter.Tk()
view = View(root)
view.pack(fill="both", expand=True)
root.wait_visibility(view)
with tempfile.TemporaryDirectory() as folder:
    canon = Canon()
    canon.parameter_file = folder + "/var"
    with open(folder + "/a.ngc", "w") as file:
        file.write(PROGRAM)
    print("read:", view.load_preview(folder + "/a.ngc", canon, "G20", ""))
root.update()
print("drawn:", view.drawn > 0, "white pixels:", int((view._preview_renderer.pixels().min(axis=2) > 200).sum()) > 200)
camera = view._preview_scenes.camera
corner = [round(v) for v in camera.pixel((1.0, 0.5, 0.0), 300, 200)]
event("<ButtonPress-1>", "<ButtonRelease-1>", x=corner[0], y=corner[1])
print("picked:", view.get_highlight_line())
before = list(camera.centre), camera.size
event("<ButtonPress-1>", x=100, y=100)
event("<B1-Motion>", x=130, y=100)
print("panned:", np.round((before[0][0] - camera.centre[0]) / camera.size * 200, 3))
event("<ButtonRelease-1>", x=130, y=100)
print("a drag picks nothing else:", view.get_highlight_line())
event("<Button-4>", x=10, y=10)
print("nearer:", camera.size < before[1])
event("<ButtonPress-3>", x=100, y=100)
event("<B3-Motion>", x=100, y=116)
event("<ButtonRelease-3>", x=100, y=116)
print("farther:", camera.size > before[1])
event("<ButtonPress-2>", x=100, y=100)
event("<B2-Motion>", x=120, y=110)
print("turned:", camera.view == "", (camera.lat, camera.lon))
renderer, drawn = view._preview_renderer, []
still = renderer.draw_still
renderer.draw_still = lambda *a, **k: drawn.append(1) or still(*a, **k)
before = renderer.pixels().copy()
for change in (lambda: None, lambda: None, lambda: view.zoom(0.5), lambda: None):
    change()
    view.tkRedraw()
print("drawn anew:", len(drawn), "another picture:", bool((before != renderer.pixels()).any()))
view.fit()
print("fits again:", [round(v, 3) for v in camera.centre])
root.option_add("*Togl.traverse", "red")
options.install(root)
togl = tkinter.Frame(root, class_="Togl")
print("options:", *[togl.option_get(name, name.capitalize()) for name in (
    "straight_feed", "backplotarc", "dwell", "tool_light_y", "overlay_alpha", "arc_feed_alpha", "traverse")])
root.destroy()
