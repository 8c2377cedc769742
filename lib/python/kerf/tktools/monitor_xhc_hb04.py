# SPDX-License-Identifier: GPL-2.0-or-later
"""monitor-xhc-hb04: tells the operator when the pendant's connection comes and goes."""

import sys
import tkinter as tk
from tkinter import ttk

import hal

from .. import tkstyle
from ..language import _

PERIOD_MS = 2000
CONNECTED, REQUIRED = "xhc-hb04.connected", "xhc-hb04.require_pendant"


class Monitor:
    """step() says what the operator should read, or None. `ended`: there is nothing more to watch."""

    def __init__(self, read=hal.get_p):
        """read(name): the pin, None when it is not there."""
        self.read, self.connected, self.ended = read, None, False

    def step(self):
        now, required = self.read(CONNECTED), self.read(REQUIRED)
        if now is None or required is None:
            self.ended = True
            return None
        first, changed = self.connected is None, self.connected is not None and now != self.connected
        self.connected = now
        if first:
            return None if now or required else _("Not connected to pendant")
        if not changed:
            return None
        if now:
            return _("Connected to pendant") + ("\n\n" + _("Unexpected") if required else "")
        if required:
            self.ended = True
        return _("Lost connection to pendant") + ("\n\n" + _("Reconnect not supported for require_pendant==1")
                                                  if required else "")


class Window:
    """Hidden until there is something to read; OK hides it."""

    def __init__(self, root, monitor):
        self.root, self.monitor = root, monitor
        px = tkstyle.apply(root).px
        root.title(_("Pendant"))
        root.attributes("-topmost", True)
        self.label = ttk.Label(root, padding=px(20), justify="center")
        self.label.pack()
        self.button = ttk.Button(root, text="OK", command=root.withdraw)
        self.button.pack(pady=(0, px(16)), ipadx=px(12), ipady=px(6))
        root.bind("<Return>", lambda event: root.withdraw())
        root.protocol("WM_DELETE_WINDOW", root.withdraw)
        root.withdraw()

    def tick(self):
        """False when the program has no more purpose."""
        text = self.monitor.step()
        if text:
            self.label.configure(text=text)
            self.root.deiconify()
            self.root.lift()
        return not self.monitor.ended

    def run(self):
        if self.tick():
            self.root.after(PERIOD_MS, self.run)
        elif self.root.state() == "withdrawn":
            print("monitor-xhc-hb04: component xhc-hb04 is not loaded: nothing to watch", file=sys.stderr)
            self.root.destroy()
        else:           # the last message is still to be read
            self.button.configure(command=self.root.destroy)
            self.root.protocol("WM_DELETE_WINDOW", self.root.destroy)


def main(_arguments):
    root = tkstyle.open_display("monitor-xhc-hb04", "Monitor-xhc-hb04")
    window = Window(root, Monitor())
    root.after_idle(window.run)
    try:
        root.mainloop()
    except tk.TclError:
        pass
    return 0
