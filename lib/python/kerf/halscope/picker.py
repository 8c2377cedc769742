# SPDX-License-Identifier: GPL-2.0-or-later
"""The dialog in which the source of a channel is chosen: pins, signals, parameters."""

import tkinter as tk
from tkinter import ttk

import hal

from ..language import _, N_

TABS = (("pin", N_("Pins"), hal.query.pins), ("sig", N_("Signals"), hal.query.signals),
        ("param", N_("Parameters"), hal.query.params))


class SourcePicker(tk.Toplevel):
    """Calls done(kind, name) when an item is chosen; nothing when it is closed. Typing narrows the lists."""

    def __init__(self, master, number, current, done):
        super().__init__(master)
        self.title(_("Select Channel %s Source") % number)
        self.transient(master)
        self._done, self._names, self.lists = done, {}, {}
        bar = ttk.Frame(self, padding=6)
        ttk.Label(bar, text=_("Filter:")).pack(side="left")
        self.filter = tk.StringVar()
        self.filter.trace_add("write", lambda *_: self._fill())
        entry = ttk.Entry(bar, textvariable=self.filter)
        entry.pack(side="left", fill="x", expand=True, padx=(6, 0))
        bar.pack(fill="x")
        self.book = ttk.Notebook(self)
        for kind, title, query in TABS:
            self._names[kind] = [name for name, item in sorted(query().items()) if int(item["type"]) != hal.HAL_PORT]
            page = ttk.Frame(self.book)
            box = tk.Listbox(page, width=48, height=18, exportselection=False, activestyle="none")
            bar = ttk.Scrollbar(page, command=box.yview)
            box.configure(yscrollcommand=bar.set)
            box.pack(side="left", fill="both", expand=True)
            bar.pack(side="right", fill="y")
            box.bind("<Double-Button-1>", lambda _e: self.accept())
            self.book.add(page, text=_(title))
            self.lists[kind] = box
        self.book.pack(fill="both", expand=True, padx=6)
        buttons = ttk.Frame(self, padding=6)
        ttk.Button(buttons, text="OK", command=self.accept).pack(side="right")
        ttk.Button(buttons, text=_("Cancel"), command=self.destroy).pack(side="right", padx=6)
        buttons.pack(fill="x")
        self.bind("<Return>", lambda _e: self.accept())
        self.bind("<Escape>", lambda _e: self.destroy())
        self._fill()
        if current.kind:
            self.book.select([t[0] for t in TABS].index(current.kind))
            self.choose(current.name)
        entry.focus_set()

    def kind(self):
        return TABS[self.book.index(self.book.select())][0]

    def _fill(self):
        wanted = self.filter.get().lower()
        for kind, box in self.lists.items():
            box.delete(0, "end")
            box.insert("end", *[n for n in self._names[kind] if wanted in n.lower()])

    def choose(self, name):
        """Marks a name in the list that is shown."""
        box = self.lists[self.kind()]
        names = box.get(0, "end")
        if name in names:
            box.selection_clear(0, "end")
            box.selection_set(names.index(name))
            box.see(names.index(name))

    def accept(self):
        box = self.lists[self.kind()]
        marked = box.curselection() or ((0,) if box.size() == 1 else ())
        if marked:
            kind, name = self.kind(), box.get(marked[0])
            self.destroy()
            self._done(kind, name)
