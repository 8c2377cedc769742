# SPDX-License-Identifier: GPL-2.0-or-later
"""Somebody who presses everything in any order, by a seed. Tk's errors are collected in `trouble`."""

import random
import tkinter as tk
import traceback
from tkinter import filedialog, messagebox, simpledialog

TEXTS = ("", "0", "1", "-3.5", "1e9", "x", "nonsense", "0x10", "(", "9" * 40, "a b c", "ü", "%s", "[exit]", "$x", "{")
KEYS = ("Up", "Down", "Left", "Right", "Return", "Escape", "Home", "Prior", "Next", "Tab", "space", "BackSpace", "a",
        "x", "1", "0", "F1", "F2", "F3", "F4", "F5", "minus", "equal", "at", "c", "i", "dollar")


class Monkey:
    """count of actions on all windows of a root; files: names that file dialogs may give; leave: texts of buttons that
    are let alone."""

    def __init__(self, root, seed, files=(), leave=(), tick=lambda: None):
        self.root, self.random, self.files, self.leave, self.tick = (root, random.Random(seed), list(files),
                                                                     set(leave), tick)
        self.trouble, self.done = [], []
        root.report_callback_exception = lambda *what: self.trouble.append("".join(traceback.format_exception(*what)))
        pick = self.random.choice
        for name in ("askyesno", "askokcancel", "askretrycancel"):
            setattr(messagebox, name, lambda *a, **k: pick((True, False)))
        messagebox.askyesnocancel = lambda *a, **k: pick((True, False, None))
        for name in ("showinfo", "showerror", "showwarning"):
            setattr(messagebox, name, lambda *a, **k: "ok")
        for name in ("askopenfilename", "asksaveasfilename"):
            setattr(filedialog, name, lambda *a, **k: pick(["", *self.files]))
        simpledialog.askstring = lambda *a, **k: pick((None, *TEXTS))
        simpledialog.askinteger = simpledialog.askfloat = lambda *a, **k: pick((None, 12))

    def alive(self):
        try:
            return bool(self.root.winfo_exists())
        except tk.TclError:
            return False

    def widgets(self, top):
        for child in top.winfo_children():
            if child.winfo_class() == "Menu" or child.winfo_ismapped():
                yield child
            yield from self.widgets(child)

    def run(self, count):
        for _ in range(count):
            if not self.alive():
                break
            self.act()
            self.tick()
        return self.trouble

    def act(self):
        widgets = list(self.widgets(self.root))
        widget = self.random.choice(widgets)
        kind = widget.winfo_class()
        self.done.append(f"{kind} {widget}")
        try:
            action = getattr(self, kind.lower(), None)
            if action:
                action(widget)
            else:
                self.point(widget)
            self.root.update()
        except tk.TclError as error:
            if (self.alive() and not any(part in str(error)
                                         for part in ("bad window path", "invalid command name",
                                                      "application has been destroyed"))):
                self.trouble.append(f"{self.done[-1]}: {error}")

    def tbutton(self, widget):
        if str(widget.cget("text")) not in self.leave:
            widget.invoke()

    button = tcheckbutton = tradiobutton = tbutton

    def tentry(self, widget):
        if str(widget.cget("state")) != "normal":
            return
        widget.focus_force()
        widget.delete(0, "end")
        widget.insert(0, self.random.choice(TEXTS))
        self.key(widget)

    entry = tentry

    def key(self, widget):
        widget.event_generate(f"<KeyPress-{(name := self.random.choice(KEYS))}>")
        widget.event_generate(f"<KeyRelease-{name}>")

    def point(self, widget):
        """A click anywhere on it, or a key."""
        if self.random.random() < 0.4:
            widget.focus_force()
            self.key(widget)
            return
        x, y = (self.random.randrange(max(1, n)) for n in (widget.winfo_width(), widget.winfo_height()))
        button = self.random.choice((1, 1, 1, 3, 4, 5))
        widget.event_generate(f"<ButtonPress-{button}>", x=x, y=y)
        widget.event_generate(f"<ButtonRelease-{button}>", x=x, y=y)

    def menu(self, widget):
        end = widget.index("end")
        if end is None:
            return
        place = self.random.randint(0, end)
        if (widget.type(place) in ("command", "radiobutton", "checkbutton")
                and str(widget.entrycget(place, "label")) not in self.leave):
            widget.invoke(place)
        widget.unpost()

    def tnotebook(self, widget):
        widget.select(self.random.choice(widget.tabs()))

    def treeview(self, widget):
        items = [i for top in widget.get_children() for i in (top, *widget.get_children(top))]
        if items:
            item = self.random.choice(items)
            widget.see(item)
            widget.item(item, open=self.random.random() < 0.7)
            self.root.update()
            if box := widget.bbox(item):
                for event in ("ButtonPress", "ButtonRelease"):
                    widget.event_generate(f"<{event}-{self.random.choice((1, 1, 3))}>",
                                          x=box[0] + min(40, box[2] // 2), y=box[1] + 3)

    def listbox(self, widget):
        if widget.size():
            widget.selection_clear(0, "end")
            widget.selection_set(self.random.randrange(widget.size()))
            widget.event_generate("<<ListboxSelect>>")

    def tscale(self, widget):
        low, high = float(widget.cget("from")), float(widget.cget("to"))
        widget.set(self.random.uniform(low, high))
