# SPDX-License-Identifier: GPL-2.0-or-later
"""teach-in [NMLFILE [OUTFILE]]: a button that writes down position, coolant and spindle."""

import sys
import tkinter as tk
from tkinter import ttk

import linuxcnc

from .. import tkstyle
from ..language import _, N_
from . import controller

JOINT, WORLD = N_("Joint"), N_("World")


class Window:
    def __init__(self, root, stat, out):
        self.root, self.stat, self.out, self.count = root, stat, out, 0
        style = tkstyle.apply(root)
        root.title("Teach-in")
        box = ttk.Frame(root, padding=style.px(10))
        box.pack(fill="both", expand=True)
        self.button = ttk.Button(box, text=_("Learn"), command=self.learn)
        self.button.pack(fill="x", ipady=style.px(10))
        self.system = tk.StringVar(root, WORLD)
        self.radios = {}
        for name in (JOINT, WORLD):
            self.radios[name] = ttk.Radiobutton(box, text=_(name), value=name, variable=self.system)
            self.radios[name].pack(anchor="w")
        self.label = ttk.Label(box, text=_("%d positions") % 0)
        self.label.pack(fill="x")
        root.minsize(style.px(220), 1)

    def learn(self):
        s = self.stat
        try:
            s.poll()
        except linuxcnc.error as error:
            self.label.configure(text=str(error), style="Bad.TLabel")
            return
        self.count += 1
        if self.system.get() == JOINT:
            values = s.joint_actual_position[:s.joints]
        else:
            values = [v for n, v in enumerate(s.actual_position) if s.axis_mask & (1 << n)]
        position = " ".join("%-8.4f" % v for v in values)
        print(self.count, position, s.flood, s.mist, 0, int(s.spindle[0]["enabled"]), file=self.out, flush=True)
        self.label.configure(text=_("%d positions") % self.count, style="TLabel")


def main(arguments):
    if arguments:
        linuxcnc.nmlfile = arguments[0]
    try:
        out = open(arguments[1], "w") if len(arguments) > 1 else sys.stdout
    except OSError as error:
        return f"teach-in: {arguments[1]}: {error.strerror}"
    stat = controller.status("teach-in")
    root = tkstyle.open_display("teach-in", "Teachin")
    Window(root, stat, out)
    root.mainloop()
    return 0
