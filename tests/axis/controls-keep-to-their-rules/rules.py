#!/usr/bin/python3
import glob
import os
import sys

import linuxcnc
import operator_lib as lib

MANUAL = ".pane.top.tabs.fmanual"


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl = op.app, op.root.tk
    print("user's faulty update:", [m for m in op.messages() if "no such sensor" in m][:1] != [], "told",
          len([m for m in op.messages() if "sensor" in m]), "time")
    buttons_off(op)
    op.power_on()
    op.home()
    print("without its entries the menu still follows: run", op.enabled(".toolbar.program_run"), "Touch Off",
          op.enabled(f"{MANUAL}.jogf.zerohome.zero"))
    op.app.notifications.clear()
    steps(op)
    options(op)
    expressions(op)
    programs(op)
    history(op)
    combobox(op)
    faults(op)
    sliders(op)


def mouse(op, path, *events):
    for event in events:
        op.root.tk.call("event", "generate", path, event, "-x", 3, "-y", 3)
    op.wait(0.1)


def buttons_off(op):
    """Clicks on buttons that are disabled."""
    serial = op.stat.echo_serial_number
    for w in ("jogf.jog.jogminus", "jogf.jog.jogplus", "spindlef.spindleminus", "spindlef.spindleplus"):
        mouse(op, f"{MANUAL}.{w}", "<Enter>", "<Button-1>", "<ButtonRelease-1>", "<Leave>")
    print("disabled buttons send:", op.stat.echo_serial_number - serial, op.messages()[1:])


def steps(op):
    app, plus = op.app, f"{MANUAL}.jogf.jog.jogplus"
    app.activate_ja_widget("x")
    app.vars.jogincrement.set("1mm")
    app.increment_chosen()
    mouse(op, plus, "<Enter>", "<Button-1>")
    op.wait(0.5)
    pressed = op.position(0)
    mouse(op, plus, "<Leave>", "<ButtonRelease-1>")
    op.wait(0.5)
    left = op.position(0)
    mouse(op, plus, "<Enter>", "<Button-1>", "<ButtonRelease-1>")
    op.wait(0.5)
    clicked = op.position(0)
    mouse(op, plus, "<Button-1>", "<ButtonRelease-1>", "<Button-1>", "<ButtonRelease-1>", "<Button-1>",
          "<ButtonRelease-1>", "<Leave>")
    op.wait(1.0)
    print("step of 1 mm: pressed", pressed, "left", left, "clicked", clicked, "three times at once: whole steps",
          op.position(0) in (3.0, 4.0, 5.0), op.position(0))
    app.continuous()
    mouse(op, plus, "<Enter>", "<Button-1>")
    op.wait(0.2)
    moves = op.stat.joint[0]["velocity"] > 0
    mouse(op, plus, "<ButtonRelease-1>", "<Leave>")
    op.wait(1.0)
    print("continuous: pressed, moves:", moves, "let go, rests:", op.stat.joint[0]["velocity"] == 0)


def options(op):
    """Somebody else (halui, a panel) switches block delete and the optional stop."""
    app = op.app
    other, moves = linuxcnc.command(), app.preview.program.n_moves
    before = app.vars.block_delete.get(), app.vars.optional_stop.get()
    other.set_block_delete(0)
    other.set_optional_stop(0)
    op.until(lambda: not app.vars.block_delete.get() and not app.vars.optional_stop.get(), "options follow")
    print("options:", before, "by another program:", (app.vars.block_delete.get(), app.vars.optional_stop.get()),
          "preference stays:", app.prefs.getpref("block_delete"), "shown pressed:",
          op.root.tk.call(".toolbar.program_blockdelete", "cget", "-relief"), end=" ")
    op.until(lambda: app.preview.program.n_moves != moves and not app.loading, "the preview follows")
    print("moves shown:", moves, "then", app.preview.program.n_moves)
    op.click(".toolbar.program_blockdelete")
    op.click(".toolbar.program_optpause")
    op.wait(1.0)
    print("clicked: screen", (app.vars.block_delete.get(), app.vars.optional_stop.get()), "machine",
          (int(op.stat.block_delete), int(op.stat.optional_stop)),
          "preference", app.prefs.getpref("block_delete"), "moves:", app.preview.program.n_moves)


def expressions(op):
    app = op.app
    app.activate_ja_widget("y")
    op.answer_touchoff("[1+2]*2")
    op.key("End")
    op.idle()
    print("actual and an expression:", round(op.stat.g5x_offset[1], 4), op.messages()[-1:])
    op.key("F5")
    op.type("G10 L2 P1 Y0")
    op.idle()
    op.type("#5220=2 #31=7")
    op.type("G10 L2 P2 X12.5")
    op.idle()
    op.type("G54")
    op.idle()
    op.key("F3")
    app.activate_ja_widget("x")
    op.answer_touchoff("#5241*2")
    op.key("End")
    op.idle()
    print("a parameter in an expression: shown as it will be, X now",
          round(op.stat.actual_position[0] - op.stat.g5x_offset[0], 4))


