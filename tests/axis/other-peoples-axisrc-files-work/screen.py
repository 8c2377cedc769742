#!/usr/bin/python3
# Runs the files as ~/.axisrc, one after the other on one screen (the first by the screen
# itself), and looks at what they did.
import glob
import os
import sys

import hal
import linuxcnc
import operator_lib as lib
from axis import dialogs


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl = op.app, op.root.tk
    told = []
    dialogs.ask = lambda root, title, text, icon, default, *buttons, extra=None, **more: told.append(f"{title}: {extra.splitlines()[-1]}") or 0
    op.power_on()
    op.home()
    print("00 pins:", sorted(p["NAME"].split(".")[1]
                             for p in hal.get_info_pins() if p["NAME"].startswith("axisui.") and "jog" not in p["NAME"]
                             and "notif" not in p["NAME"]))
    app.command.mode(linuxcnc.MODE_AUTO)
    app.command.auto(linuxcnc.AUTO_RUN, 0)
    op.wait(0.5)
    print("light while it runs:", hal.get_value("axisui.light"), end=" ")
    op.idle()
    op.wait(0.3)
    print("after:", hal.get_value("axisui.light"), "parts:", hal.get_value("axisui.parts"))
    own = app.settings.find

    for path in sorted(glob.glob(os.path.join(os.environ["FILES"], "[01]*.py")))[1:]:
        app.settings.find = (lambda section, name, default=None, p=path: p if name == "USER_COMMAND_FILE"
                             else own(section, name, default))
        app.run_user_file()
        app.fill_windows()
        op.wait(0.2)
        print(os.path.basename(path), "told:", told, end=" ")
        told.clear()
        looks[os.path.basename(path)[:2]](op, app, tcl)
        for text in op.trouble:
            print("TRACEBACK", text)
        op.trouble.clear()


def fonts(op, app, tcl):
    print(str(tcl.call(".pane.top.right", "raise")), tcl.call(".pane.bottom.t.text", "cget", "-height"),
          app.widgets.homebutton.cget("text"))


def keys(op, app, tcl):
    app.command.mode(linuxcnc.MODE_MDI)
    app.command.mdi("G0 X3 Y4")
    op.idle()
    app.command.mode(linuxcnc.MODE_MANUAL)
    op.key("F6")
    op.idle()
    at = [op.position(i) for i in (0, 1)]
    op.key("F6", state=1)
    print(at, "view:", app.vars.view_type.get(), "in the help:",
          sum("F6" in str(w.cget("text")) for w in app.widgets.help_window.winfo_children()))


def hidden(op, app, tcl):
    names = (".pane.top.tabs.fmanual.flood", ".pane.top.tabs.fmanual.axes.axisz", ".pane.top.rapidoverride",
             ".toolbar.view_p")
    print([str(tcl.call("winfo", "manager", n)) for n in names],
          str(tcl.call(".pane.top.tabs", "itemcget", "mdi", "-text")))


def live(op, app, tcl):
    app.spindle(0)
    app.command.spindle(linuxcnc.SPINDLE_FORWARD, 500)
    op.wait(0.3)
    print(str(tcl.call(".lamp", "cget", "-text")), [m for m in op.messages() if "spindle" in m], "file:",
          os.path.basename(app.user["loaded_file"]), "tool:", app.user["current_tool"])
    app.spindle(0)


def menu(op, app, tcl):
    tcl.call(".macros", "invoke", 0)
    op.idle()
    print([op.position(i) for i in (0, 1)], str(tcl.call(".menu.file", "entrycget", 2, "-label")))


def defaults(op, app, tcl):
    v = app.vars
    print(v.show_machine_limits.get(), v.metric.get(), v.coord_type.get(), v.view_type.get(),
          round(op.stat.feedrate, 2), round(op.stat.rapidrate, 2),
          op.stat.optional_stop, v.touch_off_system.get(), v.jogincrement.get(), v.grid_size.get(),
          app.logger.get_colors()[0], app.user["own"])
    v.metric.set(1)
    tcl.call("redraw")
    app.continuous()


def touchoff(op, app, tcl):
    op.answer_touchoff("3 * 2")
    tcl.call(str(app.widgets.homebutton.master) + ".plate", "invoke")
    op.idle()
    print("Z offset:", round(op.stat.actual_position[2] - op.stat.g5x_offset[2], 4))


def tcl_page(op, app, tcl):
    op.key("F6")
    print(str(tcl.call(".pane.top.right.fnotes.t", "get", "1.0", "end")).split(), app.user["units"],
          str(tcl.call(".pane.top.right", "raise")))


def pad(op, app, tcl):
    op.key("F3")
    print("selected:", app.vars.ja_rbutton.get(), end=" ")
    button = op.root.nametowidget(str(app.widgets.axes.master) + ".pad.x+")
    button.event_generate("<ButtonPress-1>")
    op.wait(0.3)
    fast = round(op.stat.axis[0]["velocity"], 3)
    button.event_generate("<ButtonRelease-1>")
    op.wait(0.5)
    print("jogs at", fast, "stands:", op.stat.axis[0]["velocity"] == 0, "owners:", dict(app.jogger.running), end=" ")
    op.hold("Right")
    op.wait(0.2)
    print("Right is Y, turned round:", op.stat.axis[1]["velocity"] < 0)
    op.let_go("Right")


def mistake(op, app, tcl):
    print([m for m in op.messages() if "mistake" in m])


looks = {"01": fonts, "02": keys, "03": hidden, "04": live, "05": menu, "06": defaults, "07": touchoff, "08": tcl_page,
         "09": pad, "10": mistake}
lib.run(script)
