#!/usr/bin/python3
# Presses each key of the sheet's table in each state of the screen and writes down what the machine is told and what
# the screen shows.
import os
import tkinter as tk
from tkinter import filedialog

import linuxcnc
import operator_lib as lib
from axis.follow import OPTIONS
from axis import dialogs

SHIFT, CONTROL, ALT, NUMLOCK = 1, 4, 8, 16
# (keysym, modifiers): the table of the reference in its order; then combinations that must do nothing
KEYS = [(k, 0) for k in "F1 F2 F3 F5 F4".split()] + [("Tab", CONTROL)] + [(k, 0)
                                                                          for k in "F7 F8 F9 F10 F11 F12 b".split()] + [("B", SHIFT)]
KEYS += [("o", 0), ("r", CONTROL), ("s", CONTROL), ("r", 0), ("t", 0), ("p", 0), ("s", 0), ("Escape", 0), ("R", SHIFT),
         ("F", SHIFT), ("l", 0)]
KEYS += [(k, 0) for k in "v d x y z a 0 1 2 9 grave i".split()] + [("I", SHIFT), ("c", 0), ("minus", 0), ("equal", 0)]
JOGS = "Left Right Down Up Next Prior bracketleft bracketright KP_Left KP_Right KP_Down KP_Up KP_Next KP_Prior".split()
KEYS += ([(k, 0) for k in JOGS] + [(k, NUMLOCK) for k in "KP_4 KP_6 KP_2 KP_8 KP_3 KP_9".split()]
         + [("Left", SHIFT), ("Prior", SHIFT)])
KEYS += [("comma", 0), ("period", 0), ("less", 0), ("greater", SHIFT), ("semicolon", 0), ("apostrophe", 0)]
KEYS += [("exclam", SHIFT), ("at", SHIFT), ("numbersign", SHIFT), ("dollar", SHIFT), ("Home", 0), ("Home", CONTROL),
         ("Home", SHIFT)]
KEYS += [("End", 0), ("End", CONTROL), ("KP_Home", 0), ("KP_End", 0), ("KP_Home", SHIFT), ("KP_Home", CONTROL),
         ("KP_End", CONTROL)]
KEYS += [("f", ALT), ("m", ALT), ("v", ALT), ("k", CONTROL), ("e", CONTROL), ("space", CONTROL), ("Return", 0),
         ("m", CONTROL), ("h", CONTROL), ("H", CONTROL | SHIFT)]
NOTHING = [("L", SHIFT), ("O", SHIFT), ("T", SHIFT), ("p", ALT), ("q", 0), ("u", 0), ("Left", CONTROL), ("Right", ALT),
           ("minus", CONTROL), ("minus", SHIFT)]
NOTHING += [(k, m) for m in (CONTROL, ALT, CONTROL | ALT)
            for k in "F2 F3 F5 F4 F7 F9 F11 b o t r s Escape l v d x 5 i c comma exclam dollar Home End k e space".split()
            if (k, m) not in KEYS]
FULL = ("manual",)
BUSY = ("moving", "mdimoving", "homing")
NAMES = {value: name for name, value in vars(linuxcnc).items() if name.startswith("MODE_")}
AUTO = {value: name for name, value in vars(linuxcnc).items() if name.startswith("AUTO_")}
JOG = {value: name[4:].lower() for name, value in vars(linuxcnc).items() if name.startswith("JOG_")}
STATES = {value: name[6:] for name, value in vars(linuxcnc).items() if name.startswith("STATE_")}
SHOWN = "ja_rbutton jogincrement jog_slider_val ajog_slider_val maxvel_slider_val feedrate metric display_type coord_type rotate_mode view_type mdi_command".split()
CHOICES = ("show_program show_rapids program_alpha show_live_plot show_tool show_extents show_offsets "
           "show_machine_limits show_machine_speed "
           "show_distance_to_go dro_large_font grid_size optional_stop block_delete tto_g11 dark_theme "
           "large_touch_targets interface_scale").split()
told = []


