#!/usr/bin/python3
# What the settings of the INI file make of the screen.
import os
import struct
import sys

import operator_lib as lib
from axis import dialogs
from axis.program import properties


def words(value):
    return [str(v) for v in value]


def labels(op, menu):
    tcl = op.root.tk
    return [str(tcl.call(menu, "entrycget", i, "-label")) for i in range(1, int(tcl.call(menu, "index", "end")) + 1)]


def foam(op):
    """The planes of the program, of the cutters and of the live plot: heights in inches, of the plot in mm."""
    p = op.app.preview
    p.scene.live.clear()
    p.add_tool()
    points, count, in_planes = p.logger.points()
    last = struct.unpack("3f4B3f4B", points[-32:])
    xy, uv = (item.vertices[:, 2] for item in p.scene.live)
    print("extents Z:", p.extents() and [round(corner[2], 4) for corner in p.extents()],
          "tips of the cutters:", round(float(xy.max()), 4), round(float(uv.min()), 4), "plot:", in_planes,
          round(last[2], 4), round(last[9], 4), "of the properties:",
          [value for name, value in properties(op.app.loaded_file, None, p.program, op.app.settings, True) if "Z" in name])


def common(op):
    app, v, tcl = op.app, op.app.vars, op.root.tk
    print("cycle ms:", app.settings.cycle_ms, "opened:", app.loaded_file and os.path.basename(app.loaded_file),
          "recent:", app.prefs.recent(), "lines:", app.code.total, "moves:",
          app.preview.program and app.preview.program.n_moves, "in title:", op.root.title().split(" AXIS ")[0])
    print("units:", v.metric.get(), "relative:", v.coord_type.get(), "commanded:", v.display_type.get(), "view:",
          v.view_type.get())
    print("sliders to:", *[tcl.call(f".pane.top.{w}.foscale", "cget", "-to")
                           for w in ("feedoverride", "rapidoverride", "spinoverride")])
    print("jog speed:", v.jog_speed.get(), "of", v.max_speed.get() * 60, "angular:", v.jog_aspeed.get(), "of",
          v.max_aspeed.get() * 60, "max velocity:", v.maxvel_speed.get())
    slow = []
    for name in ("jog", "ajog"):
        before = getattr(v, f"{name}_slider_val").get()
        app.slider(name, 0.06)
        slow.append(getattr(v, "jog_speed" if name == "jog" else "jog_aspeed").get())
        app.slider(name, before)
    print("slowest:", slow)
    print("increments:", words(tcl.splitlist(tcl.call(".pane.top.tabs.fmanual.jogf.jog.jogincr", "cget", "-values"))))
    distances = []
    for text in tcl.splitlist(tcl.call(".pane.top.tabs.fmanual.jogf.jog.jogincr", "cget", "-values")):
        v.jogincrement.set(text)
        distances.append(round(app.jogger.distance(), 6))
    v.jogincrement.set("Continuous")
    print("distances:", distances, "grids:", labels(op, ".menu.view.grid"))
    print("jog order:", "".join(app.settings.jog_order()), "inverted:", app.jog_invert or "-", "queue:",
          v.max_queued_mdi_commands.get(), "editor:", v.has_editor.get(), "cone:", app.options.cone_size,
          app.options.cone_scaling, app.options.min_tool_diameter)
    print("file types:", [(name, list(patterns)) for name, patterns in app.loader.file_types()])
    p = app.preview
    print("drawn:", len(p.drawings), "box only:", p.boxed)
    if app.settings.foam:
        foam(op)
    print("start of the preview:", app.loader.init_codes(op.stat))
    for text in op.messages():
        print("told:", text)
    print("readout:", [line for line in app.preview.readout_lines if ":" in line][:4])


def everything(op):
    """What only the edited mill does."""
    app, tcl = op.app, op.root.tk
    asked = []
    dialogs.ask = lambda root, title, text, icon, default, *buttons, **more: asked.append((title, *buttons)) or 1
    op.power_on()
    print("homing prompt:", asked, "homing:", any(j["homing"] for j in op.stat.joint))
    op.home()
    app.spindle(-1)
    op.wait(0.2)
    print("spindle:", op.stat.spindle[0]["speed"])
    tcl.call("edit_tooltable")
    tcl.call("edit_program")
    app.open_file_guts(os.path.abspath("spaced name.spiral"))
    op.wait(0.1)
    print("filtered:", app.line_text(1), "|", app.line_text(2))
    op.answer_touchoff("7")
    app.activate_ja_widget("y")
    op.key("End")
    op.idle()
    print("touch off actual:", round(op.stat.g5x_offset[1], 4), op.messages()[-1:])
    op.root.tk.call("send_mdi_command", "G0 X1")
    app.vars.mdi_command.set("G0 X2")
    op.root.tk.call("send_mdi")
    op.wait(0.2)
    with open("history.txt") as f:
        print("history:", f.read().split("\n"))
    op.idle()
    op.until(lambda: app.logger.points()[1] > 1, "plotted points")
    print("X resources: plot of what stands:", struct.unpack("3f4B3f4B", app.logger.points()[0][-32:])[3:7],
          "selected line:", app.preview.colours["selected"])
    print("tkapp:", tcl.getvar("from_app"))
    for _ in range(300):
        if os.path.exists("edited"):
            break
        op.wait(0.02)
    with open("edited") as f:
        print("edited:", sorted(os.path.basename(line.strip()) for line in f))


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    common(op)
    if os.environ.get("EVERYTHING"):
        everything(op)


lib.run(script)
