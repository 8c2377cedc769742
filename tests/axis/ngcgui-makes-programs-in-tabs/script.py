#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import sys
import tkinter.font
from pathlib import Path
from tkinter import ttk

import operator_lib
from kerf.tktools import ngcgui_tabs
import room

made = []
start = ngcgui_tabs.Tabs.__init__


def keep(self, app, subfiles):
    made.append(self)
    start(self, app, subfiles)


ngcgui_tabs.Tabs.__init__ = keep
def below(widget):
    """The widgets in this one."""
    for child in widget.winfo_children():
        yield child
        yield from below(child)


def font_of(app, widget):
    """The font of a widget with letters, or None."""
    if isinstance(widget, (ttk.Button, ttk.Checkbutton)):
        return ttk.Style(app.root).lookup(widget.cget("style") or widget.winfo_class(), "font")
    return widget.cget("font") if "font" in widget.keys() else None


def script(op):
    app, out = op.app, open("transcript", "w", buffering=1)
    sys.stdout = out
    tabs = made[0]
    print(op.messages(), file=out)
    names = app.root.tk.splitlist(app.root.tk.call(".pane.top.right", "pages"))
    print([str(n) for n in names if str(n).startswith("ngcgui")],
          [str(app.root.tk.call(".pane.top.right", "itemcget", n, "-text")) for n in names], file=out)
    line, hop, custom = tabs.pages
    print([(r[0].name, r[2].get()) for r in line.rows], custom.status.cget("text"), file=out)
    fonts = {tkinter.font.Font(app.root, font=str(font_of(app, widget))).actual("family")
             for widget in below(line.frame) if font_of(app, widget)}
    print("fonts:", fonts, "elsewhere:", tkinter.font.nametofont("TkDefaultFont", app.root).actual("family"), file=out)
    print("buttons:", [text for text in line.buttons if not text[0].isupper()], "autosend:", line.autosend.get(),
          "post:", Path(line.o.postamble).parent.name, file=out)
    op.power_on()
    op.home()
    app.root.tk.call(".pane.top.right", "raise", "ngcgui1")
    op.wait(0.2)
    line.buttons["Create Feature"].invoke()
    line.rows[0][2].set("25")
    line.buttons["Create Next"].invoke() if "Create Next" in line.buttons else line.create()
    hop.create()
    line.buttons["MakeFile"].invoke()
    op.wait(0.2)
    print("not sent by itself:", Path(app.loaded_file).name, file=out)
    line.buttons["SendFileToAxis"].invoke()
    op.until(lambda: app.loaded_file.endswith("auto.ngc") and not app.loading, "the program is opened")
    op.wait(0.3)
    print("frame:", Path(app.loaded_file).read_text().split("\n")[:2],
          Path(app.loaded_file).read_text().split("\n")[-5:], file=out)
    print(Path(app.loaded_file).name, hop.program.features, file=out)
    text = Path(app.loaded_file).read_text()
    print([l for l in text.splitlines() if "call" in l or "features" in l], file=out)
    op.key("r")
    op.wait(0.5)
    op.idle()
    print([op.position(i) for i in range(3)], file=out)
    app.root.tk.call(".pane.top.right", "raise", "ngcgui1")
    op.wait(0.2)
    entry, text = line.rows[0][1:]
    entry.focus_force()
    values = []
    for key in ("Control-c", "Control-d", "Control-f", "x", "Escape"):
        app.root.update()
        entry.event_generate(f"<{key}>")
        app.root.update()
        values.append(text.get())
    print("keys:", values, line.program.features[0][0], app.root.tk.call(".pane.top.right", "raise"), file=out)
    line.restart()
    tabs.words.append("noremove")
    print("a new one:", [text for text in tabs.add("line.ngc").buttons if not text[0].isupper()], file=out)
    op.wait(0.2)
    print([p.name for p in tabs.pages], "cut off:", [t for t in room.troubles(op.root) if str(line.frame) in t],
          file=out)
    tabs.pages[3].buttons["\N{LEFTWARDS ARROW} move"].invoke()
    line.buttons["remove"].invoke()
    op.wait(0.2)
    print([p.name for p in tabs.pages],
          [str(n) for n in app.root.tk.splitlist(app.root.tk.call(".pane.top.right", "pages")) if "ngcgui" in str(n)],
          file=out)
    out.flush()


operator_lib.run(script)
