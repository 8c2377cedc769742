#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A window that sets pins, parameters and signals.

sim_pin [--title TITLE] NAME[/mode=pulse|toggle|hold] ...
"""

import argparse
import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

from kerf.haltools.writable import Button, Item, NotWritable

POLL_MS = 100
PULSE_MS = 200          # longer than any poll of a program
ON, OFF = "#ff5a4d", "#d9d9d9"


def split(word):
    """NAME[/mode=MODE]: name, mode, whether the choice of modes is shown. Raises ValueError."""
    name, slash, option = word.partition("/")
    if not slash:
        return name, "toggle", True
    key, _, mode = option.partition("=")
    if key != "mode" or mode[:1].lower() + mode[1:] not in Button.MODES:
        raise ValueError(f"{word}: after the name stands /mode=pulse, /mode=toggle or /mode=hold (with a capital "
                         "first letter the mode cannot be chosen in the window)")
    return name, mode.lower(), mode[0].islower()


def number(calculator, text, kind):
    """Value of a Tcl expression. calculator: a Tk or Tcl object. Raises NotWritable."""
    import tkinter
    if not calculator.getboolean(calculator.eval("interp exists sums")):
        calculator.eval("interp create -safe sums")
    try:
        result = calculator.call("sums", "eval", ("expr", text))
    except tkinter.TclError as error:
        raise NotWritable(f"{text!r}: {str(error).splitlines()[0]}") from None
    try:
        return float(result) if kind == "float" else int(str(result), 0)
    except ValueError:
        raise NotWritable(f"{text!r} is {result}: a {'number' if kind == 'float' else 'whole number'} is needed") from None


class Row:
    """One item in the window."""

    def __init__(self, parent, item, mode, choice, say):
        import tkinter as tk
        self.tk, self.item, self.say = tk, item, say
        self.frame = tk.LabelFrame(parent, text=f"{item.name} ({item.kind} {item.what})", padx=6, pady=4)
        self.frame.pack(fill="x", padx=6, pady=3)
        (self.bit if item.kind == "bit" else self.numeric)(mode, choice)

    def try_to(self, action, *arguments):
        try:
            result = action(*arguments)
            self.say("")
            self.update()
            return result
        except NotWritable as error:
            self.say(str(error))
            return None

    def bit(self, mode, choice):
        tk, button = self.tk, Button(self.item, mode)
        self.button = tk.Button(self.frame, width=10)
        self.button.bind("<ButtonPress-1>", lambda _: self.press(button))
        self.button.bind("<ButtonRelease-1>", lambda _: self.try_to(button.release))
        self.button.bind("<KeyPress-space>", lambda _: self.press(button))
        self.button.bind("<KeyRelease-space>", lambda _: self.try_to(button.release))
        self.button.pack(side="left")
        if choice:
            self.mode = tk.StringVar(value=mode)
            for name in Button.MODES:
                tk.Radiobutton(self.frame, text=name.capitalize(), value=name, variable=self.mode,
                               command=lambda: setattr(button, "mode", self.mode.get())).pack(side="left")
        else:
            tk.Label(self.frame, text=mode.capitalize()).pack(side="left", padx=6)

    def press(self, button):
        if self.try_to(button.press):
            self.frame.after(PULSE_MS, lambda: self.try_to(button.end_pulse))

    def numeric(self, _mode, _choice):
        tk = self.tk
        self.value = tk.Label(self.frame, width=24, anchor="e", relief="sunken")
        self.value.pack(side="left")
        self.entry = tk.Entry(self.frame, width=14, justify="right")
        self.entry.insert(0, self.item.text().split()[0])
        self.entry.pack(side="left", padx=6)
        self.entry.bind("<Return>", lambda _: self.try_to(self.enter))
        self.entry.bind("<KP_Enter>", lambda _: self.try_to(self.enter))
        actions = [("Set", self.enter), ("Reset", self.item.reset)]
        if self.item.kind != "float":
            actions += [("-", lambda: self.item.step(-1)), ("+", lambda: self.item.step(1))]
        self.buttons = {}
        for name, action in actions:
            self.buttons[name] = tk.Button(self.frame, text=name, command=lambda a=action: self.try_to(a))
            self.buttons[name].pack(side="left")

    def enter(self):
        self.item.set(number(self.frame.tk, self.entry.get(), self.item.kind))

    def update(self):
        """Shows the value. Raises NotWritable when the item is gone."""
        text = self.item.text()
        if self.item.kind == "bit":
            color = ON if text == "1" else OFF
            self.button.configure(text=f"{'ON' if text == '1' else 'OFF'}", bg=color, activebackground=color)
        else:
            self.value.configure(text=text)


class Window:
    """items: (Item, mode, whether the choice of modes is shown)."""

    def __init__(self, root, title, items):
        import tkinter as tk
        self.root = root
        root.title(title)
        self.rows = [Row(root, *item, self.say) for item in items]
        self.status = tk.Label(root, anchor="w", fg="#a00000", wraplength=480, justify="left")
        self.status.pack(fill="x", padx=6)
        root.resizable(False, False)
        self.poll()

    def say(self, text):
        self.status.configure(text=text)

    def poll(self):
        try:
            for row in self.rows:
                row.update()
        except NotWritable as error:        # HAL was unloaded
            print(f"sim_pin: {error}", file=sys.stderr)
            self.root.destroy()
            return
        self.root.after(POLL_MS, self.poll)


def main():
    parser = argparse.ArgumentParser(prog="sim_pin", description="Sets pins, parameters and signals from a window.")
    parser.add_argument("--title", default="sim_pin")
    parser.add_argument("names", nargs="+", metavar="NAME[/mode=pulse|toggle|hold]")
    options = parser.parse_args()
    try:
        words = [split(word) for word in options.names]
        items = [(Item(name), mode, choice) for name, mode, choice in words]
    except (ValueError, NotWritable, RuntimeError) as error:
        sys.exit(f"sim_pin: {error}")
    if not os.environ.get("DISPLAY"):
        sys.exit("sim_pin: no display (DISPLAY is not set)")
    import tkinter
    try:
        root = tkinter.Tk(className="sim_pin")
    except tkinter.TclError as error:
        sys.exit(f"sim_pin: {error}")
    Window(root, options.title, items)
    root.mainloop()


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
