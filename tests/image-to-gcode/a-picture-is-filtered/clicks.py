# SPDX-License-Identifier: GPL-2.0-or-later
import contextlib
import io
import tkinter as tk

from kerf.tktools import image_to_gcode as tool
from tk_hand import Hand

steps = iter(())


def by_hand(root, n=0):
    """In place of the main loop: what the user does."""
    next(steps)(tool_window[-1], Hand(root))


tool_window = []
original = tool.Window.__init__


def remembering(self, *arguments):
    original(self, *arguments)
    tool_window.append(self)


tool.Window.__init__ = remembering
tk.Misc.mainloop = by_hand


def run(*doings):
    global steps
    steps = iter(doings)
    out = io.StringIO()
    status = None
    with contextlib.redirect_stdout(out):
        try:
            status = tool.main(["a.png"])
        except SystemExit as end:
            status = end.code
    lines = out.getvalue().splitlines()
    print("status:", status, "lines:", lines[:1], len(lines) > 10)


said = []


def fill(window, hand):
    said.append(window.root.title())
    for name, text in (("pixel_size", "0.2"), ("feed_rate", "5x")):
        window.fields[name].set(text)
    hand.settle()
    said.append(window.told.cget("text"))
    hand.click(window.ok)
    said.append(f"open: {bool(window.root.winfo_exists())}")
    window.fields["feed_rate"].set("500")
    window.fields["units"].set("G21")
    window.fields["spindle_speed"].set("0")
    window.fields["safety_height"].set("3")
    window.fields["tool_diameter"].set("1.5")
    hand.settle()
    said.append((window.told.cget("text"), window.size.cget("text")))
    hand.click(window.ok)


run(fill)
print(*said, sep="\n")
run(lambda window, hand: hand.click(window.cancel))
run(lambda window, hand: hand.key("Escape"))
