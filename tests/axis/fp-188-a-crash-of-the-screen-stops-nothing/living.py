#!/usr/bin/python3
# The first screen starts a program and is killed; the second one looks, and is ended by a fault of a library; the
# third one sees the end.
import ctypes
import os
import signal

import hal
import hal.query
import linuxcnc
import operator_lib as lib
from kerf.session_processes import lives

PINS = ("pyvcp.held", "pyvcp.checked", "pyvcp.level-f", "pyvcp.wheel", "pyvcp.lamp", "axisui.abort", "velocity.in",
        "motion.adaptive-feed")


def panel_widget(op, kind):
    return next(w for w in op.app.panel.inner.winfo_children()[0].winfo_children() if type(w).__name__ == kind)


def look(op, out):
    s, app = op.stat, op.app
    print("state", s.task_state == linuxcnc.STATE_ON, "mode", s.task_mode == linuxcnc.MODE_AUTO, "runs",
          s.interp_state != linuxcnc.INTERP_IDLE, "homed", s.homed[:3], "spindle", round(s.spindle[0]["speed"]),
          s.spindle[0]["direction"], "flood", s.flood, file=out)
    print("overrides", s.feedrate, s.rapidrate, s.spindle[0]["override"], "shown",
          [getattr(app.vars, n + "rate").get() for n in ("feed", "rapid", "spindle")],
          "options", s.optional_stop, s.block_delete, app.vars.optional_stop.get(),
          app.vars.block_delete.get(), file=out)
    print("links", [(hal.query.pin(p) or {}).get("signal") for p in PINS], file=out)
    print("values", [hal.get_value(p) for p in ("held", "checked", "level", "wheel", "lamp", "axisui.resume-inhibit")],
          file=out)
    print("units", app.vars.metric.get(), "selected", app.vars.ja_rbutton.get(), app.comp["jog.y"], "increment",
          app.vars.jogincrement.get(), file=out)
    print("program", os.path.basename(app.loaded_file), app.code.total, "lines, marked",
          app.vars.running_line.get() == s.motion_line > 0,
          "picture", app.limit_path.n_moves, file=out)


def script(op):
    app, former = op.app, op.app.former
    out = open("transcript", "a", buffering=1)
    print("== crashed before:", app.record.crash, file=out)
    if former is None:
        op.power_on()
        op.home()
        op.key("v")
        app.set_override("feedrate", 60)
        app.set_override("rapidrate", 50)
        app.set_override("spindlerate", 110)
        app.set_option("optional_stop", False)
        app.vars.metric.set(0)
        app.activate_ja_widget("y", True)
        app.vars.jogincrement.set("1mm")
        panel_widget(op, "Scale").set(0.75)
        panel_widget(op, "Jogwheel").turn(5)
        panel_widget(op, "Checkbutton").select()
        op.key("r")
        op.until(lambda: op.stat.current_vel > 0.01 and op.stat.motion_line == 5, "motion")
        op.wait(0.5)
        panel_widget(op, "Button").press(True)
        op.wait(0.1)
        panel_widget(op, "Button").press(False)
        op.wait(0.1)
        panel_widget(op, "Button").press(True)     # the screen dies with a finger on the button
        op.wait(0.1)
    else:
        op.until(lambda: not app.taking_up, "the program is shown again")
        op.wait(0.3)
        print([m.split("\nReport:")[0] for m in op.messages()], file=out)
    app.keep_record(True)
    with open("../others", "a+") as others:
        print(hal.query.comp("beside")["pid"], file=others)
        others.seek(0)
        print("components beside it:", len(set(others)), "in tabs:",
              [lives(pid) for pid in open("../tabs").read().split()], file=out)
    look(op, out)
    if former is None:
        os.kill(os.getpid(), signal.SIGKILL)
    if "SIGKILL" in app.record.crash:
        ctypes.string_at(0)
    print("velocity since the first screen:", round(hal.get_value("velocity.min"), 6),
          round(hal.get_value("velocity.max"), 6), file=out)
    op.key("Escape")
    op.wait(1)
    print("stopped:", op.stat.interp_state == linuxcnc.INTERP_IDLE, "spindle", op.stat.spindle[0]["speed"], file=out)


lib.run(script)