def programs(op):
    """Editors that are not there, and a file that changes behind a touch off."""
    app = op.app
    app.notifications.clear()
    op.root.tk.call("edit_program")
    app.open_directory = "/"
    print("no editor:", op.messages(), "reports:", len(glob.glob(os.path.expanduser("~/.axis_reports/report-*"))))
    with open(app.loaded_file) as f:
        text = f.read()
    with open(app.loaded_file, "w") as f:
        f.write(text.replace("G1 Y7", "G1 Y70"))
    op.wait(0.5)
    op.key("Home", state=1)                 # touch off 0
    op.wait(0.5)
    print("changed on disk, then a touch off: text", app.line_text(8), end=" ")
    op.key("r", state=4)
    op.wait(0.3)
    print("reloaded:", app.line_text(8))
    op.root.tk.call("set_first_line", 4)
    print("lines before the start are grey:", [str(i) for i in app.text.tag_ranges("ignored")], end=" ")
    op.key("r", state=4)
    print("reloaded:", [str(i) for i in app.text.tag_ranges("ignored")])


def history(op):
    """The list of MDI lines: clicks, then keys of the entry."""
    app, tcl, box = op.app, op.root.tk, ".pane.top.tabs.fmdi.history"
    app.TclCommands.clear_mdi_history()
    op.key("F5")
    for text in ("G0 X1", "G0 X2", "G0 X2", "G0 X3"):
        op.type(text)
        op.idle()

    def click(row, first="<Button-1>", times=1):
        x, y, _, high = (int(v) for v in tcl.splitlist(tcl.call(box, "bbox", row)))
        for event in (first, "<ButtonRelease-1>") * times:
            tcl.call("event", "generate", box, event, "-x", x + 3, "-y", y + high // 2)
        op.wait(1.0 if times == 1 else 0.1)
        return app.vars.mdi_command.get()
    print("history:", tcl.splitlist(tcl.call(box, "get", 0, "end")), "clicked:", click(0), "two:",
          repr(click(1, "<Shift-Button-1>")), end=" ")
    op.key("h", app.root.focus_get(), 4)
    print("copied:", repr(op.root.clipboard_get()), "the empty line:", repr(click(3)), "again:", click(1), end=" ")
    op.key("Up", app.root.focus_get())
    print("Up:", app.vars.mdi_command.get(), "double:", repr(click(0, times=2)), end=" ")
    op.idle()
    print("at", op.position(0), tcl.splitlist(tcl.call(box, "get", 0, "end")))
    op.key("F3")


def combobox(op):
    """The list of increments gives the keyboard back."""
    box = f"{MANUAL}.jogf.jog.jogincr"
    op.root.focus_force()
    op.wait(0.1)
    mouse(op, box, "<Button-1>", "<ButtonRelease-1>")
    op.wait(0.2)
    open_ = op.root.tk.call("winfo", "ismapped", f"{box}.popdown")
    op.root.tk.call("ttk::combobox::Unpost", box)
    op.wait(0.3)
    print("increments: list open", open_, "closed again, focus:", op.root.tk.call("focus"))


def faults(op):
    """The screen's own faults do not end its updates; no division by an override of 0."""
    app = op.app
    app.notifications.clear()
    real, looks = app.show_readout, []

    def fails():
        looks.append(1)
        raise ZeroDivisionError("on purpose")
    app.show_readout = fails
    while len(looks) < 3:
        op.root.update()
    app.show_readout = real
    print("a fault in the update cycle: told", [m.split("\n")[0] for m in app.notifications.shown and op.messages()],
          "updates go on:", len(looks) >= 3)
    app.set_override("feedrate", 0)
    op.wait(0.2)
    op.key("r", state=4)
    app.estimate.wait()
    app.set_override("feedrate", 100)
    op.key("r")
    op.idle()
    print("opened at an override of 0, run at 100 %:", op.position(1))


def sliders(op):
    app, tcl = op.app, op.root.tk
    for name in ("jogspeed", "ajogspeed", "maxvel"):
        print(name, *[tcl.call(f".pane.top.{name}.s", "cget", f"-{o}") for o in ("from", "to", "resolution")], end=" ")
    print()
    for x in (0.06, 0.2, 0.5, 0.98, 1.0):
        app.vars.jog_slider_val.set(x)
        app.slider("jog", x)
        print("jog slider at", x, "is", app.vars.jog_speed.get(), end="; ")
    print()


lib.run(script)
