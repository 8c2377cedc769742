# SPDX-License-Identifier: GPL-2.0-or-later
"""A table whose cells are typed into. Only the rows in sight have widgets, so its length does not matter."""

import tkinter as tk
from dataclasses import dataclass
from tkinter import ttk

from ..language import _
from ..numbertext import with_point


@dataclass(frozen=True)
class Column:
    key: str
    title: str
    chars: int
    left: bool = False      # text; numbers stand at the right


class Sheet(ttk.Frame):
    """rows: objects with a dict `cells`; changed() is called after a cell was typed into.

    good(key, text) says whether a cell is shown as it should be; others are red.
    """

    def __init__(self, parent, style, columns, good, changed, sort):
        super().__init__(parent)
        self.style, self.columns, self.good, self.changed, self.sort = style, columns, good, changed, sort
        self.rows, self.top, self.ticked, self.lines, self.filling = [], 0, set(), [], False
        self.canvas = tk.Canvas(self, highlightthickness=0, background=style.colours["face"], yscrollincrement=1)
        self.inner = ttk.Frame(self.canvas)
        self.item = self.canvas.create_window(0, 0, anchor="nw", window=self.inner)
        self.bar = ttk.Scrollbar(self, command=self._scroll)
        self.across = ttk.Scrollbar(self, orient="horizontal", command=self.canvas.xview)
        self.canvas.configure(xscrollcommand=self._xset)
        self.canvas.grid(row=0, column=0, sticky="nsew")
        self.bar.grid(row=0, column=1, sticky="ns")
        self.rowconfigure(0, weight=1)
        self.columnconfigure(0, weight=1)
        self._headings()
        self._add_line()
        self.update_idletasks()
        self.line_height = self.inner.grid_bbox(1, 1)[3]
        self.head_height = self.heads[0].winfo_reqheight()
        self.canvas.configure(width=self.inner.winfo_reqwidth(), height=self.head_height + 12 * self.line_height)
        self.canvas.bind("<Configure>", lambda event: self._resize())
        for widget in (self.canvas, self.inner):
            self._wheel(widget)

    def _headings(self):
        ttk.Label(self.inner, text=_("Del"), anchor="center").grid(row=0, column=0, sticky="ew", padx=2)
        self.heads = []
        for place, column in enumerate(self.columns, 1):
            head = ttk.Button(self.inner, text=column.title, style="Toolbutton", takefocus=False, width=-1,
                              command=lambda c=column: self.sort(c.key))
            head.grid(row=0, column=place, sticky="ew")
            self.inner.columnconfigure(place, weight=column.chars if column.left else 0)
            self.heads.append(head)

    def _add_line(self):
        line = len(self.lines)
        tick = tk.BooleanVar(self)
        box = ttk.Checkbutton(self.inner, variable=tick, command=lambda: self._tick(line, tick), takefocus=False)
        box.grid(row=line + 1, column=0)
        entries, texts = [], []
        for place, column in enumerate(self.columns):
            text = tk.StringVar(self)
            entry = tk.Entry(self.inner, textvariable=text, width=column.chars,
                             justify="left" if column.left else "right", relief="flat",
                             borderwidth=0, highlightthickness=1, highlightcolor=self.style.colours["select"],
                             highlightbackground=self.style.colours["line"])
            entry.grid(row=line + 1, column=place + 1, sticky="ew", ipady=self.style.roomy(1, 8) - 1,
                       padx=(self.style.px(4) if column.left else 0, 1))
            text.trace_add("write", lambda *_, l=line, p=place: self._typed(l, p))
            for key, right, down in (("Left", -1, 0), ("Right", 1, 0), ("Up", 0, -1), ("Down", 0, 1), ("Return", 0, 1),
                                     ("KP_Enter", 0, 1)):
                entry.bind(f"<{key}>", lambda event, l=line, p=place, r=right, d=down: self.move(l, p, r, d))
            for key, pages in (("Prior", -1), ("Next", 1)):
                entry.bind(f"<{key}>", lambda event, n=pages: self.scroll_to(self.top + n * self.visible()))
            self._wheel(entry)
            entries.append(entry)
            texts.append(text)
        self.lines.append((box, entries, texts, tick))

    def _wheel(self, widget):
        widget.bind("<Button-4>", lambda event: self.scroll_to(self.top - 3))
        widget.bind("<Button-5>", lambda event: self.scroll_to(self.top + 3))
        widget.bind("<MouseWheel>",
                    lambda event: self.scroll_to(self.top - 3 * (event.delta > 0) + 3 * (event.delta < 0)))

    # -- what is in sight ---------------------------------------------------------------

    def visible(self):
        """Whole rows in sight."""
        return max(1, (self.canvas.winfo_height() - self.head_height) // self.line_height)

    def _resize(self):
        wanted = min(self.visible(), max(1, len(self.rows)))
        while len(self.lines) < wanted:
            self._add_line()
        width = max(self.inner.winfo_reqwidth(), self.canvas.winfo_width())
        self.canvas.itemconfigure(self.item, width=width)
        self.canvas.configure(scrollregion=(0, 0, width, 1))
        self.scroll_to(self.top)

    def _xset(self, first, last):
        self.across.set(first, last)
        if float(first) <= 0 and float(last) >= 1:
            self.across.grid_remove()
        else:
            self.across.grid(row=1, column=0, sticky="ew")

    def show(self, rows):
        """These rows from now on."""
        self.rows = rows
        self.ticked &= {id(row) for row in rows}
        self._resize()

    def scroll_to(self, top):
        self.top = max(0, min(top, len(self.rows) - self.visible()))
        self.filling = True
        for line, (box, entries, texts, tick) in enumerate(self.lines):
            place = self.top + line
            if place < len(self.rows) and line < self.visible():
                row = self.rows[place]
                box.grid()
                tick.set(id(row) in self.ticked)
                for column, entry, text in zip(self.columns, entries, texts):
                    entry.grid()
                    text.set(row.cells.get(column.key, ""))
                    self._colour(entry, column, text.get())
            else:
                box.grid_remove()
                for entry in entries:
                    entry.grid_remove()
        self.filling = False
        total = max(1, len(self.rows))
        self.bar.set(self.top / total, min(1.0, (self.top + self.visible()) / total))
        return "break"

    def _scroll(self, what, amount, unit=""):
        if what == "moveto":
            self.scroll_to(round(float(amount) * len(self.rows)))
        else:
            self.scroll_to(self.top + int(amount) * (1 if unit == "units" else self.visible()))

    # -- changes ------------------------------------------------------------------------

    def _colour(self, entry, column, text):
        bad = bool(text.strip()) and not self.good(column.key, text.strip())
        entry.configure(foreground=self.style.colours["bad"] if bad else self.style.colours["ink"])

    def _typed(self, line, place):
        if self.filling or self.top + line >= len(self.rows):
            return
        column, typed = self.columns[place], self.lines[line][2][place]
        text = typed.get()
        if not column.left and text != with_point(text):
            self.filling, text = True, with_point(text)
            typed.set(text)
            self.filling = False
        self.rows[self.top + line].cells[column.key] = text
        self._colour(self.lines[line][1][place], column, text)
        self.changed()

    def _tick(self, line, tick):
        row = self.rows[self.top + line]
        (self.ticked.add if tick.get() else self.ticked.discard)(id(row))
        self.changed()

    def ticked_rows(self):
        return [row for row in self.rows if id(row) in self.ticked]

    def move(self, line, place, right, down):
        """The focus goes to a neighbour; at an edge to the other side."""
        place = (place + right) % len(self.columns)
        self.focus_cell((self.top + line + down) % max(1, len(self.rows)), place)
        return "break"

    def focus_cell(self, row, place=0):
        if row < self.top:
            self.scroll_to(row)
        elif row >= self.top + self.visible():
            self.scroll_to(row - self.visible() + 1)
        entry = self.lines[row - self.top][1][place]
        entry.focus_set()
        entry.selection_range(0, "end")
        entry.icursor("end")
        x, width = entry.winfo_x(), self.inner.winfo_width()
        left, seen = self.canvas.canvasx(0), self.canvas.winfo_width()
        if x < left or x + entry.winfo_width() > left + seen:
            self.canvas.xview_moveto(max(0, x - seen // 2) / max(1, width))

    def entry(self, row, key):
        """The widget of a cell in sight, else None."""
        line = row - self.top
        if not 0 <= line < min(len(self.lines), self.visible()):
            return None
        return self.lines[line][1][[c.key for c in self.columns].index(key)]
