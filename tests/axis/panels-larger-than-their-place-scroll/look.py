#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import os
import sys
import time

import room
from kerf import language

if os.environ.get("TONGUE") == "long":
    language.catalogue = room.longer
import operator_lib as lib

WHEEL_UP, WHEEL_DOWN = 4, 5


def buttons(widget):
    for child in widget.winfo_children():
        if child.winfo_class() == "Button":
            yield child
        yield from buttons(child)


class Looker:
    def __init__(self, op):
        self.op, self.app = op, op.app

    def settle(self):
        for _ in range(4):
            self.op.root.update()

    def shown(self, view):
        self.op.root.update_idletasks()
        return " and ".join(name for name, on in zip(("across", "down"), view.scrolls()) if on) or "no bars"

    def in_sight(self, view, widget):
        self.settle()
        port = view.port
        return (port.winfo_rootx() <= widget.winfo_rootx()
                and widget.winfo_rootx() + widget.winfo_width() <= port.winfo_rootx() + port.winfo_width()
                and port.winfo_rooty() <= widget.winfo_rooty()
                and widget.winfo_rooty() + widget.winfo_height() <= port.winfo_rooty() + port.winfo_height())

    def wheel(self, widget, button, times=1, state=0):
        for n in range(times):
            widget.event_generate(f"<ButtonPress-{button}>", x=3, y=3, state=state, time=Looker.time)
            widget.event_generate(f"<ButtonRelease-{button}>", x=3, y=3, state=state, time=Looker.time)
            Looker.time += 10
        self.settle()

    time = 1000000


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, look = op.app, Looker(op)
    panel, tab, guest = app.views
    end = time.monotonic() + 60          # another program, in real time
    while guest.need()[0] < 900 and time.monotonic() < end:
        op.wait(0.02)
        time.sleep(0.02)
    for words in os.environ["LOOKS"].split():
        _, scale, theme, *touch = words.split(":")
        app.set_dark(theme == "dark")
        app.set_touch(bool(touch))
        app.set_scale(float(scale or 0))
        op.wait(0.3)
        print(f"{words}: letters {app.letters_px()}, panel: {look.shown(panel)}")
        for page in ("preview", "user_0", "user_1"):
            op.root.tk.call(".pane.top.right", "raise", page)
            look.settle()
            for line in room.troubles(op.root):
                if "code" not in line and ".bottom.t.text" not in line:
                    print("   ", page, line)
    app.set_scale(1.0)
    all_ = list(buttons(panel.inner))
    first, last = all_[0], all_[-1]
    spin = last.master.winfo_children()[-1]
    print("first, last in sight:", look.in_sight(panel, first), look.in_sight(panel, last))
    look.wheel(first, WHEEL_DOWN, 50)
    print("after the wheel:", look.in_sight(panel, first), look.in_sight(panel, last))
    before = spin.get()
    look.wheel(spin, WHEEL_UP)
    print("the wheel over a spinbox sets it:", before, spin.get(), "and scrolls:", not look.in_sight(panel, last))
    first.focus_force()
    print("the focus brings the first back:", look.in_sight(panel, first))
    spin.focus_force()
    print("and the last:", look.in_sight(panel, spin))
    panel.bars[1].event_generate("<ButtonPress-1>", x=5, y=3)
    panel.bars[1].event_generate("<ButtonRelease-1>", x=5, y=3)
    print("the arrow of the bar moves it:", not look.in_sight(panel, spin))
    op.root.tk.call(".pane.top.right", "raise", "user_0")
    look.settle()
    print("tab:", look.shown(tab))
    all_ = list(buttons(tab.inner))
    row = all_[-1].master.winfo_children()
    for what in (row[-1], row[0]):
        what.focus_force()
        print(what["text"], "in sight:", look.in_sight(tab, what))
    all_[0].focus_force()
    look.settle()
    print("back at the begin:", tab.at)
    look.wheel(all_[0], WHEEL_DOWN, 99, 1)
    print("Shift and the wheel:", tab.at[0] > 0, tab.at[1])
    op.root.tk.call(".pane.top.right", "raise", "user_1")
    look.settle()
    print("another program:", look.shown(guest), guest.need()[1] >= 800)
    op.key("e", state=4)
    op.root.update()
    print("Ctrl-E: shown:", bool(panel.winfo_viewable()), end=" ")
    op.key("e", state=4)
    op.root.update()
    print("again:", bool(panel.winfo_viewable()), look.shown(panel))
    if "PICTURES" in os.environ:
        from PIL import ImageGrab
        ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).save(f"{os.environ['PICTURES']}/{op.app.panel_at_bottom}.png")


lib.run(script)
