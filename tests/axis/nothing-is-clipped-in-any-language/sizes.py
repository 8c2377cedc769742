#!/usr/bin/python3
import sys

import operator_lib as lib

KINDS = ("Label", "Button", "Radiobutton", "Checkbutton", "Entry", "TCombobox", "Scale", "Text", "Listbox")


def clipped(op):
    """(path, what) of widgets that have less room than they ask for, or lie outside of what holds them."""
    tcl, root, found = op.root.tk, op.root, []

    def number(what, path):
        return int(tcl.call("winfo", what, path))

    def walk(path, box):
        for child in map(str, tcl.splitlist(tcl.call("winfo", "children", path))):
            kind = str(tcl.call("winfo", "class", child))
            if not number("viewable", child) or kind in ("Menu", "Togl") or str(tcl.call("winfo", "toplevel", child)) != ".":
                continue
            x, y, w, h = (number(what, child) for what in ("rootx", "rooty", "width", "height"))
            inner = (max(box[0], x), max(box[1], y), min(box[2], x + w), min(box[3], y + h))
            if kind in KINDS:
                if kind not in ("Text", "Listbox", "Scale", "Entry") and number("reqwidth", child) > w + 1:
                    found.append((child, f"asks for {number('reqwidth', child)} pixels, has {w}"))
                if x < box[0] - 1 or y < box[1] - 1 or x + w > box[2] + 1 or (y + h > box[3] + 1 and kind not in ("Text",)):
                    found.append((child, f"is cut off: {(x, y, x + w, y + h)} in {box}"))
            walk(child, inner)
    root.update()
    walk(".", (root.winfo_rootx(), root.winfo_rooty(), root.winfo_rootx() + root.winfo_width(), root.winfo_rooty() + root.winfo_height()))
    return found


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    small = op.root.winfo_screenheight() < 700
    print("screen:", op.root.winfo_screenheight(), "letters:", app.letters_px(), "title of the left tab:", op.root.tk.call(".pane.top.tabs", "itemcget", "manual", "-text"))
    op.power_on()
    for dark, touch, scale in ((False, False, 0.0), (True, False, 1.0), (False, True, 1.0), *(() if small else ((False, False, 1.5), (True, False, 2.0), (False, True, 2.0)))):
        app.set_dark(dark)
        app.set_touch(touch)
        app.set_scale(scale)
        for tab in ("manual", "mdi"):
            app.raise_tab(tab)
            op.wait(0.1)
            for path, what in clipped(op):
                print("dark" * dark, "touch" * touch, scale, tab, path, what)
        print("theme", "dark" if dark else "light", "touch" * touch, "scale", scale, "letters", app.letters_px(), "icon", app.icons.get("run").width(),
              "background", app.widgets.homebutton.cget("background") == app.colours["face"])
    app.TclCommands.gcode_properties()
    print("properties translated:", app.translate("Run time") != "Run time")


lib.run(script)
