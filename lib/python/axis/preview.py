# SPDX-License-Identifier: GPL-2.0-or-later
"""The preview: a Tk canvas with the tool path, drawn in memory by kerf_raster.

The program, grid, extents and limits are one layer that is drawn only when they or the view
change; the live plot and the tool are drawn over a copy of it in every update.
"""

import tkinter as tk
from tkinter import font as tkfont

import kerf_raster
import numpy as np

from . import scene
from .camera import LATHE, Camera

COLOURS = {
    "back": "#000000", "straight_feed": "#ffffff", "arc_feed": "#ffffff", "traverse": "#4c8080", "selected": "#00ffff",
    "grid": "#262626", "limits": "#ff0000", "label_ok": "#ff8287", "label_limit": "#ff353a", "small_origin": "#00ffff",
    "axis_x": "#33ff33", "axis_y": "#ff3333", "axis_z": "#3333ff", "cone": "#ffffff", "overlay_foreground": "#ffffff", "box": "#91adb5", "dwell": "#ff8080",
}
# motion types of the logger: jog, traverse, feed, arc, tool change, probe
PLOT = ((255, 255, 0, 190), (76, 128, 128, 64), (192, 64, 64, 190), (192, 64, 128, 190), (255, 165, 0, 64), (160, 32, 240, 190))
CONE_RADIUS, CONE_HEIGHT = 0.1, 0.25
NO_LIMIT = 1e30


def rgba(text, alpha=255):
    return (int(text[1:3], 16), int(text[3:5], 16), int(text[5:7], 16), alpha)


