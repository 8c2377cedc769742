#!/usr/bin/python3
import os
import random
import sys
import traceback
from tkinter import filedialog

import operator_lib as lib
from operator_checks import disagreement, still_jogging, work
from axis import commands, dialogs

SEED = int(os.environ.get("SEED", "20"))
STEPS = int(os.environ.get("STEPS", "350"))
PLAIN = ("F1 F2 F3 F4 F5 F7 F8 F9 F10 F11 F12 b o r t p s Escape l v d x y z a i I c grave 1 5 0 exclam at numbersign dollar comma period less "
         "greater semicolon apostrophe Home End Return B R F minus equal Left Right Up Down Next Prior bracketleft KP_Left KP_8 KP_Home space "
         "Delete q Tab r r r r t t p s s").split()
JOGS = "Left Right Up Down Next Prior minus equal bracketright KP_6".split()
CONTROL = "r s k Home End e space Tab m h x".split()
BUTTONS = (".toolbar.machine_power .toolbar.reload .toolbar.program_run .toolbar.program_step .toolbar.program_pause .toolbar.program_stop "
           ".toolbar.program_blockdelete .toolbar.program_optpause .toolbar.view_zoomin .toolbar.view_zoomout .toolbar.view_z .toolbar.view_p "
           ".toolbar.rotate .toolbar.clear_plot .pane.top.tabs.fmanual.jogf.zerohome.home .pane.top.tabs.fmanual.jogf.zerohome.zero "
           ".pane.top.tabs.fmanual.jogf.zerohome.tooltouch .pane.top.tabs.fmanual.jogf.override .pane.top.tabs.fmanual.spindlef.cw "
           ".pane.top.tabs.fmanual.spindlef.stop .pane.top.tabs.fmanual.mist .pane.top.tabs.fmanual.flood .pane.top.tabs.fmanual.axes.axisy "
           ".pane.top.tabs.fmdi.go").split()
MDI = ("G0 X1 Y1 Z40", "G1 X5 F500", "M3 S500", "M5", "G0 X", "G55", "G54", "T2 M6", "G43", "M2", "#1=[1/0]", "G91 G0 X1", "G90", "hello", "G92 X1",
       "G92.1", "G4 P0.1")


class Trouble:
    """Counts tracebacks, wherever they would be printed."""
    texts = []

    @classmethod
    def print_exc(cls, *args, **more):
        cls.texts.append(traceback.format_exc())


def script(op):
    out = open("transcript", "w", buffering=1)
    sys.stdout = out
    rng, app, root = random.Random(SEED), op.app, op.root
    traceback.print_exc = Trouble.print_exc
    dialogs.ask = lambda root, title, text, icon, default, *buttons, **more: rng.randrange(len(buttons))

    def touchoff(dialog, focus=None):
        dialog.value.set(rng.choice(("0", "[1+2]*3", "]", "", "12.5", "abc")))
        dialog.answer(None) if rng.random() < 0.3 else dialog.accept()
        dialog.window.destroy()
        return dialog.result
    dialogs.Touchoff.wait = touchoff
    filedialog.askopenfilename = lambda **more: rng.choice(("", sys.argv[-1], "/nowhere/at/all.ngc"))
    filedialog.asksaveasfilename = lambda **more: rng.choice(("", os.path.abspath("saved.ngc"), "/nowhere/saved.ngc"))
    app.run_program = lambda words: None         # editors and browsers
    root.tk.eval("proc ::axis::tool_program {args} {}; rename exec ::real_exec; proc exec {args} {}")
    held, log = {}, []
    menus = menu_entries(root)

    def press(name, state=0):
        root.event_generate(f"<KeyPress-{name}>", state=state)

    def act():
        kind = rng.random()
        if kind < 0.42:
            key = rng.choice(PLAIN)
            if key in ("F1", "F2") and rng.random() < 0.7:
                key = "r"
            state = 1 if key in "BRFI" and len(key) == 1 else rng.choice((0, 0, 0, 0, 1, 8))
            target = app.widgets.mdi_command if rng.random() < 0.1 else root
            log.append(f"key {key} {state}")
            target.event_generate(f"<KeyPress-{key}>", state=state)
            target.event_generate(f"<KeyRelease-{key}>", state=state)
        elif kind < 0.52:
            key = rng.choice(CONTROL)
            log.append(f"control {key}")
            press(key, 4)
            root.event_generate(f"<KeyRelease-{key}>", state=4)
        elif kind < 0.66:
            key = rng.choice(JOGS)
            log.append(f"hold {key}")
            press(key, rng.choice((0, 0, 1)))
            held[key] = True
        elif kind < 0.74 and held:
            key = rng.choice(list(held))
            log.append(f"let go {key}")
            del held[key]
            root.event_generate(f"<KeyRelease-{key}>", state=rng.choice((0, 1)))
        elif kind < 0.86:
            path = rng.choice(BUTTONS)
            log.append(f"click {path}")
            if op.enabled(path):
                root.tk.call(path, "invoke")
        elif kind < 0.93:
            text = rng.choice(MDI)
            log.append(f"MDI {text}")
            app.vars.mdi_command.set(text)
            app.widgets.mdi_command.event_generate("<KeyPress-Return>")
        elif kind < 0.97:
            menu, index, label = rng.choice(menus)
            log.append(f"menu {label}")
            if str(root.tk.call(menu, "entrycget", index, "-state")) != "disabled":
                root.tk.call(menu, "invoke", index)
        else:
            log.append("focus out")
            root.event_generate("<FocusOut>")
            held.clear()

    faults = 0
    work(op)
    for step in range(STEPS):
        act()
        op.wait(rng.choice((0.0, 0.02, 0.1, 0.4)))
        if rng.random() < 0.06:      # hands off: nothing that was jogged may go on
            for key in list(held):
                root.event_generate(f"<KeyRelease-{key}>")
            held.clear()
            op.wait(0.2)
            wrong = still_jogging(op)
            if wrong:
                faults += 1
                print("step", step, wrong, log[-6:])
        if step % 25 == 24:
            op.wait(0.6)
            for wrong in disagreement(op):
                faults += 1
                print("step", step, wrong, log[-6:])
        if step % 40 == 39:          # back to work: otherwise most of the time the machine would be off
            work(op)
    for text in Trouble.texts + op.trouble:
        faults += 1
        print(text)
    op.trouble.clear()
    print("steps:", STEPS, "faults:", faults)
    sys.stdout = sys.__stdout__


def menu_entries(root):
    """(menu, index, label) of what a click in a menu may do, without ending the screen."""
    found = []
    for menu in (".menu.file", ".menu.machine", ".menu.view", ".menu.machine.home", ".menu.machine.unhome", ".menu.machine.clearoffset",
                 ".menu.view.grid", ".menu.help"):
        for i in range(int(root.tk.call(menu, "index", "end")) + 1):
            kind = str(root.tk.call(menu, "type", i))
            if kind in ("command", "checkbutton", "radiobutton"):
                label = str(root.tk.call(menu, "entrycget", i, "-label"))
                if label != "Quit":
                    found.append((menu, i, label))
    return found


lib.run(script)
