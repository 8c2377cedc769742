#!/usr/bin/python3
# Powers on, homes, touches off, runs, pauses, steps, aborts, overrides, MDI, all by keys and buttons.
import sys
import linuxcnc
import operator_lib as lib


def script(op):
    app, stat = op.app, lambda: op.stat
    out = open("transcript", "w", buffering=1)
    sys.stdout = out
    tabs = ".pane.top.tabs.fmanual"
    print("title:", app.root.title().split(" - ")[0])
    print("at start:", app.vars.task_state_string.get(), "run possible:", op.enabled(".toolbar.program_run"))
    op.power_on()
    print("on:", app.vars.task_state_string.get(), "touch off possible:", op.enabled(f"{tabs}.jogf.zerohome.zero"))
    op.home()
    print("homed:", list(stat().homed[:3]), "teleop or free:", stat().motion_mode in (1, 3))

    op.hold("Right")
    op.wait(0.5)
    moving = stat().joint[0]["velocity"] > 0
    op.let_go("Right")
    op.wait(1.0)
    print("jog by key: moves", moving, "stops", stat().joint[0]["velocity"] == 0, "went right", op.position(0) > 0)
    app.vars.jogincrement.set("1mm")
    before = op.position(0)
    op.hold("minus"); op.let_go("minus"); op.wait(1.0)
    print("increment:", round(op.position(0) - before, 3))
    app.vars.jogincrement.set("Continuous")
    op.hold("Up")
    op.wait(0.2)
    app.root.event_generate("<FocusOut>")
    op.wait(1.0)
    at = op.position(1)
    op.wait(0.5)
    print("focus lost: stopped", at == op.position(1), "owners", list(app.jogger.running))
    op.let_go("Up")

    op.answer_touchoff("[2+3]*2", "P2")
    app.activate_ja_widget("x")
    op.key("End")
    op.wait(0.5)
    print("touch off:", app.vars.touch_off_system.get(), "x of G55 is now",
          round(stat().actual_position[0] - g55_of_x(op), 3))
    for text in "120,5", "1.234,5":      # FP-175: a decimal comma, and what might be either
        op.answer_touchoff(text, "P2")
        op.key("End")
        op.wait(0.5)
        print("touch off:", text, "x of G55 is now", round(stat().actual_position[0] - g55_of_x(op), 3))
    op.answer(1)
    op.key("F5")
    op.type("G54 G0 X5 Y5 Z100")
    op.idle()
    print("MDI:", op.position(0), op.position(1), "history", app.widgets.mdi_history.get(0))
    op.key("F3")

    op.key("r")
    op.until(lambda: stat().motion_line > 5, "program runs")
    print("running: open possible", op.enabled(".toolbar.file_open"), "pause possible",
          op.enabled(".toolbar.program_pause"))
    op.key("p")
    op.until(lambda: stat().paused, "pause")
    op.key("5")
    op.wait(0.2)
    print("paused, feed override", app.vars.feedrate.get(), round(stat().feedrate, 2))
    op.key("0")
    op.key("s")
    op.until(lambda: not stat().paused, "resume")
    op.key("Escape")
    op.until(lambda: stat().interp_state == linuxcnc.INTERP_IDLE, "abort")
    op.wait(1.0)
    print("aborted: mode manual", stat().task_mode == linuxcnc.MODE_MANUAL, "spindle", stat().spindle[0]["direction"],
          "line kept", app.vars.highlight_line.get() > 5)
    op.key("t")
    op.wait(1.0)
    print("step: mode auto", stat().task_mode == linuxcnc.MODE_AUTO)
    op.key("Escape")
    op.wait(0.5)
    op.key("r")
    op.idle()
    op.wait(0.5)
    print("program done, messages:", [m for m in op.messages() if not m.startswith("Touch off: ")])
    op.key("F1")
    op.until(lambda: stat().task_state == linuxcnc.STATE_ESTOP, "estop")
    print("estop:", app.vars.task_state_string.get(), "run possible:", op.enabled(".toolbar.program_run"))


def g55_of_x(op):
    """Offset of X of the second system, seen by selecting it."""
    command = op.app.command
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    for line in ("G55", "G54"):
        command.mdi(line)
        command.wait_complete()
        op.wait(0.1)
        if line == "G55":
            value = op.stat.g5x_offset[0]
    return value


lib.run(script)
