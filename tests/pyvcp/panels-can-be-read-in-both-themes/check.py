# SPDX-License-Identifier: GPL-2.0-or-later
# Every widget of a panel, in the light and the dark theme: letters and lines differ from their ground, drawings have
# the panel's ground, and colours that the panel's author chose for both stay.
import os
import tkinter

import hal
import vcpparse
from axis import looks
from kerf import tkstyle

LEAST = 0.3


def brightness(widget, colour):
    return sum(share * value for share, value in zip((0.299, 0.587, 0.114), widget.winfo_rgb(colour))) / 65535


def weak(widget):
    """What can hardly be read in a widget and those in it."""
    if "foreground" in widget.keys() and widget.winfo_class() != "Scale":
        if abs(brightness(widget, widget["foreground"]) - brightness(widget, widget["background"])) < LEAST:
            yield f"{widget.winfo_class()} {widget['foreground']} on {widget['background']}"
    if widget.winfo_class() in ("Checkbutton", "Radiobutton"):      # the mark has the letters' colour
        for box in (widget["selectcolor"], (looks.DARK if os.environ["KERF_THEME"] == "dark" else looks.LIGHT)["mark"]):
            if abs(brightness(widget, widget["foreground"]) - brightness(widget, box)) < 0.5:
                yield f"a mark {widget['foreground']} in a box {box}"
    if isinstance(widget, tkinter.Canvas):
        if widget["background"] != widget.master["background"]:
            yield f"a drawing on {widget['background']} in {widget.master['background']}"
        for item in (i for i in widget.find_all() if widget.type(i) == "text" and widget.itemcget(i, "text")):
            # letters on a face or a bar have that for their ground
            at = widget.bbox(item)
            below = [i for i in widget.find_overlapping(*at)
                     if i < item and widget.type(i) in ("oval", "rectangle") and widget.itemcget(i, "fill")]
            ground = widget.itemcget(below[0], "fill") if below else widget["background"]
            if abs(brightness(widget, widget.itemcget(item, "fill")) - brightness(widget, ground)) < LEAST:
                yield f"{widget.itemcget(item, 'text')!r} {widget.itemcget(item, 'fill')} on {ground}"
    for child in widget.winfo_children():
        yield from weak(child)


for theme in ("light", "dark"):
    os.environ["KERF_THEME"] = theme
    root = tkinter.Tk()
    tkstyle.apply(root)
    component = hal.component(f"panel-{theme}")
    vcpparse.create_vcp(root, component, "panel.xml")
    root.update()
    print(theme, *(list(weak(root)) or ["reads well"]), sep="\n  ")
    labels = {w["text"]: w["foreground"] for w in root.winfo_children() if w.winfo_class() == "Label"}
    print("  the author's own:", labels["both chosen"])
    root.destroy()
    component.exit()