class Command:
    """linuxcnc.command that writes down what it is told."""

    def __init__(self):
        self.real = linuxcnc.real_command()

    def __getattr__(self, name):
        function = getattr(self.real, name)
        if name in ("wait_complete", "serial", "maxvel", "task_plan_synch", "jog_held"):
            return function

        def call(*args):
            told.append(text_of(name, args))
            return function(*args)
        return call


def text_of(name, args):
    if name == "mode":
        return NAMES[args[0]]
    if name == "state":
        return "state " + STATES[args[0]]
    if name == "auto":
        return AUTO[args[0]]
    if name == "jog":
        return f"jog {JOG[args[0]]} {'joint' if args[1] else 'axis'} {args[2]}" + "".join(f" {a:g}" for a in args[3:])
    if name == "program_open":
        return "program_open"
    return " ".join([name, *(f"{a:g}" if isinstance(a, float) else str(a) for a in args)])


def script(op):
    out = open("transcript", "w", buffering=1)
    app, root = op.app, op.root
    patch_dialogs()
    states, wanted = os.environ["STATES"].split(), os.environ["KEYS"].split()
    if os.environ.get("MENUS"):
        menus(op, out)
        out.close()
        return
    results = {}
    for state in states:
        enter(op, state)
        base = look(op)
        app.preview.clear_plot = lambda: told.append("clears the plot")
        for key, modifiers in KEYS + (NOTHING if state in FULL else []):
            if wanted and key not in wanted:
                continue
            if (key, modifiers) == ("space", CONTROL):
                app.notifications.add("info", "a message")
            target = app.widgets.mdi_command if state == "entry" else root
            if state == "entry":
                target.focus_force()
            told.clear()
            before = look(op)
            target.event_generate(f"<KeyPress-{key}>", state=modifiers)
            op.wait(0.02)
            target.event_generate(f"<KeyRelease-{key}>", state=modifiers)
            while app.keys.held:             # a release waits for a repeat, in real time
                root.update()
            op.wait(0.04)
            if any(words.startswith("jog stop") for words in told):
                op.until(lambda: not look(op)["moves"], "rest")
            effect = [*told, *(f"{n}={v}" for n, v in look(op).items() if v != before[n])]
            if effect and state == "entry" and effect[0].startswith("mdi_command="):
                effect = ["typed"]
            results.setdefault((key, modifiers), {}).setdefault("; ".join(effect) or "-", []).append(state)
            if effect:
                again(op, state, base)
    silent = []
    for (key, modifiers), effects in results.items():
        if list(effects) == ["-"] and (key, modifiers) in NOTHING:
            silent.append(name(key, modifiers))
            continue
        print(name(key, modifiers), file=out)
        for effect, where in effects.items():
            print("   ", " ".join(where) + ":", effect, file=out)
    print("nothing anywhere:", *silent, file=out)
    out.close()


def menus(op, out):
    """Each entry of each menu, chosen on a homed machine that is on and idle."""
    app, tcl = op.app, op.root.tk
    app.run_program = lambda words: told.append("starts " + " ".join(os.path.basename(w) for w in words))
    tcl.createcommand("::axis::tool_program",
                      lambda *words: told.append("starts " + " ".join(os.path.basename(w) for w in words)))
    app.preview.clear_plot = lambda: told.append("clears the plot")
    enter(op, "spindle")
    base = look(op)
    for menu in ("file", "file.recent", "machine", "machine.home", "machine.unhome", "machine.clearoffset", "view",
                 "view.grid", "view.size", "help"):
        path = f".menu.{menu}"
        for i in range(int(tcl.call(path, "index", "end")) + 1):
            kind = str(tcl.call(path, "type", i))
            if kind not in ("command", "checkbutton", "radiobutton"):
                continue
            label = str(tcl.call(path, "entrycget", i, "-label"))
            if label == "Quit":
                continue
            if str(tcl.call(path, "entrycget", i, "-state")) == "disabled":
                print(f"{menu}: {label}: disabled", file=out)
                continue
            told.clear()
            before, options = look(op), {n: getattr(app.vars, n).get() for n in CHOICES}
            tcl.call(path, "invoke", i)
            op.wait(0.1)
            effect = [*told, *(f"{n}={v}" for n, v in look(op).items() if v != before[n])]
            effect += [f"{n}={getattr(app.vars, n).get()}" for n in CHOICES if getattr(app.vars, n).get() != options[n]]
            effect += [f"shows {w}" for w in (".about", ".keys") if str(tcl.call("wm", "state", w)) == "normal"]
            print(f"{menu}: {label}: {'; '.join(effect) or '-'}", file=out)
            for w in (".about", ".keys"):
                tcl.call("wm", "withdraw", w)
            for n in CHOICES:
                if n in OPTIONS and getattr(app.vars, n).get() != options[n]:
                    app.send_option(n, options[n])       # the screen follows the machine in these
                getattr(app.vars, n).set(options[n])
            again(op, "spindle", base)


