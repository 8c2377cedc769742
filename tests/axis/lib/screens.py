#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes one picture of the screen: the display program of `make screenshots`.

PICTURE: the file; SHOW: what is done before, as name=value words (dark, touch, tab, page, run, view, panel, dialog).
"""
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import operator_lib as lib
from PIL import ImageGrab


def script(op):
    app = op.app
    show = dict(word.split("=", 1) for word in os.environ.get("SHOW", "").split())
    app.set_dark("dark" in show)
    app.set_touch("touch" in show)
    if "scale" in show:
        app.set_scale(float(show["scale"]))
    app.vars.show_offsets.set("offsets" in show)
    op.power_on()
    op.home()
    if "view" in show:
        app.preview.set_view(show["view"])
    if "tab" in show:
        app.raise_tab(show["tab"])
    if "page" in show:
        op.root.tk.call(".pane.top.right", "raise", show["page"])
    if "run" in show:
        op.key("r")
        op.wait(float(show["run"]))
    if "line" in show:
        app.set_highlight_line(int(show["line"]))
    if "note" in show:
        app.notifications.add("info", "Insert tool 3, 6 mm end mill, then press Resume.")
        app.notifications.add("error", "joint 1 on limit switch error")
    app.estimate.wait()
    op.wait(0.3)
    for _ in range(200):                 # the exact picture is drawn in slices, by real time
        op.wait(0.02)
        if app.preview.picture.exact:
            break
    for _ in range(3):
        app.preview.invalidate()
        op.root.update()
    ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).crop((0, 0, op.root.winfo_rootx() + op.root.winfo_width(),
                                                         op.root.winfo_rooty() + op.root.winfo_height())).save(os.environ["PICTURE"], optimize=True)


lib.run(script)
