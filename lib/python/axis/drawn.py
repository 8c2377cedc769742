# SPDX-License-Identifier: GPL-2.0-or-later
"""The preview without OpenGL: a canvas with a picture that kerf_raster draws in memory.

The still layer is drawn when it or the view changes, the plot is added to it as it grows; what
moves is drawn over a copy of it.
"""

import time
import tkinter as tk
from tkinter import font as tkfont

import kerf_raster
import numpy as np
from kerf.glpath import EXACT_PX, PLOT_TAIL
from kerf.pace import Pace

NOTHING = (0, 0, 0, 0)


def rgba(colour):
    """Four numbers 0..255 of a colour given as 0..1."""
    return tuple(max(0, min(255, round(255 * c))) for c in colour)


def web(colour):
    return "#%02x%02x%02x" % rgba(colour)[:3]


def paint(raster, items, matrix):
    """Lines of a scene; faces are left out."""
    for item in items:
        points = np.ascontiguousarray(item.vertices, np.float32)
        if len(points) > 1 and not item.triangles:
            raster.draw(points, np.ascontiguousarray(item.kinds, np.uint8), [NOTHING, rgba(item.colour)], matrix,
                        0, len(points), max(1, round(item.width)))


def still_steps(raster, scene, matrix, pace, budget=0):
    """Draws the still layer without its labels: with a budget (of vertices) at once, exact in slices. Ends with its
    exactness."""
    raster.clear(rgba(scene.back))
    paint(raster, scene.before, matrix)
    exact = True
    for drawing, palette in zip(scene.drawings, scene.palettes):
        colours = [rgba(c) for c in palette[:3]] + [NOTHING]
        level, first, count, _, good = drawing.choose(matrix, raster.width, raster.height, EXACT_PX, budget)
        exact = exact and good
        for part in [(first, count)] if budget else pace.slices(first, count):
            began = time.monotonic()
            raster.draw_pieces(drawing, colours, matrix, level, *part)
            if not budget:
                pace.slice_took(time.monotonic() - began)
                yield None
    for number, first, last in scene.selected_spans:
        drawing = scene.drawings[number]
        raster.draw(drawing.vertices, drawing.kinds, [rgba(scene.selected)] * 3 + [NOTHING], matrix, first, last, 3)
    paint(raster, scene.after, matrix)
    yield exact


def paint_still(raster, scene, matrix):
    """The still layer without its labels, exact."""
    for _ in still_steps(raster, scene, matrix, Pace()):
        pass


class DrawnPicture(tk.Canvas):
    """Shows scenes (kerf.glpath.Scene)."""
    kind = "drawn"

    def __init__(self, parent):
        super().__init__(parent, highlightthickness=0, borderwidth=0, background="#000000")
        self.layer = self.frame = self.image = None
        self.item = self.create_image(0, 0, anchor="nw")
        self.fonts = {}
        self.plotted = 0         # points of the plot that are in the still layer
        self.pace, self.exact, self.steps, self.fine = Pace(), True, None, None
        self.began = None            # when the still layer was drawn that is not yet seen

    def font(self, size):
        if size not in self.fonts:
            self.fonts[size] = tkfont.Font(self, family="DejaVu Sans Mono", size=-size)
        return self.fonts[size]

    def draw_still(self, scene, matrix, width, height, label_size):
        if self.layer is None or (self.layer.width, self.layer.height) != (width, height):
            self.layer, self.frame = kerf_raster.Raster(width, height), kerf_raster.Raster(width, height)
        self.plotted, self.began = 0, time.monotonic()
        *_, self.exact = still_steps(self.layer, scene, matrix, self.pace, self.pace.budget)
        self.steps = None
        if not self.exact:
            self.fine = kerf_raster.Raster(width, height)
            self.steps = still_steps(self.fine, scene, matrix, self.pace)
        self.delete("label")
        for x, y, text, colour, box in scene.labels:
            made = self.create_text(x, y, text=text, fill=web(colour), font=self.font(label_size),
                                    anchor="s", tags="label")
            if box:
                self.create_rectangle(*self.bbox(made), outline=web(colour), tags="label")

    def release(self, drawings):
        """drawings: these are gone, the picture stays as it is."""
        if drawings:
            self.steps, self.exact = None, True      # as exact as it will be

    def step(self):
        """One slice of the exact drawing; True when it is complete."""
        if self.steps is None or next(self.steps) is None:
            return False
        self.layer, self.fine, self.steps = self.fine, None, None
        self.plotted, self.exact = 0, True
        return True

    def draw_frame(self, scene, matrix):
        r = self.frame
        if scene.plot is None:
            r.assign(self.layer)
        elif not self.draw_plot(scene):
            return False
        paint(r, scene.live, matrix)
        self.image = tk.PhotoImage(master=self, data=r.ppm(), format="PPM")
        self.itemconfigure(self.item, image=self.image)
        self.delete("text")
        for x0, y0, x1, y1, colour in scene.panels:
            if colour[3] > 0:
                self.create_rectangle(x0, y0, x1, y1, fill=web(colour), outline="",
                                      stipple="gray75" if colour[3] < 1 else "", tags="text")
        for x, y, text, colour, size in scene.texts:
            self.create_text(x, y, text=text, fill=web(colour), font=self.font(size), anchor="nw", tags="text")
        if self.began is not None:
            self.pace.frame_took(time.monotonic() - self.began, self.exact)
            self.began = None
        return True

    def draw_plot(self, scene):
        """The plot: what will not change any more into the still layer, its end into the frame. False: it was
        shortened."""
        data, count, second = scene.plot
        if count < self.plotted:
            return False
        if count - PLOT_TAIL > self.plotted + 1:
            self.layer.draw_plot(data, scene.plot_matrix, max(0, self.plotted - 1), count - PLOT_TAIL, bool(second))
            self.plotted = count - PLOT_TAIL
        self.frame.assign(self.layer)
        self.frame.draw_plot(data, scene.plot_matrix, max(0, self.plotted - 1), count, bool(second))
        return True

    def exposed(self):
        return False

    def close(self):
        pass
