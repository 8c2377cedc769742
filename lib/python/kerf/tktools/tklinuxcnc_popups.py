# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows that tklinuxcnc opens beside itself."""

import tkinter as tk
from tkinter import messagebox, ttk

import linuxcnc

from ..language import _, N_
from ..numbertext import plain, with_point
from .machine import LETTERS

TOOL, LENGTH, DIAMETER = _("Tool"), _("Length"), _("Diameter")
PLOT_MS, PLOT_POINTS = 100, 20000
OFFSETS = ((N_("work (G5x)"), "g5x_offset"), ("G92", "g92_offset"), (N_("tool"), "tool_offset"))


class Popups:
    def __init__(self, window):
        self.w, self.shown = window, []

    def open(self, title):
        top = tk.Toplevel(self.w.root)
        top.title(title)
        top.transient(self.w.root)
        top.bind("<Escape>", lambda event: top.destroy())
        top.bind("<F1>", lambda event: self.w.m.toggle_estop())
        return top

    def text(self, title, text):
        top, px = self.open(title), self.w.style.px
        ttk.Button(top, text=_("Close"), command=top.destroy).pack(side="bottom", pady=px(6))
        box = tk.Text(top, width=84, height=24, wrap="none")
        bar = ttk.Scrollbar(top, command=box.yview)
        box.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        box.pack(fill="both", expand=True)
        box.insert("end", text)
        box.configure(state="disabled")
        return top

    def message(self, text, error):
        """Stays until OK; the machine goes on, except by Escape. The same text is not shown twice."""
        self.shown = [(t, top) for t, top in self.shown if top.winfo_exists()]
        if any(t == text for t, _top in self.shown):
            return
        top, px = self.open(_("Error") if error else _("Message")), self.w.style.px
        top.bind("<Escape>", lambda event: self.w.abort(), add=True)
        ttk.Label(top, text=text, wraplength=px(480), padding=px(16), style="Bad.TLabel" if error else "TLabel").pack()
        ttk.Button(top, text="OK", command=top.destroy).pack(pady=(0, px(10)))
        self.shown.append((text, top))

    def offsets(self):
        """Offsets in force, and the file of parameters as it was saved last."""
        m = self.w.m
        m.stat.poll()
        lines = [f"{_('Offset'):12}" + "".join(f"{c:>12}" for c in m.letters)]
        for name, attribute in OFFSETS:
            values = getattr(m.stat, attribute)
            lines.append(f"{_(name):12}" + "".join("%12.4f" % values[LETTERS.index(c)] for c in m.letters))
        name = m.ini.find("RS274NGC", "PARAMETER_FILE")
        if name:
            try:
                lines += ["", _("Variables (%s):") % name] + (m.path.parent
                                                              / name).read_text(errors="replace").splitlines()
            except OSError as error:
                lines.append(f"{name}: {error.strerror}")
        self.text(_("Offsets and Variables"), "\n".join(lines))

    def mdi(self, text):
        m = self.w.m
        before = m.stat.task_mode
        if m.mode(linuxcnc.MODE_MDI):
            m.command.mdi(text)
            m.command.wait_complete(10.0)
            m.mode(before)

    def form(self, title, fields, action):
        """Entries with names; action gets the numbers that were typed."""
        top, px = self.open(title), self.w.style.px
        box = ttk.Frame(top, padding=px(10))
        box.pack()
        entries = {}
        for row, (name, value) in enumerate(fields.items()):
            ttk.Label(box, text=name).grid(row=row, column=0, sticky="w", padx=px(4))
            entries[name] = ttk.Entry(box, width=14, justify="right")
            entries[name].insert(0, value)
            entries[name].grid(row=row, column=1, pady=px(2))

        def accept(_event=None):
            try:
                values = {name: float(with_point(plain(e.get()))) for name, e in entries.items() if e.get().strip()}
            except ValueError as error:
                messagebox.showerror(title, str(error), parent=top)
                return
            top.destroy()
            action(values)
        buttons = ttk.Frame(top, padding=px(6))
        buttons.pack()
        ttk.Button(buttons, text="OK", command=accept).pack(side="left", padx=px(4))
        ttk.Button(buttons, text=_("Cancel"), command=top.destroy).pack(side="left", padx=px(4))
        for key in ("<Return>", "<KP_Enter>"):
            top.bind(key, accept)
        next(iter(entries.values())).focus_set()
        self.last_form = (top, entries, accept)

    def set_coordinates(self):
        """The position becomes the typed one, in the coordinate system that is in force."""
        m = self.w.m
        m.stat.poll()
        system = f"G{m.system_name()}"
        fields = {_("%s (now %.4f %s)") % (c, m.position(i, False, True, True, 'auto'), m.unit_name('auto')): ""
                  for i, c in enumerate(m.letters)}

        def act(values):
            if values:
                self.mdi("G10 L20 P0 " + " ".join(f"{name[0]}{value:.6f}" for name, value in values.items()))
        self.form(_("Set Coordinates of %s") % system, fields, act)

    def tool_offset(self):
        """Length and diameter of a tool, in the program's units, go into the tool table."""
        m = self.w.m
        m.stat.poll()
        unit = m.unit_name("auto")
        length, diameter = f"{LENGTH} ({unit})", f"{DIAMETER} ({unit})"
        shown = {}          # as filled in: has less digits than the table

        def act(values):
            words = [f"{letter}{values[name] * share:.6f}" for letter, name, share in (("Z", length, 1), ("R", diameter, .5))
                     if name in values and values[name] != shown.get(name)]
            if (number := int(values.get(TOOL, 0))) > 0 and words:
                self.mdi(f"G10 L1 P{number} {' '.join(words)}")
        self.form(_("Tool offset"), {TOOL: str(max(m.stat.tool_in_spindle, 0)), length: "", diameter: ""}, act)
        entries = self.last_form[1]

        def fill(*_changed):
            """What the table has of the tool that is typed; nothing for one that it has not."""
            shown.clear()
            try:
                tool = m.stat.toolinfo(int(number.get()))
            except (ValueError, IndexError, KeyError, linuxcnc.error):
                tool = None
            for name, key in ((length, "zoffset"), (diameter, "diameter")):
                entries[name].delete(0, "end")
                if tool:
                    text = f"{tool[key] * m.factor('auto'):.4f}"
                    shown[name] = float(text)
                    entries[name].insert(0, text)
        number = tk.StringVar(entries[TOOL], entries[TOOL].get())
        entries[TOOL].configure(textvariable=number)
        number.trace_add("write", fill)
        fill()

    def backplot(self):
        """The way of the tool from above, as it goes."""
        top, style, m = self.open(_("Backplot")), self.w.style, self.w.m
        canvas = tk.Canvas(top, width=style.px(420), height=style.px(360), background=style.colours["field"],
                           highlightthickness=0)
        canvas.pack(fill="both", expand=True)
        points = []
        ttk.Button(top, text=_("Clear"), command=points.clear).pack(pady=style.px(4))

        def draw():
            place = m.stat.actual_position[:2]
            if not points or points[-1] != place:
                points.append(place)
                del points[:-PLOT_POINTS]
                low = [min(p[i] for p in points) for i in (0, 1)]
                size = max(max(p[i] for p in points) - low[i] for i in (0, 1)) or 1.0
                scale = min(canvas.winfo_width(), canvas.winfo_height()) * 0.9 / size
                canvas.delete("all")
                if len(points) > 1:
                    canvas.create_line(*(v for x, y in points
                                         for v in (10 + (x - low[0]) * scale,
                                                   canvas.winfo_height() - 10 - (y - low[1]) * scale)),
                                       fill=style.colours["chart"])
            if top.winfo_exists():
                top.after(PLOT_MS, draw)
        draw()
