# SPDX-License-Identifier: GPL-2.0-or-later
"""Dialogs of the AXIS screen. All wait for an answer; the first button has index 0."""

import tkinter as tk
from tkinter import ttk

from kerf import tkfit
from kerf.language import N_
from kerf.numbertext import with_point

CURRENT = N_("Current")
SYSTEMS = ("P0  Current", "P1  G54", "P2  G55", "P3  G56", "P4  G57", "P5  G58", "P6  G59", "P7  G59.1",
           "P8  G59.2", "P9  G59.3")
FOCUS_PX = 2             # around the button that the keyboard presses
MOST_LINES = 20          # of a question; more are scrolled


def centre(window, root):
    window.update_idletasks()
    x = root.winfo_rootx() + (root.winfo_width() - window.winfo_reqwidth()) // 2
    y = root.winfo_rooty() + (root.winfo_height() - window.winfo_reqheight()) // 3
    window.geometry(f"+{max(0, x)}+{max(0, y)}")


def letters(root, count, font="TkDefaultFont"):
    """Pixels of so many letters; at most the greater part of the screen."""
    return min(count * int(root.tk.call("font", "measure", font, "0")), root.winfo_screenwidth() * 4 // 5)


def colour(root, name):
    return root.tk.getvar(f"::axis::colour({name})")


def button(row, text, command):
    made = tk.Button(row, text=text, width=max(10, len(text)), command=command, highlightthickness=FOCUS_PX)
    made.pack(side="left", padx=6)
    return made


def long_text(window, text):
    """A text that may be longer than its place."""
    box = tk.Frame(window)
    bar = ttk.Scrollbar(box)
    width = letters(window, 80, "TkFixedFont") // letters(window, 1, "TkFixedFont")
    shown = tk.Text(box, width=width, height=min(12, max(4, text.count("\n") + 2)), wrap="word", yscrollcommand=bar.set)
    bar.configure(command=shown.yview)
    bar.pack(side="right", fill="y")
    shown.pack(side="left", fill="both", expand=True)
    shown.insert("end", text)
    shown.configure(state="disabled")
    box.pack(fill="both", expand=True, pady=8)


def closed(root):
    """The window and its interpreter are gone."""
    try:
        return not root.winfo_exists()
    except tk.TclError:
        return True


class Modal:
    """A window that waits for its answer."""

    def __init__(self, root, title, name=None):
        self.root = root
        self.window = tk.Toplevel(root, class_="Dialog", padx=16, pady=12, **({"name": name} if name else {}))
        self.window.withdraw()
        self.window.title(title)
        self.window.transient(root)
        self.window.protocol("WM_DELETE_WINDOW", lambda: self.answer(None))
        self.result = None
        self.done = tk.BooleanVar(root, False)

    def answer(self, value):
        self.result = value
        self.done.set(True)

    def wait(self, focus=None):
        """The answer. SystemExit: the screen was closed meanwhile."""
        self.window.bind("<Destroy>", lambda event: self.done.set(True), add=True)
        try:
            centre(self.window, self.root)
            self.window.deiconify()
            self.window.after_idle(tkfit.onto_screen, self.window)
            self.window.wait_visibility()
            self.window.grab_set()
            before = str(self.root.tk.call("focus"))
            (focus or self.window).focus_force()
            if not self.done.get():          # nobody was faster than the window
                self.root.wait_variable(self.done)
            self.window.grab_release()
            self.window.destroy()
            if self.root.winfo_ismapped():          # keys go where they went before, whatever the desktop does
                self.root.tk.call("focus", "-force",
                                  before if before and int(self.root.tk.call("winfo", "exists", before)) else ".")
        except tk.TclError:
            if closed(self.root):
                raise SystemExit from None
            raise
        return self.result


def ask(root, title, text, icon, default, *buttons, extra=None, escape=None, name=None, font="TkDefaultFont"):
    """Index of the button that was pressed; `extra`: a long text below the question."""
    modal = Modal(root, title, name)
    w = modal.window
    sign = {"error": "✖", "warning": "⚠", "info": "ℹ", "question": "?"}.get(icon, "")
    top = tk.Frame(w)
    top.pack(fill="x")
    tk.Label(top, text=sign, font=("DejaVu Sans", -2 * letters(root, 2))).pack(side="left", padx=(0, 12))
    lines = text.split("\n")
    if len(lines) > MOST_LINES and extra is None:
        text, extra = lines[0], "\n".join(lines[1:])
    tk.Label(top, text=text, wraplength=letters(root, 66, font), justify="left", font=font).pack(side="left", fill="x")
    if extra is not None:
        long_text(w, extra)
    row = tk.Frame(w)
    row.pack(pady=(12, 0))
    made = []
    for index, label in enumerate(buttons):
        b = button(row, label, lambda i=index: modal.answer(i))
        b.bind("<Return>", lambda event, i=index: modal.answer(i))
        b.bind("<KP_Enter>", lambda event, i=index: modal.answer(i))
        made.append(b)
    if escape is not None:
        w.bind("<Escape>", lambda event: modal.answer(escape))
    result = modal.wait(made[default] if 0 <= default < len(made) else None)
    return result if result is not None else (escape if escape is not None else len(buttons) - 1)


class Touchoff(Modal):
    """Asks for a number or an expression, and for a coordinate system unless `system` is None."""

    def __init__(self, root, title, text, default, unit, check, system=None, note=None, translate=str):
        super().__init__(root, title)
        self.check, self.unit = check, unit
        w = self.window
        tk.Label(w, text=text, anchor="w").pack(fill="x")
        if note:
            tk.Label(w, text=note, anchor="w").pack(fill="x")
        row = tk.Frame(w)
        row.pack(fill="x", pady=6)
        self.value = tk.StringVar(root, str(default))
        self.entry = tk.Entry(row, textvariable=self.value, width=24)
        self.entry.pack(side="left", fill="x", expand=True)
        self.shown = tk.Label(row, width=26, anchor="w", justify="left", wraplength=letters(root, 26))
        self.shown.pack(side="left", padx=8)
        self.ink = self.shown.cget("foreground")
        self.system = None
        if system is not None:
            systems = (SYSTEMS[0].replace(CURRENT, translate(CURRENT)), *SYSTEMS[1:])
            self.system = tk.StringVar(root, next((s for s in systems if s.startswith(system.split()[0])), systems[0]))
            row = tk.Frame(w)
            row.pack(fill="x", pady=6)
            tk.Label(row, text=translate("Coordinate System:")).pack(side="left")
            ttk.Combobox(row, textvariable=self.system, values=systems, state="readonly",
                         width=max(14, len(systems[0]) + 2)).pack(side="left", padx=8)
            for n in range(9):
                w.bind(f"<Alt-Key-{n + 1}>", lambda event, n=n: self.system.set(systems[n]))
        row = tk.Frame(w)
        row.pack(pady=(12, 0))
        self.ok = button(row, translate("OK"), self.accept)
        button(row, translate("Cancel"), lambda: self.answer(None))
        for key in ("<Return>", "<KP_Enter>"):
            w.bind(key, lambda event: self.accept())
        w.bind("<Escape>", lambda event: self.answer(None))
        self.value.trace_add("write", lambda *_: self.validate())
        self.entry.selection_range(0, "end")
        self.entry.icursor("end")
        self.validate()

    def text(self):
        return with_point(self.value.get())

    def validate(self):
        """Shows the value or what is wrong with it; true when it can be used."""
        number, problem = self.check(self.text())
        good = problem is None
        self.shown.configure(text=f"= {number:f} {self.unit}" if good else problem,
                             foreground=self.ink if good else colour(self.root, "bad"))
        self.ok.configure(state="normal" if good else "disabled")
        return good

    def accept(self):
        if self.validate():
            self.answer((self.text(), self.system.get().split()[0] if self.system else None))
