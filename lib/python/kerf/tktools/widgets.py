# SPDX-License-Identifier: GPL-2.0-or-later
"""Widgets that several windows share."""

import tkinter as tk
from tkinter import ttk


def put(widget, **options):
    """widget.configure() of what has changed since the last put(): what is set anew is drawn anew."""
    seen = widget.__dict__.setdefault("put_options", {})
    changed = {name: value for name, value in options.items() if name not in seen or seen[name] != value}
    if changed:
        widget.configure(**changed)
        seen.update(changed)


class Scrolled(ttk.Frame):
    """A frame that may be higher than its place: children go into `inner`."""

    def __init__(self, parent, style, fill=True):
        super().__init__(parent)
        self.canvas = tk.Canvas(self, highlightthickness=0, background=style.colours["face"],
                                yscrollincrement=style.px(16))
        self.bar = ttk.Scrollbar(self, command=self.canvas.yview)
        self.inner = ttk.Frame(self.canvas)
        self.item = self.canvas.create_window(0, 0, anchor="nw", window=self.inner)
        self.fill = fill
        self.canvas.configure(yscrollcommand=self._set)
        self.canvas.grid(row=0, column=0, sticky="nsew")
        self.rowconfigure(0, weight=1)
        self.columnconfigure(0, weight=1)
        self.inner.bind("<Configure>", self._fit)
        self.canvas.bind("<Configure>", self._fit)
        self.bind_class(f"Wheel{self}", "<Button-4>", lambda event: self.scroll(-1))
        self.bind_class(f"Wheel{self}", "<Button-5>", lambda event: self.scroll(1))
        self.wheel(self.canvas, self.inner)

    def wheel(self, *widgets):
        """The wheel over these scrolls, too."""
        for widget in widgets:
            widget.bindtags((f"Wheel{self}",) + widget.bindtags())

    def scroll(self, units):
        if self.inner.winfo_height() > self.canvas.winfo_height():
            self.canvas.yview_scroll(units, "units")

    def _set(self, first, last):
        self.bar.set(first, last)
        if float(first) <= 0 and float(last) >= 1:
            self.bar.grid_remove()
        else:
            self.bar.grid(row=0, column=1, sticky="ns")

    def _fit(self, _event):
        self.canvas.configure(scrollregion=(0, 0, self.inner.winfo_reqwidth(), self.inner.winfo_reqheight()))
        if self.inner.winfo_reqwidth() > self.canvas.winfo_reqwidth():      # it does not scroll that way
            self.canvas.configure(width=self.inner.winfo_reqwidth())
        if self.fill:
            self.canvas.itemconfigure(self.item, width=max(self.canvas.winfo_width(), self.inner.winfo_reqwidth()))

    def fit_width(self, most_height):
        """The size that its children want, at most so high."""
        self.update_idletasks()
        self.canvas.configure(width=self.inner.winfo_reqwidth(), height=min(self.inner.winfo_reqheight(), most_height))
