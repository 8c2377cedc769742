# SPDX-License-Identifier: GPL-2.0-or-later
"""halmeter: one value of HAL in a small window that stays on top."""

import os
import sys
import tkinter as tk
import tkinter.font
from tkinter import ttk

import hal
from hal import query

from .. import tkstyle
from ..language import _, N_
from .watch import Item

PERIOD_MS = 100
WIDTH, HEIGHT, SMALL_HEIGHT = 270, 80, 22
KINDS = {"pin": "pin", "sig": "sig", "par": "param"}        # by the first three letters
NOTHING, NO_NAME = "---", "-----"
USAGE = """Usage: halmeter [-s] [pin|sig|param NAME] [-g X Y [WIDTH]]
  -s               a small window without buttons
  -g X Y [WIDTH]   place and width of the window, pixels"""


class UsageError(Exception):
    pass


def parse(arguments):
    """(small, kind or None, name, (x, y, width) or None). Raises UsageError."""
    small, kind, name, place = False, None, "", None
    words = list(arguments)
    while words:
        word = words.pop(0)
        if word == "-s":
            small = True
        elif word == "-g":
            numbers = []
            while words and len(numbers) < 3 and words[0].lstrip("-").isdigit():
                numbers.append(int(words.pop(0)))
            if len(numbers) < 2:
                raise UsageError("ERROR: -g needs X and Y")
            place = tuple(numbers) if len(numbers) == 3 else (*numbers, None)
        elif word.startswith("-"):
            raise UsageError(f"ERROR: unknown option '{word}'\n{USAGE}")
        else:
            kind = KINDS.get(word[:3])
            if not kind:
                raise UsageError(f"ERROR: '{word}' is not a valid probe type")
            if not words:
                raise UsageError("ERROR: no pin/signal/parameter name")
            name = words.pop(0)
    if small and not kind:
        raise UsageError("ERROR: -s option requires a probe type and a pin/signal/parameter name")
    return small, kind, name, place


def text_of(type_, value):
    if value is None:
        return NOTHING
    if type_ == "bit":
        return "TRUE" if value else "FALSE"
    if type_ == "float":
        return f"{value:.7g}"
    if type_[0] == "u":
        return f"{value:10d} (0x{value:0{8 if type_ == 'u32' else 16}X})"
    return f"{value:10d}"


