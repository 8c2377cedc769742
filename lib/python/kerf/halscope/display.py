# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of the oscilloscope: grid, traces, trigger, and what the mouse does there."""

import math
import tkinter as tk

from kerf_scope import columns, measure

from ..language import _
from . import geometry as geo, settings as st

COLOURS = ("#ffe15a", "#4dd2ff", "#ff7ac6", "#7dff7a", "#ffa64d", "#b9a2ff", "#ff6b6b", "#5affd2",
           "#d9ff66", "#7aa2ff", "#ff9ecf", "#a6d96a", "#ffd199", "#66e0ff", "#e08cff", "#e8e8e8")
BACK, GRID, GRID_MIDDLE, TRIGGER, WORDS = "#0d1117", "#26303a", "#44525f", "#ff5252", "#c8d1da"
STEP = 5                             # pixels of a drag that make one step of the scale


class Display(tk.Canvas):
    """owner: settings, record (acquire.Record or None), names of what changes: selected(number),
    changed() after any change of the settings that needs no new record, retrigger()."""

    def __init__(self, master, owner, style):
        super().__init__(master, background=BACK, highlightthickness=0, width=style.px(640), height=style.px(400),
                         cursor="crosshair")
        self._owner, self._style = owner, style
        self._spans = {}             # {number: {column: (top, bottom)}}: where the traces are
        self._drag = None            # what the left button moves
        self._pending = None
        self._pointer = None         # column of the pointer while it is here
        self._mark = None            # time (s) of the second cursor
        self.bind("<Configure>", lambda _e: self.later())
        self.bind("<ButtonPress-1>", self._press)
        self.bind("<B1-Motion>", self._move)
        self.bind("<ButtonRelease-1>", self._release)
        self.bind("<ButtonPress-3>", lambda event: self.set_mark(event.x))
        self.bind("<ButtonPress-2>", self._press_middle)
        self.bind("<B2-Motion>", self._move_middle)
        self.bind("<Motion>", self._point)
        self.bind("<Leave>", lambda _e: self._point(None))
        for event, up in (("<Button-4>", True), ("<Button-5>", False)):
            self.bind(event, lambda e, up=up: self.zoom(e.x, 1 if up else -1))
        self.bind("<MouseWheel>", lambda e: self.zoom(e.x, 1 if e.delta > 0 else -1))

    # ---- Geometry

    @property
    def size(self):
        return max(2, self.winfo_width()), max(2, self.winfo_height())

    def horizontal(self):
        """geometry.Horizontal of the record shown, or of the one to come."""
        period, length, trigger = self._owner.frame()
        return geo.horizontal(self._owner.settings, period, length, self.size[0], trigger)

    def _average(self, number):
        channel, record = self._owner.settings.channel(number), self._owner.record
        return geo.mean(record.values[number]) if channel.ac and record and number in record.values else 0.0

    def _tolerance(self):
        width, height = self.size
        return max(5.0, 0.01 * math.hypot(width, height))

    # ---- Drawing

    def later(self):
        """Draws when Tk has time; many wishes make one drawing."""
        if self._pending is None:
            self._pending = self.after_idle(self.draw)

    def draw(self):
        self._pending = None
        self.delete("all")
        self._spans = {}
        width, height = self.size
        for i in range(1, geo.DIVISIONS):
            colour = GRID_MIDDLE if i == geo.DIVISIONS // 2 else GRID
            self.create_line(i * width / geo.DIVISIONS, 0, i * width / geo.DIVISIONS, height, fill=colour)
            self.create_line(0, i * height / geo.DIVISIONS, width, i * height / geo.DIVISIONS, fill=colour)
        h = self.horizontal()
        s = self._owner.settings
        numbers = [n for n in self._owner.shown() if n != s.selected] + [n
                                                                         for n in self._owner.shown()
                                                                         if n == s.selected]
        for number in numbers:
            self._draw_trace(number, h)
        for number in numbers:
            self._draw_baseline(number)
        self._draw_trigger(h)
        self._draw_measured(h)
        self._draw_readout()
        text = self._owner.state_text()
        if text:
            state = self.create_text(width - 8, 8, anchor="ne", text=text, fill=WORDS, font="TkDefaultFont",
                                     tags="state", width=width - 16)
            figures = self.bbox("measured")
            if figures and figures[2] > self.bbox(state)[0] - 8:        # no room beside them
                self.move(state, 0, figures[3] - 4)

    def _draw_trace(self, number, h):
        record, channel = self._owner.record, self._owner.settings.channel(number)
        if record is None or number not in record.values:
            return
        width, height = self.size
        average = self._average(number)
        limit = 4 * height           # X has 16-bit coordinates

        def y(value):
            at = geo.y_of(channel, value, height, average)
            return min(max(at, -limit), limit) if at == at else limit
        points = geo.trace(record.values[number], h, width, y, channel.type == st.BIT, columns)
        if len(points) < 4:
            return
        selected = number == self._owner.settings.selected
        self.create_line(points, fill=COLOURS[number - 1], width=self._style.px(2 if selected else 1),
                         tags=("trace", f"trace{number}"))
        self._spans[number] = _spans(points, width)

    def _draw_baseline(self, number):
        channel, height = self._owner.settings.channel(number), self.size[1]
        y, r = geo.baseline(channel, height), self._style.px(5)
        self.create_polygon(0, y - r, 2 * r, y, 0, y + r, fill=COLOURS[number - 1],
                            tags=("baseline", f"baseline{number}"))
        self.create_text(2 * r + 3, y, anchor="w", text=str(number), fill=COLOURS[number - 1], font="TkDefaultFont",
                         tags="baseline")

    def _trigger_mark(self, h):
        """Middle of the mark of the edge."""
        width, height = self.size
        x = min(max(h.x(h.trigger), 8), width - 8)
        return x, self._owner.settings.trigger.level * height

    def _draw_trigger(self, h):
        s, (width, height) = self._owner.settings, self.size
        x = h.x(h.trigger)
        if 0 <= x <= width:
            self.create_line(x, 0, x, height, fill=TRIGGER, dash=(2, 6), tags="trigger")
        if not s.trigger.source:
            return
        x, y = self._trigger_mark(h)
        self.create_line(0, y, width, y, fill=TRIGGER, dash=(6, 4), tags=("trigger", "triggerline"))
        r, sign = self._style.px(7), -1 if s.trigger.rising else 1
        self.create_line(x - r, y - sign * r, x, y - sign * r, x, y + sign * r, x + r, y + sign * r, fill=TRIGGER,
                         width=self._style.px(2), tags=("trigger", "edge"))

    def _draw_measured(self, h):
        """Of the selected trace, the part in sight in figures; the second cursor."""
        number, record = self._owner.settings.selected, self._owner.record
        width, height = self.size
        if self._mark is not None:
            x = self._column(h, self._mark)
            self.create_line(x, 0, x, height, fill=WORDS, dash=(8, 4), tags="mark")
        found = (measure(record.values[number], h.start, h.sample(width))
                 if number and record and number in record.values else None)
        if found:
            low, high, mean, period = found
            text = _("least %.6g  greatest %.6g  p-p %.6g  mean %.6g") % (low, high, high - low, mean)
            if period:
                text += "  f " + geo.engineering(1 / (period * h.period), "Hz")
            self.create_text(8, 8, anchor="nw", text=text, fill=COLOURS[number - 1], font="TkFixedFont",
                             tags="measured", width=width - 16)

    # ---- The mouse

    @staticmethod
    def _column(h, time):
        return h.x(time / h.period + h.trigger)

    def set_mark(self, x):
        """The second cursor comes here, or goes when it is here already."""
        h = self.horizontal()
        if self._mark is not None and abs(self._column(h, self._mark) - x) <= self._tolerance():
            self._mark = None
        else:
            self._mark = h.time(x)
        self.later()

    def zoom(self, x, steps):
        """The sample under the pointer stays there."""
        s = self._owner.settings
        new = min(max(s.zoom + steps, 1), st.MAX_ZOOM)
        if new == s.zoom:
            return
        sample = self.horizontal().sample(x)
        s.zoom = new
        h = self.horizontal()
        length = max(1, self._owner.frame()[1])
        s.pos = min(max((sample - x * h.step + h.step * self.size[0] / 2) / length, 0.0), 1.0)
        self._owner.changed()

    def _press(self, event):
        s, (_width, height) = self._owner.settings, self.size
        tolerance = self._tolerance()
        shift, control = bool(event.state & 0x1), bool(event.state & 0x4)
        self._drag = None
        if s.trigger.source:
            x, y = self._trigger_mark(self.horizontal())
            if math.hypot(event.x - x, event.y - y) <= tolerance + self._style.px(4) and not (shift or control):
                self._owner.toggle_edge()
                return
        if control or (s.trigger.source and not shift and abs(event.y - s.trigger.level * height) <= tolerance):
            self._drag = "level"
            return
        if shift:
            self._drag = "vpos" if s.selected else None
            return
        shown = self._owner.shown()
        on = [n for n in shown if event.x <= self._style.px(24)
              and abs(geo.baseline(s.channel(n), height) - event.y) <= tolerance]
        if on:
            self._owner.select(on[0])
            self._drag = "vpos"
            return
        hit = geo.nearest(shown, self._spans, event.x, event.y, tolerance)
        if hit is None and s.selected and abs(geo.baseline(s.channel(s.selected), height) - event.y) <= tolerance:
            self._drag = "vpos"
            return
        self._owner.select(hit or 0)
        if hit:
            self._drag, self._at = "scale", event.y

    def _move(self, event):
        s, height = self._owner.settings, self.size[1]
        if self._drag == "level" and s.trigger.source:
            s.trigger.level = geo.snap(event.y / height)
            self._owner.retrigger()
        elif self._drag == "vpos" and s.selected:
            s.channel(s.selected).vpos = geo.snap(event.y / height)
            self._owner.changed()
        elif self._drag == "scale" and s.selected and abs(event.y - self._at) > STEP:
            channel = s.channel(s.selected)
            away = (event.y - self._at > 0) == (self._at > geo.baseline(channel, height))
            low, high = channel.limits()
            channel.vscale = min(max(channel.vscale + (-1 if away else 1), low), high)
            self._at = event.y
            self._owner.changed()

    def _release(self, _event):
        self._drag = None

    def _press_middle(self, event):
        self._at = event.x

    def _move_middle(self, event):
        s = self._owner.settings
        moved = (event.x - self._at) * self.horizontal().step / max(1, self._owner.frame()[1])
        self._at = event.x
        s.pos = min(max(s.pos - moved, 0.0), 1.0)
        self._owner.changed()

    def readout(self, x):
        """Time, value and derivative of the selected channel at a column; None when it has none there."""
        number, record = self._owner.settings.selected, self._owner.record
        if not number or record is None or number not in record.values:
            return None
        h, values = self.horizontal(), record.values[number]
        n = round(h.sample(x))
        if not 0 <= n < len(values):
            return None
        slope = (values[n] - values[n - 1]) / h.period if n > 0 else 0.0
        return (n - h.trigger) * h.period, values[n], slope

    def _point(self, event):
        self._pointer = event.x if event else None
        self._draw_readout()

    def _draw_readout(self):
        self.delete("readout")
        found = None if self._pointer is None else self.readout(self._pointer)
        if found is None:
            return
        colour = COLOURS[self._owner.settings.selected - 1]
        self.create_line(self._pointer, 0, self._pointer, self.size[1], fill=colour, dash=(1, 4), tags="readout")
        text = "f(% 8.5f) = % 8.5f (ddt % 8.5f)" % found
        if other := self._mark is not None and self.readout(self._column(self.horizontal(), self._mark)):
            far = found[0] - other[0]
            text += "\n" + _("from the mark: %.6g s (%s), %.6g") % (far,
                                                                    geo.engineering(1 / abs(far), "Hz") if far
                                                                    else "----", found[1] - other[1])
        self.create_text(8, self.size[1] - 8, anchor="sw", text=text, fill=colour, font="TkFixedFont", tags="readout",
                         width=self.size[0] - 16)


def _spans(points, width):
    """{column: (top, bottom)} of a line through points."""
    spans = {}

    def put(column, y):
        if 0 <= column < width:
            top, bottom = spans.get(column, (y, y))
            spans[column] = (min(top, y), max(bottom, y))
    for i in range(0, len(points) - 2, 2):
        x0, y0, x1, y1 = points[i:i + 4]
        put(int(x0), y0)
        put(int(x1), y1)
        for column in range(int(x0) + 1, int(x1)):
            put(column, y0 + (y1 - y0) * (column - x0) / (x1 - x0))
    return spans
