# SPDX-License-Identifier: GPL-2.0-or-later
"""What the preview shows of the program, the machine and the tool, as a scene (kerf.glpath.Scene).

No widgets here: the same scenes are drawn on the screen and, for tests and pictures, off screen.
Inches.
"""

import numpy as np
from kerf.glpath import Item, Scene

from . import shapes
from .camera import Camera
from .dro import SYSTEMS
from .program import beyond, extents, foam_planes

COLOURS = {     # names of the X resources *Togl.<name>
    "back": "#000000", "straight_feed": "#ffffff", "arc_feed": "#ffffff", "traverse": "#4c8080", "selected": "#00ffff",
    "grid": "#262626", "limits": "#ff0000", "label_ok": "#ff8287", "label_limit": "#ff353a", "small_origin": "#00ffff",
    "axis_x": "#33ff33", "axis_y": "#ff3333", "axis_z": "#3333ff", "cone": "#ffffff", "cone_xy": "#00ff00",
    "cone_uv": "#0000ff",
    "overlay_foreground": "#ffffff", "overlay_background": "#000000", "box": "#91adb5", "dwell": "#ff8080",
    "m1xx": "#8080ff",
    "lathetool": "#cccccc", "tool_diffuse": "#999999", "straight_feed_xy": "#40ff40", "arc_feed_xy": "#40ff40",
    "straight_feed_uv": "#4040ff", "arc_feed_uv": "#4040ff", "traverse_xy": "#4c8080", "traverse_uv": "#4c8080",
    "backplotjog": "#ffff00", "backplottraverse": "#4c8080", "backplotfeed": "#c04040", "backplotarc": "#c04080",
    "backplottoolchange": "#ffa500",
    "backplotprobing": "#a020f0"}
ALPHA = {"overlay_alpha": 0.75, "traverse_alpha": 1 / 3, "straight_feed_alpha": 1 / 3, "arc_feed_alpha": 0.5,
         "tool_alpha": 0.2, "lathetool_alpha": 0.1} | {
    f"{name}_alpha_{plane}": 1 / 3 for name in ("traverse", "straight_feed", "arc_feed") for plane in ("xy", "uv")} | {
    "backplotjog_alpha": 0.75, "backplottraverse_alpha": 0.25, "backplotfeed_alpha": 0.75, "backplotarc_alpha": 0.75,
    "backplottoolchange_alpha": 0.25, "backplotprobing_alpha": 0.75}
PLOT = "jog", "traverse", "feed", "arc", "toolchange", "probing"        # motion types, in the logger's order
CONE_RADIUS, CONE_HEIGHT = 0.1, 0.25
NO_LIMIT = 1e30


def rgb(text, alpha=1.0):
    return (int(text[1:3], 16) / 255, int(text[3:5], 16) / 255, int(text[5:7], 16) / 255, alpha)


def plot_colours(colours, alpha):
    """Of linuxcnc.positionlogger: four numbers 0..255 for each motion type."""
    return [tuple(round(255 * v) for v in rgb(colours["backplot" + name], alpha[f"backplot{name}_alpha"]))
            for name in PLOT]