def name(key, modifiers):
    return "".join(f"{n}-" for n, m in (("Ctrl", CONTROL), ("Alt", ALT), ("Shift", SHIFT)) if modifiers & m) + key


def patch_dialogs():
    def ask(root, title, text, icon, default, *buttons, escape=None, **more):
        told.append(f"asks {title}")
        return len(buttons) - 1

    def wait(dialog, focus=None):
        told.append(f"asks {dialog.window.title()}")
        dialog.window.destroy()
    dialogs.ask, dialogs.Touchoff.wait = ask, wait
    filedialog.askopenfilename = lambda **more: told.append("asks for a file") or ""
    filedialog.asksaveasfilename = lambda **more: told.append("asks where to save") or ""


def look(op):
    """What the screen and the machine show, beside the position."""
    app, s, tcl = op.app, op.stat, op.root.tk
    seen = {n: getattr(app.vars, n).get() for n in SHOWN}
    seen |= {"power": STATES[s.task_state], "mode": NAMES[s.task_mode], "runs": s.interp_state != linuxcnc.INTERP_IDLE,
             "paused": bool(s.paused), "mist": s.mist, "flood": s.flood, "spindle": s.spindle[0]["direction"],
             "rpm": round(s.spindle[0]["speed"]), "brake": s.spindle[0]["brake"],
             "tab": str(tcl.call(".pane.top.tabs", "raise")), "page": str(tcl.call(".pane.top.right", "raise")),
             "teleop": int(app.vars.teleop_mode.get()), "homed": sum(s.homed), "homing": homing(op),
             "motion": s.motion_mode, "moves": s.current_vel > 0 or any(j["velocity"] for j in s.joint),
             "joints": app.joints_shown, "messages": [m.split(".")[0][:32] for m in op.messages()],
             "history": app.widgets.mdi_history.size(), "panel": app.vars.show_pyvcppanel.get(),
             "focus": str(tcl.call("focus")), "clipboard": clipboard(op.root)}
    return seen


def homing(op):
    return any(j["homing"] for j in op.stat.joint)


def clipboard(root):
    try:
        return root.clipboard_get()
    except tk.TclError:
        return ""


def again(op, state, base):
    """Back to the state, with as little as is needed."""
    app, v = op.app, op.app.vars
    op.root.tk.call("tk::MenuUnpost", "")
    for n in SHOWN:
        v.put(n, base[n])
    app.units_changed()
    app.slider("jog", None)
    app.slider("ajog", None)
    app.slider("maxvel", None)
    if app.preview.camera.view != "p" and not app.settings.lathe:
        app.preview.set_view("p")
    if v.show_pyvcppanel.get() != base["panel"]:
        app.toggle_panel()
    op.root.tk.call(".pane.top.right", "raise", base["page"])
    app.notifications.clear()
    app.set_override("feedrate", base["feedrate"])
    now = look(op)
    if any(now[n] != base[n]
           for n in ("power", "mode", "runs", "paused", "mist", "flood", "spindle", "rpm", "brake", "tab", "teleop",
                     "homed", "history", "focus")) or \
            (not op.stat.inpos and state not in ("run",
                                                 *BUSY)) or any(op.stat.g5x_offset) or (homing(op) and state != "homing"):
        enter(op, state)
    if look(op) != base:
        enter(op, state)
        wrong = {n: (a, base[n]) for n, a in look(op).items() if a != base[n]}
        if wrong:
            print("not restored", state, wrong)


