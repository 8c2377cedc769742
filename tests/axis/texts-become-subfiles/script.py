#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
from pathlib import Path

import operator_lib
import room


def script(op):
    app, out = op.app, open("transcript", "w", buffering=1)
    page = app.text_page
    tabs = page.tabs
    names = [str(n) for n in app.root.tk.splitlist(app.root.tk.call(".pane.top.right", "pages"))]
    print([n for n in names if n.startswith("ngcgui")], op.messages(), page.status.cget("text"), file=out)
    app.root.tk.call(".pane.top.right", "raise", "ngcguittt")
    op.wait(0.2)
    print("cut off:", [t for t in room.troubles(op.root) if str(page.frame) in t], file=out)

    def make(**values):
        for key, value in {"name": "", "scale": "1", "more": ""}.items():
            page.values[key].set(values.get(key, value))
        for key in ("text", "font"):
            if key in values:
                page.values[key].set(values[key])
        page.button.invoke()
        op.until(lambda: page.tracing is None, "the program's end")
        print(page.status.cget("text"), "|", page.status.cget("style"), str(page.button.cget("state")), file=out)

    make(text="")
    make(text="a", scale="-1")
    make(text="a", font="/none.ttf")
    make(text="fail", font="")
    make(text="nothing")
    make(text="a", more="'")
    make(text="mine")
    page.program = "no-such-tracer"
    make(text="a b")
    page.program = "tracer"
    print(len(tabs.pages), file=out)
    make(text="a b", scale="2.5", more="-x 'y z'")
    made = tabs.pages[-1]
    print([(r[0].name, r[0].label, r[2].get()) for r in made.rows], made.form.info, "preamble:",
          Path(made.o.preamble).name, file=out)
    make(text="a b", scale="3", name="TTT a-b.ngc")      # its own file
    print(len(tabs.pages), made.form.info, file=out)
    op.power_on()
    op.home()
    made.rows[1][2].set("-2")
    made.create()
    made.finalize()
    op.until(lambda: app.loaded_file.endswith("auto.ngc") and not app.loading, "the program is opened")
    op.wait(0.3)
    op.key("r")
    op.wait(0.5)
    op.idle()
    print([op.position(i) for i in range(3)], op.messages(), file=out)


operator_lib.run(script)
