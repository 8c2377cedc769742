#!/usr/bin/python3
import sys

import operator_lib as lib


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, p = op.app, op.app.preview
    op.power_on()
    p.set_view("z")
    op.wait(0.3)
    print(p.picture.kind, "moves:", app.preview.program.n_moves)
    w, h = p.winfo_width(), p.winfo_height()
    x, y = p.camera.pixel((20 / 25.4, 0.0, 0.0), w, h)
    p.picture.event_generate("<Button-1>", x=round(x), y=round(y))
    p.picture.event_generate("<ButtonRelease-1>", x=round(x), y=round(y))
    op.wait(0.1)
    print("clicked in the picture: line", app.vars.highlight_line.get(), "| vertices of the line:",
          p.scene.selected_spans)
    before = p.camera.size
    p.picture.event_generate("<Button-4>", x=10, y=10)
    op.wait(0.1)
    print("wheel: closer:", p.camera.size < before, "view:", app.vars.view_type.get())
    p.picture.event_generate("<Button-2>", x=100, y=100)
    p.picture.event_generate("<B2-Motion>", x=140, y=120, state=0x200)
    p.picture.event_generate("<ButtonRelease-2>", x=140, y=120, state=0x200)
    op.wait(0.1)
    print("turned: view:", app.vars.view_type.get(), (p.camera.lat, p.camera.lon))
    for name in ("x", "y", "z2", "p"):
        op.root.tk.call("set_view_" + name)
        op.wait(0.05)
    called = []
    p.user_plot = lambda: called.append(1) or 1 / 0
    op.root.tk.call("redraw")
    op.wait(0.1)
    print("user_plot called:", bool(called))
    app.vars.highlight_line.set(-1)
    op.root.geometry("900x600")
    op.wait(0.3)
    print("resized:", p.winfo_width() != w)


lib.run(script)
