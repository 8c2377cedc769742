#!/usr/bin/python3
# One start of the screen with a user's file: what it changed works, by real keys.
import os
import subprocess
import sys

import hal
import linuxcnc
import operator_lib as lib


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl, user = op.app, op.root.tk, op.app.user
    x = lambda *words: subprocess.run(["xdotool", *words], check=True)      # noqa: E731

    def keys(*names):
        for name in names:
            x("key", name)
            op.wait(0.2)

    def held(*names, seconds=0.4):
        """Velocities of the joints while keys are held, and after."""
        for name in names:
            x("keydown", name)
        op.wait(seconds)
        moving = [round(op.stat.joint[j]["velocity"], 1) for j in range(3)]
        for name in reversed(names):
            x("keyup", name)
        op.wait(0.2)
        return moving, "rests" if not any(op.stat.joint[j]["velocity"] for j in range(3)) else "goes on"
    op.root.focus_force()
    keys("F1", "F2")
    checks[int(os.environ["NUMBER"])](op, app, tcl, user, keys, held)
    print("messages:", op.messages())


def home(op):
    op.home()


def increments(op, app, tcl, user, keys, held):
    pin = lambda: round(hal.get_value("axisui.jog.increment"), 4)           # noqa: E731
    print("of the file:", pin(), end=" ")
    keys("Right")
    op.wait(0.5)
    print("step:", op.position(0), end=" ")
    tcl.call(".steps.s5", "invoke")
    print("of a button:", pin(), end=" ")
    keys("F6")
    print("of a key:", pin(), end=" ")
    keys("i")
    print("next in the new list:", app.vars.jogincrement.get(), end=" ")
    keys("c")
    print("jog speed:", held("Up"), end=" ")
    user["faster"]()
    print("by the slider's variable:", app.vars.jog_speed.get(), held("Up"))
    before = op.stat.max_velocity
    user["slower"]()
    op.wait(0.3)
    print("max velocity by its variable, mm/min:", app.vars.maxvel_speed.get(),
          round(op.stat.max_velocity * 60), "was:", round(before * 60), end=" ")
    keys("apostrophe")
    print("a key more:", app.vars.maxvel_speed.get(), round(op.stat.max_velocity * 60), end=" ")
    app.command.maxvel(20)
    op.wait(3)
    print("of another client:", app.vars.maxvel_speed.get(), round(op.stat.max_velocity * 60))


def pages(op, app, tcl, user, keys, held):
    home(op)
    raised = lambda: str(tcl.call(".pane.top.right", "raise"))              # noqa: E731
    keys("F4", "F4")
    print("page:", raised(), "seen:", tcl.call("winfo", "viewable", ".hours"), end=" ")
    keys("F4")
    print("page:", raised(), "told:", user["raised"], "grid:", round(app.vars.grid_size.get() * 25.4, 2), "feed:",
          app.vars.feedrate.get(), "remote:", repr(user["answer"]), end=" ")
    tcl.call(".go", "invoke")
    op.idle()
    print("Z:", op.position(2))
    app.command.mode(linuxcnc.MODE_MANUAL)
    tcl.call(".pane.top.tabs", "raise", "probe")
    print("jog beside the Manual tab:", held("Right"), end=" ")
    keys("F3")
    print("tab:", app.raised_tab())


def taken_away(op, app, tcl, user, keys, held):
    keys("F6")
    op.until(app.all_homed, "homing by the own key")
    op.wait(0.2)
    keys("KP_Subtract", "KP_Subtract", "5", "r", "t", "b", "F7")
    print("feed:", app.vars.feedrate.get(), "idle:", op.stat.interp_state == linuxcnc.INTERP_IDLE, "mist:",
          bool(op.stat.mist), "brake:", op.stat.spindle[0]["brake"], "Up:", held("Up"), "Right:", held("Right"))
    print("seen:", [name for name in dict.fromkeys(user["pressed"]) if name in ("KP_Subtract", "r", "-r", "Right", "-Right")], end=" ")
    keys("alt+r")
    op.wait(0.3)
    running = op.stat.interp_state != linuxcnc.INTERP_IDLE
    keys("space")
    op.idle()
    print("Alt-r runs:", running, "space stops")


def replaced(op, app, tcl, user, keys, held):
    home(op)
    print("Z:", held("Next"), user["jogs"], "fast X:", held("shift", "Right"), end=" ")
    app.vars.jogincrement.set("1mm")
    before = op.position(0)
    keys("Right")
    op.wait(0.5)
    print("step:", round(op.position(0) - before, 4), end=" ")
    keys("c")
    user["door_closed"] = False
    print("door open:", held("Right"), "door" in user["refused"])
    user["door_closed"] = True
    user["jog_on"], kept = lambda a, b: app.command.jog(linuxcnc.JOG_CONTINUOUS, False, a, b), user["jog_on"]
    user["jog_off"], off = lambda a: 1 / 0, user["jog_off"]
    print("own jog, jog_off fails:", held("Up"), end=" ")
    print("told:", [t.strip().splitlines()[-1] for t in op.trouble])
    op.trouble.clear()
    user["jog_on"], user["jog_off"] = kept, off
    user["set_feedrate"] = lambda n, own=user["set_feedrate"]: own(min(n, 80))
    app.command.feedrate(0.8)
    op.wait(0.2)
    keys("9")
    print("replaced late: feed", app.vars.feedrate.get(), end=" ")
    user["jog_invert"] = "X"
    print("turned round:", held("Right"), end=" ")
    open("secret.ngc", "w").write("M2\n")
    before = app.loaded_file
    print("remote:", tcl.call("remote", "open_file_name", os.path.abspath("secret.ngc")), app.loaded_file == before)
    app.notifications.clear()
    op.answer_touchoff("2")
    keys("x", "End")
    op.wait(0.5)
    print("X:", round(op.stat.actual_position[0] - op.stat.g5x_offset[0], 4))


def little(op, app, tcl, user, keys, held):
    home(op)
    keys("F5", "ctrl+Tab", "F3", "F4", "F4", "exclam", "exclam", "d", "v", "x", "F9", "F9", "ctrl+k", "ctrl+r", "alt+h")
    app.set_dark(True)
    app.set_dark(False)
    tcl.call("reload_file")
    keys("r")
    op.wait(0.3)
    running = op.stat.interp_state != linuxcnc.INTERP_IDLE
    op.idle()
    op.wait(0.3)
    print("runs:", running, "Y jogs:", held("Up"), "seen:",
          [w for w in (".toolbar.view_z", ".toolbar.rotate", ".pane.top.spinoverride", ".pane.bottom", ".info.position",
                       ".pane.top.tabs.fmanual.spindlef", ".keys") if int(tcl.call("winfo", "ismapped", w))])


def places(op, app, tcl, user, keys, held):
    home(op)
    keys("r")
    print(str(tcl.call("wm", "geometry", "."))[:8], tcl.eval("wm minsize ."), "lines:",
          tcl.call(".pane.bottom.t.text", "cget", "-height"), "sash:", tcl.eval(".pane sash coord 0").split()[1],
          "asked:", user["asked"], "idle:", op.stat.interp_state == linuxcnc.INTERP_IDLE)


checks = {1: increments, 2: pages, 3: taken_away, 4: replaced, 5: little, 6: places}
lib.run(script)
