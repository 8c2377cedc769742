#!/usr/bin/python3
# Keys that the X server sends (xdotool): jogs with modifiers, a lost focus, then keys in any order; seeded.
import os
import random
import subprocess
import sys

import linuxcnc
import operator_lib as lib
from axis import dialogs
import screen_agrees
from operator_checks import still_jogging, work
from tkinter import filedialog

SEED, STEPS = int(os.environ.get("SEED", "7")), int(os.environ.get("STEPS", "70"))
KEYS = ("F3 F4 F5 F7 F8 F9 F10 F11 b o r t p s Escape v d x y z i c 1 5 0 exclam at numbersign comma period semicolon "
        "Home End Return minus "
        "shift+Left ctrl+r ctrl+k ctrl+Home shift+Home ctrl+space ctrl+Tab alt+p space Tab Left Right Up Down Next "
        "KP_Left KP_8 r s t p").split()
HELD = "Left Right Up Down Next Prior minus equal KP_6 shift Shift_R".split()


def x(*words):
    subprocess.run(["xdotool", *words], check=True)


def fields(op):
    """Panels of users, made by Python or by Tcl: what is typed in a field is not for the machine; Escape and a
    button's keys are."""
    app, tcl, told = op.app, op.root.tk, []
    panel = lib.tk.Frame(op.root, name="panel")
    panel.grid(row=0, column=4, rowspan=6)
    kinds = "entry spinbox text ttk::entry ttk::spinbox ttk::combobox listbox button".split()
    fields = {f"Tcl {kind}": tcl.call(kind, f".panel.{kind.replace(':', '')}",
                                      *(("-width", 8, "-height", 2) if kind == "text" else ())) for kind in kinds}
    for kind in "Entry Spinbox Text".split():
        fields[f"tkinter {kind}"] = str(getattr(lib.tk, kind)(panel, width=8))
    tcl.call("pack", *fields.values())
    stop = app.TclCommands.task_stop
    tcl.createcommand("task_stop", lambda: told.append("stop"))
    for name, path in fields.items():
        app.set_override("feedrate", 100)
        op.wait(0.6)
        told.clear()
        tcl.call("focus", "-force", path)
        op.root.update()
        before = op.stat.actual_position
        x("type", "5rx-")
        x("key", "Left", "Escape")
        op.wait(0.5)
        print(f"typed in {name}: override", app.vars.feedrate.get(), "moves", op.stat.actual_position != before,
              "Escape", told)
        app.command.abort()
        op.wait(0.3)
    tcl.createcommand("task_stop", app.guarded(stop))
    panel.destroy()
    op.root.focus_force()
    op.key("F3")
    op.wait(0.2)


def slow_clicks(op):
    """The machine has done what a button says before the mouse is let go, above it or beside: the tool bar shows the
    machine."""
    def press(name):
        at = [str(int(op.root.tk.call("winfo", corner, f".toolbar.{name}")) + 8) for corner in ("rootx", "rooty")]
        x("mousemove", *at, "mousedown", "1")
        op.wait(0.4)

    def shown(what, *away):
        x(*away, "mouseup", "1")
        op.wait(0.4)
        print(f"{what}: state", op.stat.task_state, *screen_agrees.reliefs(op, op.stat))
    press("machine_estop")
    shown("stop, held")
    press("machine_estop")
    shown("reset, let go beside it", "mousemove", "300", "300")
    press("machine_power")
    shown("power")
    press("program_optpause")
    op.app.command.set_optional_stop(not op.stat.optional_stop)       # another client
    op.wait(0.4)
    shown("optional stop, let go beside it, another client was faster", "mousemove", "300", "300")
    press("machine_power")
    op.app.command.state(linuxcnc.STATE_ESTOP)
    op.wait(0.4)
    shown("power, while another client stops")
    x("mousemove", "300", "300")
    for key in ("F1", "F2"):
        x("key", key)
        op.wait(0.3)


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, root = op.app, op.root
    filedialog.askopenfilename = filedialog.asksaveasfilename = lambda **more: ""
    dialogs.ask = lambda root, title, text, icon, default, *buttons, **more: len(buttons) - 1

    def cancelled(dialog, focus=None):
        dialog.window.destroy()
    dialogs.Touchoff.wait = cancelled
    root.focus_force()
    op.wait(0.1)

    def moves():
        op.wait(0.3)
        return any(abs(j["velocity"]) > 0 for j in op.stat.joint[:3])

    def rests():
        op.wait(0.8)
        return not any(abs(j["velocity"]) > 0 for j in op.stat.joint[:3]) and not app.jogger.running
    for key in ("F1", "F2"):
        x("key", key)
        op.wait(0.3)
    x("key", "ctrl+Home")
    op.until(app.all_homed, "homing by ctrl+Home")
    op.wait(0.2)
    print("on and homed:", op.stat.task_state == linuxcnc.STATE_ON)
    for name, down, up in (("Right", ["Right"], ["Right"]),
                           ("shift and Left, shift first", ["shift", "Left"], ["shift", "Left"]),
                           ("two axes", ["Up", "Right"], ["Right", "Up"]), ("keypad", ["KP_Left"], ["KP_Left"]),
                           ("minus", ["minus"], ["minus"])):
        for key in down:
            x("keydown", key)
        moving = moves()
        x("keyup", up[0])
        if name.startswith("shift"):
            stopped = rests()            # a jog does not outlive a part of its chord
        for key in up[1:]:
            x("keyup", key)
        print(f"{name}: moves {moving}, rests {stopped if name.startswith('shift') else rests()}")
    x("keydown", "Left")
    moving = moves()
    other = lib.tk.Toplevel(root)
    other.geometry("+600+300")
    root.update()
    other.focus_force()
    print("held, another window takes the keyboard: moves", moving, "rests", rests())
    x("keyup", "Left")
    other.destroy()
    root.focus_force()
    op.wait(0.2)
    print("after it: rests", rests())

    fields(op)
    slow_clicks(op)
    rng, held, faults = random.Random(SEED), [], 0
    for step in range(STEPS):
        if rng.random() < 0.3 and len(held) < 3:
            held.append(rng.choice(HELD))
            x("keydown", held[-1])
        elif held and rng.random() < 0.5:
            x("keyup", held.pop(rng.randrange(len(held))))
        else:
            x("key", rng.choice(KEYS))
        op.wait(rng.choice((0.02, 0.1, 0.3)))
        if step % 15 == 14:
            for key in held:
                x("keyup", key)
            held.clear()
            op.wait(0.3)
            for wrong in (still_jogging(op), *screen_agrees.all_of_it(op)):
                if wrong:
                    faults += 1
                    print("step", step, wrong)
            root.tk.call("tk::MenuUnpost", "")
            root.focus_force()
            work(op)
    print("steps:", STEPS, "faults:", faults)
    sys.stdout = sys.__stdout__


lib.run(script)