class Window:
    def __init__(self, root, small, kind, name, place):
        self.root, self.small, self.item, self.timer, self.chooser = root, small, None, None, None
        style = self.style = tkstyle.apply(root)
        root.attributes("-topmost", True)
        big = tkinter.font.nametofont("TkDefaultFont", root).copy()
        self.big = big
        self.value = ttk.Label(root, text=NOTHING, anchor="center", font=big)
        self.label = ttk.Label(root, text=NO_NAME, anchor="center")
        px = style.px
        width, height = px(WIDTH), px(SMALL_HEIGHT if small else HEIGHT)
        if small:
            self.value.pack(fill="both", expand=True)
            height = max(height, self.value.winfo_reqheight())
        else:
            big.configure(size=round(big.cget("size") * 1.5))
            root.title("Hal Meter")
            buttons = ttk.Frame(root)
            buttons.pack(side="bottom", fill="x")
            self.buttons = {}
            for text, action in ((N_("Select"), self.select), (N_("Exit"), self.exit)):
                self.buttons[text] = ttk.Button(buttons, text=_(text), command=action,
                                                padding=(px(4), style.roomy(1, 9)))
                self.buttons[text].pack(side="left", expand=True, fill="x")
            self.label.pack(side="bottom", fill="x")
            self.value.pack(fill="both", expand=True)
            root.update_idletasks()
            height = max(height, root.winfo_reqheight())
        if place:
            width = place[2] or width
            root.geometry(f"{width}x{height}+{place[0]}+{place[1]}")
        else:
            root.geometry(f"{width}x{height}")
        root.minsize(px(60), height)
        root.protocol("WM_DELETE_WINDOW", self.exit)
        if kind:
            self.probe(kind, name)
        if not self.item and not small:
            root.after_idle(self.select)
        self.tick()

    def probe(self, kind, name):
        """This item from now on. False: there is none of that name."""
        item = Item(kind, name)
        if not item.info:
            print(f"halmeter: there is no {kind} '{name}'", file=sys.stderr)
            return False
        self.item = item
        self.label.configure(text=name)
        if self.small:
            self.root.title(name)
        self.show()
        return True

    def show(self):
        """The window grows with what it shows, and stays as wide."""
        there = self.item and self.item.refresh()           # it may go and come back with another type
        self.value.configure(text=text_of(self.item.type, self.item.value()) if there else NOTHING)
        needed = max(self.value.winfo_reqwidth(),
                     self.label.winfo_reqwidth() if not self.small else 0) + self.style.px(8)
        if 1 < self.root.winfo_width() < needed <= self.root.winfo_screenwidth():
            self.root.geometry(f"{needed}x{self.root.winfo_height()}")

    def tick(self):
        self.show()
        self.timer = self.root.after(PERIOD_MS, self.tick)

    def select(self):
        if self.chooser and self.chooser.window.winfo_exists():
            self.chooser.window.lift()
            return
        self.chooser = Chooser(self)

    def exit(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()


class Chooser:
    """Lists of everything that can be shown; a click shows it at once."""

    def __init__(self, meter):
        self.meter, style = meter, meter.style
        px = style.px
        window = self.window = tk.Toplevel(meter.root)
        window.title(_("Select Item to Probe"))
        window.attributes("-topmost", True)
        ttk.Button(window, text=_("Close"), command=window.destroy).pack(side="bottom", pady=px(6))
        row = ttk.Frame(window, padding=px(4))
        row.pack(side="bottom", fill="x")
        ttk.Label(row, text=_("Find:")).pack(side="left")
        self.find = ttk.Entry(row)
        self.find.pack(side="left", fill="x", expand=True, padx=px(4))
        self.find.bind("<KeyRelease>", lambda event: self.fill())
        self.book = ttk.Notebook(window)
        self.book.pack(fill="both", expand=True, padx=px(4), pady=px(4))
        self.names = {"pin": list(query.pins()), "sig": list(query.signals()), "param": list(query.params())}
        self.lists = {}
        for kind, title in (("pin", N_("Pins")), ("sig", N_("Signals")), ("param", N_("Parameters"))):
            page = ttk.Frame(self.book)
            box = self.lists[kind] = tk.Listbox(page, exportselection=False, activestyle="none", relief="flat",
                                                font="TkDefaultFont")
            bar = ttk.Scrollbar(page, command=box.yview)
            box.configure(yscrollcommand=bar.set)
            bar.pack(side="right", fill="y")
            box.pack(fill="both", expand=True)
            box.bind("<<ListboxSelect>>", lambda event, k=kind: self.chosen(k))
            self.book.add(page, text=_(title))
        self.fill()
        tkstyle.centre(window, px(340), px(440), (px(200), px(200)))
        window.bind("<Escape>", lambda event: window.destroy())
        if meter.item:
            self.book.select(list(self.lists).index(meter.item.kind))

    def fill(self):
        """The names that contain what was typed."""
        part = self.find.get().strip().lower()
        for kind, box in self.lists.items():
            box.delete(0, "end")
            box.insert("end", *[n for n in self.names[kind] if part in n.lower()])
            if self.meter.item and self.meter.item.kind == kind and self.meter.item.name in box.get(0, "end"):
                box.selection_set(box.get(0, "end").index(self.meter.item.name))
                box.see("active")

    def chosen(self, kind):
        box = self.lists[kind]
        if box.curselection():
            self.meter.probe(kind, box.get(box.curselection()[0]))


def main(arguments):
    if "-h" in arguments or "--help" in arguments:
        print(USAGE)
        return 0
    try:
        small, kind, name, place = parse(arguments)
    except UsageError as error:
        print(error, file=sys.stderr)
        return 1
    root = tkstyle.open_display("halmeter", "Halmeter")
    component = hal.component(f"halmeter-{os.getpid()}")
    component.ready()
    window = Window(root, small, kind, name, place)
    if small and not window.item:
        return 1
    root.mainloop()
    component.exit()
    return 0
