# SPDX-License-Identifier: GPL-2.0-or-later
"""The window of latency-plot: latency over time, one strip for each thread."""

import math
import time
import tkinter as tk
from tkinter import ttk

from .. import tkstyle
from ..language import _
from .latency_view import HEIGHT, WIDTH
from .session import lost

POINTS, LEAST_POINTS, MOST_POINTS, STEP = 60, 10, 600, 10     # of a strip
TICKS = 5           # marks on the axis of time


def round_above(value):
    """The least of 1, 2, 4, 8 with zeros that is not below: its quarters are easy to read."""
    ten = 10.0 ** math.floor(math.log10(value))
    return next(n * ten for n in (1, 2, 4, 8, 10) if n * ten >= value * (1 - 1e-9))


class Strip(tk.Canvas):
    """Two moving lines: values, and the largest one so far; times (s) below, as label(time) writes them."""

    def __init__(self, parent, style, title):
        super().__init__(parent, width=style.px(WIDTH), height=style.px(HEIGHT), background=style.colours["field"],
                         highlightthickness=1, highlightbackground=style.colours["line"])
        self.style, self.title, self.text, self.rows, self.points, self.label = style, title, "", [], POINTS, str
        self.bind("<Configure>", lambda event: self.draw())

    def show(self, rows, text, points, label):
        """rows: (time, value, largest); points: how many fit; label: a time as text."""
        self.rows, self.text, self.points, self.label = rows[-points:], text, points, label
        self.draw()

    def draw(self):
        self.delete("all")
        px, colours = self.style.px, self.style.colours
        width, left, floor, ceiling = self.winfo_width(), px(90), self.winfo_height() - px(24), px(34)
        self.create_text(px(8), px(6), anchor="nw", text=f"{self.title}   {self.text}", font="TkDefaultFont",
                         fill=colours["ink"], tags="figures")
        if not self.rows:
            return
        top = round_above(max(*(row[2] for row in self.rows), 1e-3))

        def place(number, value):
            return (left + px(4) + number * (width - left - px(12)) / max(1, self.points - 1),
                    floor - (floor - ceiling) * value / top)
        for part in range(5):
            y = floor - part * (floor - ceiling) / 4
            self.create_line(left, y, width, y, fill=colours["line"])
            self.create_text(left - px(6), y, anchor="e", text=f"{part * top / 4:.6g} us", font="TkDefaultFont",
                             fill=colours["faint"])
        for number in range(0, len(self.rows), max(1, self.points // TICKS)):
            self.create_text(place(number, 0)[0], floor + px(4), anchor="nw" if number == 0 else "n",
                             text=self.label(self.rows[number][0]), font="TkDefaultFont",
                             fill=colours["faint"], tags="time")
        if len(self.rows) > 1:
            for column, colour, tag in ((2, colours["bad"], "largest"), (1, colours["chart"], "line")):
                self.create_line(*(c for number, row in enumerate(self.rows) for c in place(number, row[column])),
                                 fill=colour, width=px(2), tags=tag)


class Plot:
    """trace: threads (name, period in ns), sample(), rows[name] as Strip.show() wants them, reset(). o: the options."""

    def __init__(self, root, trace, o, banner):
        self.root, self.trace, self.o, self.points, self.buttons = root, trace, o, POINTS, {}
        self.timer = self.trouble = None
        style = tkstyle.apply(root)
        px = style.px
        root.title("latency-plot")
        ttk.Label(root, text=banner, justify="left", padding=px(6)).pack(anchor="w")
        row = ttk.Frame(root, padding=px(4))
        row.pack(side="bottom", fill="x")

        def button(name, text, action):
            self.buttons[name] = ttk.Button(row, text=text, command=action,
                                            style="TButton" if name == "Reset" else "Small.TButton")
            self.buttons[name].pack(side="left", padx=px(3))
        button("Reset", _("Reset"), self.reset)
        ttk.Label(row, text=_("Points:")).pack(side="left", padx=(px(8), 0))
        self.count = ttk.Label(row, text=str(POINTS), width=5, anchor="e", relief="sunken")
        self.count.pack(side="left", padx=px(3))
        button("-", "-", lambda: self.choose(self.points - STEP))
        button("+", "+", lambda: self.choose(self.points + STEP))
        self.clock = tk.BooleanVar(root, not o.relative)
        self.clock_box = ttk.Checkbutton(row, text=_("Time of day"), variable=self.clock, command=self.show)
        self.clock_box.pack(side="right", padx=px(6))
        ttk.Label(row, text=_("Latency (us) over time (s)"), style="Faint.TLabel").pack(side="left", expand=True)
        self.strips = {name: Strip(root, style, _("%s thread (%d ns)") % (name, period))
                       for name, period in trace.threads}
        for strip in self.strips.values():
            strip.pack(fill="both", expand=True, padx=px(4), pady=px(2))
        root.update_idletasks()
        tkstyle.centre(root, root.winfo_reqwidth(), root.winfo_reqheight(), (px(360), px(240)))
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.timer = root.after(o.time, self.tick)

    def choose(self, points):
        self.points = min(max(points, LEAST_POINTS), MOST_POINTS)
        self.count.configure(text=str(self.points))
        self.show()

    def reset(self):
        self.trace.reset()
        self.show()

    def label(self, moment):
        return (time.strftime("%H:%M:%S", time.localtime(moment)) if self.clock.get()
                else f"{moment - self.trace.start:.0f}")

    def show(self):
        for name, strip in self.strips.items():
            rows = list(self.trace.rows[name])
            strip.show(rows, _("last %.3f us, largest %.3f us") % rows[-1][1:] if rows else "", self.points, self.label)

    def tick(self):
        try:
            self.trace.sample()
            self.show()
        except Exception as error:
            self.trouble = lost(error)
            self.close()
            return
        if self.o.points and self.trace.count >= self.o.points:
            self.close()
        else:
            self.timer = self.root.after(self.o.time, self.tick)

    def close(self):
        self.root.after_cancel(self.timer)
        self.root.destroy()


def show_strips(trace, o, banner):
    """The window of latency-plot, until it is closed. Raises ToolError when its figures went."""
    root = tkstyle.open_display("latency-plot", "Latency-plot")
    plot = Plot(root, trace, o, banner)
    root.mainloop()
    if plot.trouble:
        raise plot.trouble
