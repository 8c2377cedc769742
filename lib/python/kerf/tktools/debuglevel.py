# SPDX-License-Identifier: GPL-2.0-or-later
"""debuglevel [-ini FILE]: one box per debug flag of the running controller."""

import tkinter as tk
from tkinter import ttk

import linuxcnc

from .. import tkstyle
from ..language import _, N_
from . import controller

POLL_MS = 1000
FLAGS = ((N_("Configuration *"), 0x2), (N_("Version Numbers *"), 0x8), ("NML *", 0x40), ("RCS *", 0x200),
         (N_("Task Issue"), 0x10), (N_("Motion Time"), 0x80),
         (N_("Interpreter"), 0x100), (N_("Interpreter List"), 0x800), (N_("State Tags"), 0x80000))
KNOWN = sum(flag[1] for flag in FLAGS)


class Window:
    def __init__(self, root, stat, command):
        self.root, self.stat, self.command, self.timer = root, stat, command, None
        style = tkstyle.apply(root)
        root.title("LinuxCNC Debug Level")
        box = ttk.Frame(root, padding=style.px(10))
        box.pack(fill="both", expand=True)
        self.boxes = []
        for text, bit in FLAGS:
            variable = tk.BooleanVar(root)
            button = ttk.Checkbutton(box, text=_(text), variable=variable, command=self.send)
            button.pack(fill="x")
            self.boxes.append((bit, variable, button))
        ttk.Label(box, text=_("* only effective in the INI file"), style="Faint.TLabel").pack(fill="x", pady=(style.px(6), 0))
        self.label = ttk.Label(box, style="Value.TLabel")
        self.label.pack(fill="x", pady=(style.px(6), 0))
        root.minsize(style.px(240), 1)
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.tick()

    def value(self):
        """The boxes, and the bits that have none."""
        return (self.stat.debug & ~KNOWN) | sum(bit for bit, variable, _button in self.boxes if variable.get())

    def send(self):
        self.command.debug(self.value())
        self.command.wait_complete(1.0)
        self.look()

    def look(self):
        self.stat.poll()
        self.label.configure(text="[EMC]DEBUG=0x%08x" % (self.stat.debug & 0xFFFFFFFF))
        for bit, variable, _button in self.boxes:
            variable.set(bool(self.stat.debug & bit))

    def tick(self):
        try:
            self.look()
        except linuxcnc.error:      # the controller has ended
            self.root.destroy()
            return
        self.timer = self.root.after(POLL_MS, self.tick)

    def close(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()


def main(arguments):
    stat = controller.status("debuglevel", arguments)
    root = tkstyle.open_display("debuglevel", "Debuglevel")
    Window(root, stat, linuxcnc.command())
    root.mainloop()
    return 0
