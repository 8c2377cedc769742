#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A window with a button that stands for a probe: motion.probe-input is set while it is pressed."""

import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

from hal import query
from kerf import tkstyle
from kerf.language import _
from kerf.haltools.writable import Item, NotWritable

PIN = "motion.probe-input"
LOOK_MS = 100           # of a pulse
POLL_MS = 500
IDLE, ON, OFF = _("Push to simulate\nProbe touch"), _("ProbeON"), _("ProbeOFF")


def find():
    """The probe's pin, set to 0. Raises NotWritable."""
    pin = query.pin(PIN)
    if not pin:
        raise NotWritable(f"Is LinuxCNC running? <there is no pin {PIN}>")
    if pin["signal"]:
        raise NotWritable(f"The pin {PIN} is currently connected to a signal ({pin['signal']}): "
                          f"halcmd unlinkp {PIN} frees it")
    item = Item(PIN)
    item.set(False)
    return item


class Probe:
    """pressed() and released() say what the button shows: on or not."""

    def __init__(self, item):
        self.item, self.pulse = item, False

    def pressed(self):
        """With `pulse` the pin is 1 for a moment only."""
        self.item.set(True)
        if self.pulse:
            self.item.set(False)

    def released(self):
        self.item.set(False)


class Window:
    def __init__(self, root, probe):
        import tkinter as tk
        from tkinter import ttk
        self.root, self.probe = root, probe
        style = tkstyle.apply(root)
        root.title("simulate_probe")
        self.pulse = tk.BooleanVar(root, value=False)
        self.button = tk.Button(root, text=IDLE, width=24, height=3)
        self.color = self.button["bg"]
        self.button.pack(padx=style.px(8), pady=style.px(8), fill="both", expand=True)
        self.check = ttk.Checkbutton(root, text=_("Pulse"), variable=self.pulse,
                                     command=lambda: setattr(probe, "pulse", self.pulse.get()))
        self.check.pack(pady=(0, style.px(6)))
        self.button.bind("<ButtonPress-1>", self.press)
        self.button.bind("<ButtonRelease-1>", self.release)
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.timer = None       # of poll()
        self.poll()

    def end(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()

    def show(self, text, color):
        self.button.configure(text=text, bg=color, activebackground=color)

    def attempt(self, action):
        """The pin is gone or was connected meanwhile: the program has no more purpose."""
        try:
            action()
            return True
        except NotWritable as error:
            print(f"simulate_probe: {error}", flush=True)
            self.end()
            return False

    def press(self, _event):
        if self.attempt(self.probe.pressed):
            self.show(ON, "red")
            if self.probe.pulse:
                self.root.after(LOOK_MS, lambda: self.show(OFF, self.color))

    def release(self, _event):
        if not self.probe.pulse and self.attempt(self.probe.released):
            self.show(OFF, self.color)

    def poll(self):
        if self.attempt(self.probe.item.get):
            self.timer = self.root.after(POLL_MS, self.poll)

    def close(self):
        """The probe does not stay touched behind a closed window."""
        if self.attempt(self.probe.released):
            self.end()


def main():
    try:
        item = find()
    except (NotWritable, RuntimeError) as error:
        print(error)
        return 1
    root = tkstyle.open_display("simulate_probe", "Simulate_probe")
    tkstyle.run(root, Window(root, Probe(item)).close)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