class Preview(tk.Canvas):
    """What is shown comes from `options` (an object with the screen's variables) and `status`."""

    def __init__(self, parent, settings, options, logger):
        super().__init__(parent, highlightthickness=0, background=COLOURS["back"], width=300, height=200)
        self.s, self.options, self.logger = settings, options, logger
        self.camera = Camera()
        self.colours = dict(COLOURS)
        for name in self.colours:       # X resources: *Togl.<name>
            given = self.option_get(f"Togl.{name}", "Togl") or ""
            if given.startswith("#") and len(given) == 7:
                self.colours[name] = given
        self.program = None
        self.stat = None
        self.readout_lines = []
        self.marks = []                 # (homed, on a limit) of each line
        self.layer = self.frame = None
        self.dirty = True
        self.pending = False
        self.plot_size = -1
        self.image = None
        self.item = self.create_image(0, 0, anchor="nw")
        self.font = tkfont.Font(self, family="DejaVu Sans Mono", size=13)
        self.on_select = lambda line: None
        self.bind_mouse()
        self.bind("<Configure>", lambda event: self.invalidate())

    # -- mouse -----------------------------------------------------------------------------

    def bind_mouse(self):
        self.drag = None
        for button, kind in ((1, "left"), (2, "rotate"), (3, "zoom")):
            self.bind(f"<Button-{button}>", lambda e, k=kind: self.press(e, k))
            self.bind(f"<B{button}-Motion>", self.move)
            self.bind(f"<ButtonRelease-{button}>", self.release)
        self.bind("<Button-4>", lambda e: self.zoomin())
        self.bind("<Button-5>", lambda e: self.zoomout())

    def press(self, event, kind):
        if kind == "left":
            kind = "rotate" if self.options.rotate_mode else "pan"
            if event.state & 1:
                kind = "pan" if kind == "rotate" else "rotate"
            elif event.state & 4:
                kind = "zoom"
        if kind == "rotate" and self.s.lathe:
            kind = "pan"
        self.drag = [kind, event.x, event.y, event.num == 1]

    def move(self, event):
        if not self.drag:
            return
        kind, x, y, _ = self.drag
        dx, dy = event.x - x, event.y - y
        if self.drag[3] and abs(dx) + abs(dy) < 3:
            return
        self.drag[1:] = [event.x, event.y, False]
        if kind == "pan":
            self.camera.pan(dx, dy, self.winfo_width(), self.winfo_height())
        elif kind == "rotate":
            self.camera.rotate(dx, dy)
        else:
            self.camera.zoom_by_drag(dy)
        self.view_changed()

    def release(self, event):
        drag, self.drag = self.drag, None
        if drag and drag[0] == "rotate" and not drag[3]:
            self.camera.end_rotation()
            self.view_changed()
        elif drag and drag[3]:
            self.on_select(self.line_at(event.x, event.y))

    def line_at(self, x, y):
        """Program line under a pixel, or -1."""
        if not self.program or not self.options.show_program:
            return -1
        w, h = self.winfo_width(), self.winfo_height()
        vertex = kerf_raster.pick(self.program.positions, self.program.kinds, self.palette(), self.camera.matrix(w, h), w, h, x, y, 5.0)
        return int(np.asarray(self.program.lines)[vertex]) if vertex >= 0 else -1

    # -- views -----------------------------------------------------------------------------

    def set_view(self, name):
        self.camera.set_view(LATHE.get(name, name) if self.s.lathe else name)
        self.fit()

    def fit(self):
        """Centres on the program, or on the machine's limits when there is none."""
        low, high = self.extents() or self.limits() or ((0, 0, 0), (1, 1, 1))
        self.camera.fit(low, high)
        self.view_changed()

    def view_changed(self):
        self.options.view_type = self.camera.number
        self.invalidate()

    def zoomin(self):
        self.camera.zoom_in()
        self.view_changed()

    def zoomout(self):
        self.camera.zoom_out()
        self.view_changed()

    # -- contents --------------------------------------------------------------------------

    def set_program(self, program):
        self.program = program
        self.fit()

    def extents(self):
        if not self.program or self.program.n_moves == 0:
            return None
        low, high = self.program.extents
        return (low, high) if all(abs(v) < NO_LIMIT for v in (*low, *high)) else None

    def limits(self):
        """Soft limits of X, Y and Z less the tool offset, or None before the first status."""
        if self.stat is None:
            return None
        scale = 1 / (self.s.units_per_mm * 25.4)
        low, high = [], []
        for i in range(3):
            axis = self.stat.axis[i]
            a, b = axis["min_position_limit"], axis["max_position_limit"]
            offset = self.stat.tool_offset[i]
            low.append((0.0 if abs(a) > NO_LIMIT else a - offset) * scale)
            high.append((0.0 if abs(b) > NO_LIMIT else b - offset) * scale)
        return (tuple(low), tuple(high)) if all(h > l for l, h in zip(low[:2], high[:2])) else None

    def clear_plot(self):
        self.logger.clear()
        self.plot_size = -1
        self.redraw_soon()

    def invalidate(self):
        """The still layer must be drawn anew."""
        self.dirty = True
        self.redraw_soon()

    def redraw_soon(self):
        if not self.pending:
            self.pending = True
            self.after_idle(self.redraw)

    # -- drawing ---------------------------------------------------------------------------

    def palette(self):
        alpha = (85, 85, 128) if self.options.program_alpha else (255, 255, 255)
        rapid = rgba(self.colours["traverse"], alpha[0] if self.options.show_rapids else 0)
        return [rapid, rgba(self.colours["straight_feed"], alpha[1]), rgba(self.colours["arc_feed"], alpha[2]), (0, 0, 0, 0)]

    def lines(self, raster, arrays, colour, matrix, width=1, alpha=255):
        points, kinds = arrays
        if len(points) > 1:
            raster.draw(points, kinds, [(0, 0, 0, 0), rgba(self.colours[colour], alpha)], matrix, 0, len(points), width)

    def draw_still(self, w, h, matrix):
        if self.layer is None or (self.layer.width, self.layer.height) != (w, h):
            self.layer, self.frame = kerf_raster.Raster(w, h), kerf_raster.Raster(w, h)
        o, r = self.options, self.layer
        r.clear(rgba(self.colours["back"]))
        if o.grid_size > 0:
            plane = {"x": (1, 2), "y": (0, 2), "y2": (0, 2), "lathe": (0, 2), "lathe2": (0, 2)}.get(self.camera.view, (0, 1))
            rotation = self.stat.rotation_xy if self.stat else 0.0
            self.lines(r, scene.grid(o.grid_size, self.camera.centre, 2 * self.camera.size, plane, rotation), "grid", matrix)
        if self.program and o.show_program:
            r.draw(self.program.positions, self.program.kinds, self.palette(), matrix)
            self.draw_highlight(r, matrix)
        labels = self.draw_extents(r, matrix)
        if self.stat is not None:
            self.draw_origin(r, matrix, labels)
        if o.show_machine_limits and self.limits():
            self.lines(r, scene.box(*self.limits()), "limits", matrix)
        self.show_labels(labels, w, h)

    def draw_highlight(self, raster, matrix):
        line = self.options.highlight_line
        if line <= 0:
            return
        numbers = np.asarray(self.program.lines)
        kinds = (numbers == line).astype(np.uint8)
        if not kinds.any():
            return
        where = np.flatnonzero(kinds)
        first, last = max(0, int(where[0]) - 1), int(where[-1]) + 1
        raster.draw(self.program.positions, kinds, [(0, 0, 0, 0), rgba(self.colours["selected"])], matrix, first, last, 3)

    def draw_extents(self, raster, matrix):
        """Dimension lines; returns labels as (place, text, colour)."""
        extents, o = self.extents(), self.options
        if extents is None or not (o.show_extents or not o.show_program):
            return []
        low, high = extents
        if not o.show_program:
            self.lines(raster, scene.box(low, high), "box", matrix)
        limits = self.limits()
        labels = []
        out = self.camera.basis()[2]
        for axis in range(3):
            if abs(out[axis]) > 0.999 or high[axis] - low[axis] < 1e-6:
                continue
            beside = {0: 1, 1: 0, 2: 0}[axis]
            if abs(out[beside]) > 0.999:
                beside = 2 if axis != 2 else 1
            points, kinds, texts = scene.dimension(low, high, axis, beside, o.metric)
            over = limits is not None and (low[axis] < limits[0][axis] - 1e-6 or high[axis] > limits[1][axis] + 1e-6)
            colour = "label_limit" if over else "label_ok"
            self.lines(raster, (points, kinds), colour, matrix)
            labels += [(place, text, colour) for place, text in texts]
        return labels

    def draw_origin(self, raster, matrix, labels):
        scale = 1 / (self.s.units_per_mm * 25.4)
        offset = [scale * (self.stat.g5x_offset[i] + self.stat.g92_offset[i]) for i in range(3)]
        origin = tuple(offset) if self.options.coord_type else (0.0, 0.0, 0.0)
        for name, arrays in zip("xyz", scene.axes(origin, self.stat.rotation_xy)):
            self.lines(raster, arrays, f"axis_{name}", matrix, 2)
            labels.append((tuple(arrays[0][1]), name.upper(), f"axis_{name}"))
        if self.options.coord_type and any(offset):
            self.lines(raster, scene.origin_mark(), "small_origin", matrix)

    def show_labels(self, labels, w, h):
        self.delete("label")
        for place, text, colour in labels:
            at = self.camera.pixel(place, w, h)
            if at and -50 < at[0] < w + 50 and -50 < at[1] < h + 50:
                self.create_text(*at, text=text, fill=self.colours[colour], tags="label", anchor="s")

    def draw_live(self, matrix):
        o, r = self.options, self.frame
        if o.show_live_plot:
            data, count, _ = self.logger.points()
            if count > 1:
                records = np.frombuffer(data, dtype=[("p", "f4", 3), ("c", "u1", 4), ("q", "f4", 3), ("d", "u1", 4)], count=count)
                points = np.ascontiguousarray(records["p"])
                packed = records["c"].copy().view("u4").reshape(-1)
                values, kinds = np.unique(packed, return_inverse=True)
                palette = [tuple(int(b) for b in np.array([v], "u4").view("u1")) for v in values[:255]]
                r.draw(points, kinds.astype(np.uint8), palette, matrix, 0, count, 2)
        if o.show_tool and self.stat is not None:
            self.draw_tool(r, matrix)

    def draw_tool(self, raster, matrix):
        scale = 1 / (self.s.units_per_mm * 25.4)
        at = tuple((self.stat.actual_position[i] - self.stat.tool_offset[i]) * scale for i in range(3))
        tool = self.stat.tool_table[0] if self.stat.tool_in_spindle > 0 else None
        diameter = tool.diameter * scale if tool is not None else 0.0
        if tool is not None and self.s.lathe and 1 <= tool.orientation <= 9:
            arrays = scene.lathe_tool(at, diameter, tool.frontangle, tool.backangle, tool.orientation)
        elif diameter > self.options.min_tool_diameter and not self.s.lathe:
            arrays = scene.cylinder(at, diameter / 2, 4 * diameter)
        elif tool is not None and self.s.lathe:
            return
        else:
            size = self.options.cone_size
            extents = self.extents()
            if self.options.cone_scaling:
                size *= max(2.0, *([b - a for a, b in zip(*extents)] if extents else [2.0]))
            arrays = scene.cone(at, CONE_RADIUS * size, CONE_HEIGHT * size)
        self.lines(raster, arrays, "cone", matrix, alpha=200)

    def redraw(self):
        self.pending = False
        w, h = self.winfo_width(), self.winfo_height()
        if w < 10 or h < 10:
            return
        matrix = self.camera.matrix(w, h)
        if self.dirty:
            self.dirty = False
            self.draw_still(w, h, matrix)
        self.frame.assign(self.layer)
        self.draw_live(matrix)
        user_plot = getattr(self, "user_plot", None)
        if user_plot:
            try:
                user_plot()
            except Exception:           # a user's drawing never stops the screen
                pass
        self.image = tk.PhotoImage(data=self.frame.ppm(), format="PPM")
        self.itemconfigure(self.item, image=self.image)
        self.show_readout()

    def show_readout(self):
        self.delete("readout")
        if not self.readout_lines:
            return
        self.font.configure(size=22 if self.options.dro_large_font else 13)
        text = "\n".join(line for line in self.readout_lines if line)
        step = self.font.metrics("linespace")
        item = self.create_text(2 * step, step / 2, text=text, font=self.font, anchor="nw", tags="readout",
                                fill=self.colours["overlay_foreground"])
        y0 = self.bbox(item)[1]
        for row, (homed, limit) in enumerate(self.marks):
            y = y0 + (row + 0.5) * step
            if homed:
                self.create_text(step, y, text="⌂", fill="#8fd694", font=self.font, tags="readout")
            if limit:
                self.create_text(step / 3, y, text="!", fill=self.colours["label_limit"], font=self.font, tags="readout")
