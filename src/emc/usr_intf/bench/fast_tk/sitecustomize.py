# SPDX-License-Identifier: GPL-2.0-or-later
"""With this folder first in PYTHONPATH a window program lives fast: what it does each 100 ms it does each millisecond.

SOAK_LIFE   file that gets "process-id hours": what the timer that waited longest has waited for, by its own count.
SOAK_HAND   words with commas between, one every PRESS_MS of the program's time: the label of a button that is pressed,
            or an event for what has the focus (<Down>).
SOAK_SIZE   WIDTHxHEIGHT of the window: what is drawn by software takes a time by its pixels.
"""
import os
import tkinter

SPEED, PRESS_MS, TELL_EVERY = 100, 10000, 200
waited, after, mainloop = {}, tkinter.Misc.after, tkinter.Misc.mainloop


def tell():
    place = os.environ["SOAK_LIFE"]
    with open(place + ".new", "w") as f:
        f.write(f"{os.getpid()} {max(ms for _, ms in waited.values()) / 3.6e6}\n")
    os.replace(place + ".new", place)


def fast_after(self, ms, func=None, *args):
    if func is None or not isinstance(ms, int):
        return after(self, ms, func, *args)
    name = getattr(func, "__qualname__", repr(func))

    def wrapped(*given):
        count, total = waited.get(name, (0, 0))
        waited[name] = count + 1, total + ms
        if count % TELL_EVERY == 0:
            tell()
        return func(*given)
    wrapped.__name__ = getattr(func, "__name__", "timer")
    return after(self, max(1, round(ms / SPEED)), wrapped, *args)


def all_widgets(top):
    yield top
    for child in top.winfo_children():
        yield from all_widgets(child)


def do(root, word):
    if word.startswith("<"):
        (root.focus_get() or root).event_generate(word)
        return
    for widget in all_widgets(root):
        if isinstance(widget, tkinter.ttk.Button) and str(widget.cget("text")) == word and widget.winfo_viewable():
            widget.invoke()
            return


def with_hand(self, n=0):
    words, root, pressed = os.environ.get("SOAK_HAND", ""), self.winfo_toplevel(), [0]

    def hand():
        wish = words.split(",")[pressed[0] % len(words.split(","))]
        pressed[0] += 1
        fast_after(root, PRESS_MS, hand)
        do(root, wish)
    if os.environ.get("SOAK_SIZE"):
        root.minsize(1, 1)
        root.geometry(os.environ["SOAK_SIZE"])
    if words:
        import tkinter.ttk  # noqa: F401
        root.focus_force()
        fast_after(root, PRESS_MS, hand)
    mainloop(self, n)


if "SOAK_LIFE" in os.environ:
    tkinter.Misc.after, tkinter.Misc.mainloop = fast_after, with_hand