class Composer:
    """settings: axis.settings.Settings; options: an object with the screen's variables; logger: linuxcnc.positionlogger
    or None; text_px: height of letters."""

    def __init__(self, settings, options, logger=None, text_px=13):
        self.s, self.options, self.logger, self.text_px = settings, options, logger, text_px
        self.unit = 1 / (settings.units_per_mm * 25.4)       # inches of a machine unit
        self.camera = Camera()
        self.colours, self.alpha = dict(COLOURS), dict(ALPHA)
        self.foam_z, self.foam_w = settings.foam_z, settings.foam_w
        self.program = None
        self.drawings = []
        self.unturned = None, None      # (degrees, centre), extents as they are without that rotation
        self.boxed = False              # only the bounding box is shown
        self.stat = None
        self.readout_lines = []
        self.marks = []                 # (homed, on a limit) of each line
        self.scene = Scene(back=rgb(self.colours["back"]))
        self.place_planes()

    # -- contents --------------------------------------------------------------------------

    def set_program(self, program, drawings, boxed=False):
        """program: reading.Program; drawings: kerf_raster.Drawing of each place; boxed: only
        its bounding box is drawn."""
        self.program, self.boxed, self.drawings = program, boxed, drawings
        self.unturned = None, None
        if program is not None:
            self.foam_z, self.foam_w = foam_planes(program, self.s)
            self.place_planes()
        self.camera.fit(*self.shown_box())

    def places(self):
        """How the nine axes become points of each drawing (reading.drawing)."""
        offset = [0.0] * 9 if self.stat is None else self.offset_nine()
        planes = ((0, self.s.foam_z), (1, self.s.foam_w)) if self.s.foam else ((-1, 0.0),)
        return [(plane, z, self.s.geometry, offset, self.s.coordinates) for plane, z in planes]

    def place_planes(self):
        """The live plot of a foam cutter has the heights of the planes."""
        if self.s.foam and self.logger:
            self.logger.set_depth(self.foam_z / self.unit, self.foam_w / self.unit)

    def shown_box(self):
        """What a fitting view shows: the program as it is drawn (rotary axes may turn it anywhere), or the machine's
        limits when there is none."""
        drawn = [d.extents for d in self.drawings if d.extents]
        if drawn:
            return (tuple(map(min, *(e[0] for e in drawn), drawn[0][0])),
                    tuple(map(max, *(e[1] for e in drawn), drawn[0][1])))
        return self.extents() or self.limits() or ((0, 0, 0), (1, 1, 1))

    def extents(self, turn=0.0, about=(0.0, 0.0)):
        """Least and greatest of the program (without tool lengths), or None. turn: along axes X and Y that are turned
        by that many degrees, told as if the program were turned back about a point."""
        p = self.program
        if p is None or p.n_moves == 0:
            return None
        low, high = extents(p, self.s)
        if turn and self.drawings:
            if self.unturned[0] != (turn, about):
                drawn = np.asarray(self.drawings[0].vertices)
                t, x, y = np.radians(turn), drawn[:, 0] - about[0], drawn[:, 1] - about[1]
                u, v = x * np.cos(t) + y * np.sin(t) + about[0], y * np.cos(t) - x * np.sin(t) + about[1]
                self.unturned = (turn, about), ((u.min(), v.min()), (u.max(), v.max()))
            low, high = ((*flat, end[2]) for flat, end in zip(self.unturned[1], (low, high)))
        if not all(abs(v) < NO_LIMIT for v in (*low, *high)):
            return None
        return low, high

    def limits(self):
        """Soft limits of X, Y and Z less the tool offset, or None before the first status."""
        if self.stat is None:
            return None
        low, high = [], []
        for i in range(3):
            axis = self.stat.axis[i]
            a, b = axis["min_position_limit"], axis["max_position_limit"]
            offset = self.stat.tool_offset[i]
            low.append((0.0 if abs(a) > NO_LIMIT else a - offset) * self.unit)
            high.append((0.0 if abs(b) > NO_LIMIT else b - offset) * self.unit)
        return (tuple(low), tuple(high)) if any(h > l for l, h in zip(low, high)) else None

    # -- the still layer -------------------------------------------------------------------

    def colour(self, name, alpha=1.0):
        return rgb(self.colours[name], alpha)

    def palettes(self):
        """Colours of traverse, feed and arc for each drawing."""
        o, lists = self.options, []
        for suffix in ("_xy", "_uv") if self.s.foam else ("",):
            row = []
            for name in ("traverse", "straight_feed", "arc_feed"):
                row.append(self.colour(name + suffix, self.alpha[name + "_alpha" + suffix] if o.program_alpha else 1.0))
            if not o.show_rapids:
                row[0] = (0.0, 0.0, 0.0, 0.0)
            lists.append(row)
        return lists

    def item(self, arrays, name, width=1, alpha=1.0):
        return Item(arrays[0], arrays[1], self.colour(name, alpha), width)

    def compose(self, w, h, matrix):
        """The still layer of the scene."""
        o, c = self.options, self.scene
        c.before, c.after, c.labels, c.selected_spans = [], [], [], []
        c.selected = self.colour("selected")
        shown = bool(o.show_program) and not self.boxed
        c.drawings, c.palettes = (self.drawings, self.palettes()) if shown else ([], [])
        if o.grid_size > 0:
            plane = {"x": (1, 2), "y": (0, 2), "y2": (0, 2), "lathe": (0, 2),
                     "lathe2": (0, 2)}.get(self.camera.view, (0, 1))
            rotation = self.stat.rotation_xy if self.stat else 0.0
            c.before.append(self.item(shapes.grid(o.grid_size, self.camera.centre, 2 * self.camera.size, plane,
                                                  rotation), "grid"))
        if shown and o.highlight_line > 0:
            c.selected_spans = [(n, first, last) for n, d in enumerate(self.drawings)
                                for first, last in d.spans(o.highlight_line)]
        if self.program is not None and shown:
            for places, name in zip(self.program.mark_places, ("dwell", "m1xx")):
                if places:
                    c.after.append(self.item(shapes.crosses(places), name))
        labels = self.add_extents(matrix)
        if self.stat is not None:
            labels += self.add_origin()
        limits = self.limits()
        if o.show_machine_limits and limits:
            c.after.append(self.item(shapes.box(*limits), "limits"))
        for place, text, name, box in labels:
            at = self.camera.pixel(place, w, h)
            if at and -50 < at[0] < w + 50 and -50 < at[1] < h + 50:
                c.labels.append((*self.free_place(at, text, w), text, self.colour(name), box))

    def free_place(self, at, text, width):
        """The place of a label: the nearest one where no other is, within the picture."""
        letter, line = 0.61 * self.text_px, self.text_px
        half = letter * (len(text) + 1) / 2
        for dx, dy in sorted(((dx * half, dy * line / 2) for dx in range(-4, 5) for dy in range(-8, 9)),
                             key=lambda p: (p[0] ** 2 + p[1] ** 2, -p[1])):
            x, y = at[0] + dx, at[1] + dy
            if (dx or dy) and not half <= x <= width - half:
                continue
            if not any(abs(x - ox) < letter * (len(text) + len(other)) / 2 and abs(y - oy) < line
                       for ox, oy, other, *_ in self.scene.labels):
                return x, y
        return at

    def offset(self):
        """Work offset and G92 in inches, X Y Z."""
        return [self.unit * (self.stat.g5x_offset[i] + self.stat.g92_offset[i]) for i in range(3)]

    def add_extents(self, matrix):
        """Dimension lines; returns labels (place, text, colour, boxed)."""
        o = self.options
        shown = bool(o.show_program) and not self.boxed
        relative = self.stat is not None and bool(o.coord_type)
        turn = self.stat.rotation_xy if relative else 0.0
        about = tuple(self.unit * v for v in self.stat.g5x_offset[:2]) if turn else (0.0, 0.0)
        extents = self.extents(turn, about)
        if extents is None or not (o.show_extents or not shown):
            return []
        low, high = extents
        if not shown:
            self.scene.after.append(self.item(shapes.box(*self.extents()), "box"))
        zero = self.offset() if relative else (0.0, 0.0, 0.0)
        labels = []
        out = self.camera.basis()[2]
        for axis in range(3):
            if abs(out[axis]) > 0.999 or high[axis] - low[axis] < 1e-6:
                continue
            beside = {0: 1, 1: 0, 2: 0}[axis]
            if abs(out[beside]) > 0.999:
                beside = 2 if axis != 2 else 1
            points, kinds, texts = shapes.dimension(low, high, axis, beside, o.metric, zero[axis])
            over = beyond(self.program, self.s, self.stat, axis) if self.stat is not None else (False, False)
            flags = (*over, any(over))
            self.scene.after.append(self.item((shapes.turned(points, turn, about), kinds),
                                              "label_limit" if any(over) else "label_ok"))
            for (place, text), bad in zip(texts, flags):
                labels.append((tuple(shapes.turned([place], turn, about)[0]), text,
                               "label_limit" if bad else "label_ok", bad))
        return labels

    def add_origin(self):
        """Axes at the program's origin, machine zero, lines of the offsets; returns labels."""
        o, c, labels = self.options, self.scene, []
        offset = self.offset()
        relative = bool(o.coord_type)
        origin = tuple(offset) if relative else (0.0, 0.0, 0.0)
        if relative and any(offset):
            c.after.append(self.item(shapes.origin_mark(), "small_origin"))
        if relative and o.show_offsets:
            g5x = tuple(self.unit * v for v in self.stat.g5x_offset[:3])
            system = SYSTEMS[self.stat.g5x_index] if 0 <= self.stat.g5x_index < len(SYSTEMS) else "G5x"
            for start, end, text in (((0.0, 0.0, 0.0), g5x, system), (g5x, origin, "G92")):
                if start != end:
                    c.after.append(self.item(shapes.runs([start, end]), "small_origin"))
                    labels.append((tuple((a + b) / 2 for a, b in zip(start, end)), text, "small_origin", False))
        for name, arrays in zip("xyz", shapes.axes(origin, self.stat.rotation_xy if relative else 0.0)):
            if name == "y" and self.s.lathe:
                continue
            c.after.append(self.item(arrays, f"axis_{name}", 2))
            labels.append((tuple(arrays[0][1]), name.upper(), f"axis_{name}", False))
        return labels

    # -- what moves ------------------------------------------------------------------------

    def compose_live(self, w, h, matrix):
        o, c = self.options, self.scene
        c.live = []
        c.plot = self.logger.points() if self.logger and o.show_live_plot else None
        u = self.unit
        c.plot_matrix = tuple(v * u if i % 4 < 3 else v for i, v in enumerate(matrix))
        if o.show_tool and self.stat is not None:
            self.add_tool()
        self.add_readout(h)

    def add_tool(self):
        c, stat, u = self.scene, self.stat, self.unit
        position = stat.position if self.options.display_type else stat.actual_position
        nine = [(position[i] - stat.tool_offset[i]) * (1.0 if 3 <= i <= 5 else u) for i in range(9)]
        size = self.options.cone_size
        if self.options.cone_scaling:
            extents = self.extents()
            size *= max(2.0, *([b - a for a, b in zip(*extents)] if extents else [2.0]))
        if self.s.foam:
            for at, name, up in (((nine[0], nine[1], self.foam_z), "cone_xy", -1),
                                 ((nine[6], nine[7], self.foam_w), "cone_uv", 1)):
                c.live.append(self.item(shapes.cone(at, CONE_RADIUS * size, CONE_HEIGHT * size, up), name))
            return
        at, turns = shapes.placed(nine, self.s.geometry, self.s.coordinates, self.offset_nine())
        tool = self.current_tool()
        diameter = tool.diameter * u if tool is not None else 0.0
        if tool is not None and self.s.lathe:
            if 1 <= tool.orientation <= 9:
                c.live.append(self.item(shapes.lathe_cross(at, diameter / 2), "lathetool"))
                c.live.append(self.item(shapes.lathe_tool(at, diameter, tool.frontangle, tool.backangle,
                                                          tool.orientation), "lathetool", 2))
            return
        if tool is not None and tool.diameter > self.options.min_tool_diameter:
            solid, arrays = (shapes.cylinder_faces(at, diameter / 2, 4 * diameter),
                             shapes.cylinder(at, diameter / 2, 4 * diameter))
            name = "tool_diffuse"
        else:
            way = (0, 0, 1) if not self.s.lathe else (-1, 0, 0) if abs(stat.rotation_xy - 180) < 1e-6 else (1, 0, 0)
            radius, height = CONE_RADIUS * size, CONE_HEIGHT * size
            solid, arrays = shapes.cone_faces(at, radius, height, way), shapes.cone(at, radius, height, 1, way)
            name = "cone"
        for letter, degrees in turns:
            solid, arrays = (shapes.tilted(solid, at, letter, degrees),
                             (shapes.tilted(arrays[0], at, letter, degrees), arrays[1]))
        if len(solid):
            c.live.append(Item(solid, [1] * len(solid), self.colour(name, self.alpha["tool_alpha"]), 1, True))
        c.live.append(self.item(arrays, name, 1, 0.8))

    def current_tool(self):
        """Entry of the tool table, or None."""
        return self.stat.tool_table[0] if self.stat.tool_in_spindle > 0 else None

    def offset_nine(self):
        return [(a + b) * (1.0 if 3 <= i <= 5 else self.unit)
                for i, (a, b) in enumerate(zip(self.stat.g5x_offset, self.stat.g92_offset))]

    def add_readout(self, h):
        c = self.scene
        c.texts, c.panels = [], []
        lines = [line for line in self.readout_lines if line]
        if not lines:
            return
        size = round(self.text_px * (1.7 if self.options.dro_large_font else 1.0)) + 2
        step = round(1.25 * size)
        # a low window: smaller letters, the program stays visible
        while step * (len(lines) + 1) > 0.62 * h and size > 10:
            size -= 1
            step = round(1.25 * size)
        width = 0.61 * size * max(map(len, lines))
        left = 1.5 * size
        ink = self.colour("overlay_foreground")
        c.panels.append((0, 0, left + width + size / 2, step * len(lines) + size / 2,
                         self.colour("overlay_background", self.alpha["overlay_alpha"])))
        c.texts.append((left, size / 4, "\n".join(lines), ink, size))
        for row, (homed, limit) in enumerate(self.marks):
            if homed:
                c.texts.append((size / 4, size / 4 + row * step, "⌂", rgb("#8fd694"), size))
            if limit:
                c.texts.append((left - size / 2, size / 4 + row * step, "!", self.colour("label_limit"), size))