def enter(op, state):
    app, c = op.app, op.app.command.real
    v = app.vars

    def do(name, *args):
        getattr(c, name)(*args)
        c.wait_complete()
    do("abort")
    op.until(lambda: op.stat.interp_state == linuxcnc.INTERP_IDLE and op.stat.inpos, "idle")
    do("mode", linuxcnc.MODE_MANUAL)
    do("state", linuxcnc.STATE_ESTOP)
    if state != "estop":
        do("state", linuxcnc.STATE_ESTOP_RESET)
        if state != "off":
            do("state", linuxcnc.STATE_ON)
    if state not in ("estop", "off"):
        do("mist", linuxcnc.MIST_OFF)
        do("flood", linuxcnc.FLOOD_OFF)
        do("spindle", linuxcnc.SPINDLE_OFF)
        do("brake", linuxcnc.BRAKE_ENGAGE)
    op.root.tk.call(".pane.top.tabs", "raise", "manual")
    if state in ("estop", "off", "unhomed"):
        if any(op.stat.homed):
            do("teleop_enable", 0)
            do("unhome", -1)
    elif not app.all_homed():
        do("teleop_enable", 0)
        do("home", -1)
        op.until(app.all_homed, "homed")
        op.wait(0.1)
    if any(op.stat.g5x_offset):
        do("mode", linuxcnc.MODE_MDI)
        do("mdi", "G10 L2 P1 X0 Y0 Z0")
        do("mode", linuxcnc.MODE_MANUAL)
    if state in ("mdi", "entry"):
        app.raise_tab("mdi")
    if state not in ("estop", "off", "unhomed"):
        do("teleop_enable", int(state != "joint"))
    op.root.focus_force() if state != "entry" else app.widgets.mdi_command.focus_force()
    if state == "entry":             # a history of one line, which is selected, and another in the clipboard
        app.root.tk.call("clear_mdi_history")
        for text in ("G4 P0", "G4 P1"):
            app.root.clipboard_clear()
            app.root.clipboard_append(text)
            if text == "G4 P0":
                app.root.tk.call("mdi_history_clip2hist")
        app.widgets.mdi_history.selection_set(0)
    if state in ("run", "paused", "spindle"):
        if state == "spindle":
            if op.stat.tool_in_spindle != 1:
                do("mode", linuxcnc.MODE_MDI)
                do("mdi", "T1 M6")
                do("mode", linuxcnc.MODE_MANUAL)
                do("teleop_enable", 1)
            do("spindle", linuxcnc.SPINDLE_FORWARD, 500)
        else:
            do("mode", linuxcnc.MODE_MDI)
            do("mdi", "G0 X0 Y0 Z0")
            do("mode", linuxcnc.MODE_AUTO)
            c.auto(linuxcnc.AUTO_RUN, 0)
            op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE and op.stat.motion_line > 1, "runs")
            if state == "paused":
                c.auto(linuxcnc.AUTO_PAUSE)
                op.until(lambda: op.stat.paused, "paused")
    if state in ("moving", "mdimoving"):     # an MDI line that takes long
        do("mode", linuxcnc.MODE_MDI)
        do("mdi", "G0 X0 Y0 Z0")
        c.mdi("G1 X300 F600")
        op.until(lambda: op.stat.interp_state != linuxcnc.INTERP_IDLE and op.stat.current_vel > 0, "moves")
        if state == "mdimoving":
            app.raise_tab("mdi")
            op.root.focus_force()
    if state == "homing":
        do("teleop_enable", 0)
        do("unhome", -1)
        c.home(-1)
        op.until(lambda: homing(op), "homes")
    op.wait(0.2)
    op.root.tk.call(".pane.top.right", "raise", "numbers")
    for kind in ("ajog", "maxvel"):
        getattr(v, f"{kind}_slider_val").set(0.5)
        app.slider(kind, 0.5)
    app.set_highlight_line(-1)


linuxcnc.real_command = linuxcnc.command
linuxcnc.command = Command
lib.run(script)
