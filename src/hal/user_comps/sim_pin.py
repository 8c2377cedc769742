#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A window that sets pins, parameters and signals.

sim_pin [--title TITLE] NAME[/mode=pulse|toggle|hold] ...
"""

import argparse
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

from kerf import tkstyle
from kerf.language import _, N_
from kerf.numbertext import with_point
from kerf.haltools.writable import Button, Item, NotWritable

POLL_MS = 100
MODES = (N_("Pulse"), N_("Toggle"), N_("Hold"))
PULSE_MS = 200          # longer than any poll of a program


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
        result = calculator.call("sums", "eval", ("expr", with_point(text)))
    except tkinter.TclError as error:
        raise NotWritable(f"{text!r}: {str(error).splitlines()[0]}") from None
    try:
        return float(result) if kind == "float" else int(str(result), 0)
    except ValueError:
        raise NotWritable((_("%r is %s: a number is needed") if kind == "float"
                           else _("%r is %s: a whole number is needed")) % (text, result)) from None


class Row:
    """One item in the window."""

    def __init__(self, parent, style, item, mode, choice, say):
        import tkinter as tk
        from tkinter import ttk
        self.tk, self.ttk, self.style, self.item, self.say, self.held = tk, ttk, style, item, say, None
        self.frame = ttk.LabelFrame(parent, text=f"{item.name} ({item.kind} {_(item.what)})", padding=style.px(6))
        self.frame.pack(fill="x", padx=style.px(6), pady=style.px(3))
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
        tk, ttk, button = self.tk, self.ttk, Button(self.item, mode)
        self.held, self.key_up = button, None
        self.key_down = False
        self.button = tk.Button(self.frame, width=10, pady=self.style.roomy(3, 5))
        self.button.bind("<ButtonPress-1>", lambda _event: self.press(button))
        self.button.bind("<ButtonRelease-1>", lambda _event: self.try_to(button.release))
        self.button.bind("<KeyPress-space>", self.key_pressed)
        self.button.bind("<KeyRelease-space>", self.key_released)
        self.button.bind("<FocusOut>", lambda _event: self.key_down and self.let_go())
        self.button.pack(side="left")
        if choice:
            self.mode = tk.StringVar(value=mode)
            for name, title in zip(Button.MODES, MODES):
                ttk.Radiobutton(self.frame, text=_(title), value=name, variable=self.mode,
                                command=lambda: setattr(button, "mode",
                                                        self.mode.get())).pack(side="left", padx=self.style.px(4))
        else:
            ttk.Label(self.frame, text=_(MODES[Button.MODES.index(mode)])).pack(side="left", padx=self.style.px(6))

    def press(self, button):
        if self.try_to(button.press):
            self.frame.after(PULSE_MS, lambda: self.try_to(button.end_pulse))

    def key_pressed(self, _event):
        """The first press only: a held key repeats release and press, together."""
        if self.key_up:
            self.frame.after_cancel(self.key_up)
            self.key_up = None
        elif not self.key_down:
            self.key_down = True
            self.press(self.held)

    def key_released(self, _event):
        if self.key_down and not self.key_up:
            self.key_up = self.frame.after(1, self.let_go)

    def let_go(self):
        if self.key_up:
            self.frame.after_cancel(self.key_up)
        self.key_down, self.key_up = False, None
        self.try_to(self.held.release)

    def finish(self):
        """A bit that is set only as long as something is pressed does not stay set behind a closed window."""
        if self.held:
            self.try_to(self.held.finish)

    def numeric(self, _mode, _choice):
        ttk = self.ttk
        self.value = ttk.Label(self.frame, width=24, anchor="e", relief="sunken", style="Value.TLabel",
                               padding=self.style.px(3))
        self.value.pack(side="left")
        self.entry = ttk.Entry(self.frame, width=14, justify="right")
        self.entry.insert(0, self.item.text().split()[0])
        self.entry.pack(side="left", padx=6)
        self.entry.bind("<Return>", lambda _event: self.try_to(self.enter))
        self.entry.bind("<KP_Enter>", lambda _event: self.try_to(self.enter))
        actions = [(N_("Set"), self.enter), (N_("Reset"), self.item.reset)]
        if self.item.kind != "float":
            actions += [("-", lambda: self.item.step(-1)), ("+", lambda: self.item.step(1))]
        self.buttons = {}
        for name, action in actions:
            self.buttons[name] = ttk.Button(self.frame, text=_(name), style="Small.TButton",
                                            command=lambda a=action: self.try_to(a))
            self.buttons[name].pack(side="left")

    def enter(self):
        self.item.set(number(self.frame.tk, self.entry.get(), self.item.kind))

    def update(self):
        """Shows the value. Raises NotWritable when the item is gone."""
        text = self.item.text()
        if self.item.kind == "bit":
            color = self.style.colours["on" if text == "1" else "pressed"]
            self.button.configure(text=_("ON") if text == "1" else _("OFF"), bg=color, activebackground=color)
        else:
            self.value.configure(text=text)


class Window:
    """items: (Item, mode, whether the choice of modes is shown)."""

    def __init__(self, root, title, items):
        from tkinter import ttk
        self.root = root
        root.title(title)
        style = tkstyle.apply(root)
        self.rows = [Row(root, style, *item, self.say) for item in items]
        self.status = ttk.Label(root, anchor="w", style="Bad.TLabel", wraplength=style.px(480), justify="left")
        self.status.pack(fill="x", padx=style.px(6))
        root.resizable(False, False)
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.poll()

    def close(self):
        for row in self.rows:
            row.finish()
        self.root.destroy()

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
    root = tkstyle.open_display("sim_pin", "Sim_pin")
    tkstyle.run(root, Window(root, options.title, items).close)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
