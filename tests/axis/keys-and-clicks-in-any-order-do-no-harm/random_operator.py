#!/usr/bin/python3
import os
import random
import signal
import sys
import traceback
from tkinter import filedialog

import hal
import linuxcnc
import operator_lib as lib
import session
from operator_checks import disagreement, outside_limits, still_jogging, work
from axis import dialogs
from kerf import clock

SEED = int(os.environ.get("SEED", "20"))
STEPS = int(os.environ.get("STEPS", "350"))
KILL = int(os.environ.get("KILL", "-1"))             # task is killed after so many steps
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
PULSES = [f"halui.{name}" for name in ("abort", "machine.off", "machine.on", "estop.activate", "estop.reset", "mode.mdi", "mode.manual", "mode.auto", "program.run",
                                       "program.pause", "program.stop", "program.block-delete.on", "program.block-delete.off", "program.optional-stop.off")]
SWITCHES = ("joint.0.neg-lim-sw-in", "joint.1.pos-lim-sw-in", "joint.2.home-sw-in")
EVENTS = {"click": ("<Enter>", "<Button-1>", "<ButtonRelease-1>", "<Leave>"), "press": ("<Enter>", "<Button-1>"), "let go": ("<ButtonRelease-1>", "<Leave>"),
          "double": ("<Enter>", *("<Button-1>", "<ButtonRelease-1>") * 2, "<Leave>"), "triple": ("<Enter>", *("<Button-1>", "<ButtonRelease-1>") * 3)}
MOUSED = (".pane.top.tabs.fmanual.jogf.jog.jogplus .pane.top.tabs.fmanual.jogf.jog.jogminus .pane.top.tabs.fmdi.history .pane.bottom.t.text "
          ".toolbar.machine_estop .toolbar.program_run .toolbar.program_step .toolbar.program_pause .toolbar.program_stop .toolbar.program_blockdelete "
          ".pane.top.tabs.fmanual.spindlef.spindleplus .pane.top.tabs.fmanual.spindlef.spindleminus .pane.top.tabs.fmanual.spindlef.cw "
          ".pane.top.tabs.fmanual.mist .pane.top.feedoverride.foscale .pane.top.jogspeed.s .pane.top.maxvel.s .pane.top.tabs.fmdi.go "
          ".pane.top.right.fnumbers.text .pane.top.tabs.fmanual.jogf.zerohome.home").split()


class Trouble:
    """Counts tracebacks, wherever they would be printed."""
    texts = []

    @classmethod
    def print_exc(cls, *args, file=None, **more):
        cls.texts.append(traceback.format_exc())
        if file is not None:             # the operator's own fault
            print(cls.texts[-1], file=file)


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
    held, raised, log = {}, [], []
    menus, other = menu_entries(root), linuxcnc.command()

    def press(name, state=0):
        root.event_generate(f"<KeyPress-{name}>", state=state)

    def quiet_outside():
        for pin, value in raised:
            hal.set_p(pin, value)
        raised.clear()

    def outside():
        """Somebody or something else: a panel, another client, the safety chain, a switch."""
        quiet_outside()
        what = rng.choice(("pulse", "pulse", "pulse", "switch", "chain", "client"))
        if what == "client":
            name, *arguments = rng.choice((("mode", linuxcnc.MODE_MDI), ("mode", linuxcnc.MODE_MANUAL), ("mode", linuxcnc.MODE_AUTO), ("mdi", "G0 X3"), ("abort",),
                                           ("teleop_enable", 0), ("teleop_enable", 1), ("unhome", -1), ("feedrate", 0.5), ("set_block_delete", 0), ("state", linuxcnc.STATE_OFF)))
            log.append(f"client {name} {arguments}")
            getattr(other, name)(*arguments)
            return
        pin, value = ("chain.in1", "0") if what == "chain" else (rng.choice(SWITCHES if what == "switch" else PULSES), "1")
        log.append(f"{pin} {value}")
        hal.set_p(pin, value)
        raised.append((pin, "1" if value == "0" else "0"))

    def mouse():
        path, what = rng.choice(MOUSED), rng.choice(list(EVENTS))
        log.append(f"{what} {path}")
        x, y = rng.randrange(2, 60), rng.randrange(2, 16)
        for event in EVENTS[what]:
            root.tk.call("event", "generate", path, event, "-x", x, "-y", y)

    def focus():
        log.append("focus")
        rng.choice((root, app.widgets.mdi_command, app.widgets.numbers_text, app.widgets.jogincr)).focus_force()
        root.update()

    def hands_off():
        for key in list(held):
            root.event_generate(f"<KeyRelease-{key}>")
        held.clear()
        for path in MOUSED:
            root.tk.call("event", "generate", path, "<ButtonRelease-1>")
        op.wait(0.2)

    def asked_steps():
        """So many presses move at most so many steps."""
        app.vars.jogincrement.set("1mm")
        app.increment_chosen()
        before, presses = op.stat.actual_position, rng.randrange(1, 6)
        for _ in range(presses):
            press("Right")
            root.event_generate("<KeyRelease-Right>")
            op.wait(rng.choice((0.0, 0.02, 0.1)))
        op.wait(1.0)
        moved = [b - a for a, b in zip(before, op.stat.actual_position)]
        if moved[0] > presses + 1e-3 or moved[0] < -1e-3 or any(abs(v) > 1e-3 for v in moved[1:]):
            yield f"{presses} steps moved {moved[:3]}"
        app.continuous()

    def act():
        if rng.random() < 0.2:
            rng.choice((outside, mouse, mouse, focus))()
            return
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
        if step == KILL:
            end_of_task(op, act, rng, log)
        op.wait(rng.choice((0.0, 0.02, 0.1, 0.4)))
        for wrong in outside_limits(op):
            faults += 1
            print("step", step, wrong, log[-6:])
        if rng.random() < 0.06:      # hands off: nothing that was jogged may go on
            hands_off()
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
            quiet_outside()
            hands_off()
            work(op)
        if step % 80 == 79:
            for wrong in asked_steps():
                faults += 1
                print("step", step, wrong, log[-6:])
    for text in Trouble.texts + op.trouble:
        faults += 1
        print(text)
    op.trouble.clear()
    print("steps:", STEPS, "faults:", faults)
    sys.stdout = sys.__stdout__


def end_of_task(op, act, rng, log):
    """Task is killed: the operator goes on for a while, then the screen ends by itself, with no traceback. Does not return."""
    def end(*_):                 # also by the launcher, wherever the screen waits for task
        for text in Trouble.texts + op.trouble:
            print(text)
        print("task killed, tracebacks:", len(Trouble.texts + op.trouble))
        sys.stdout.flush()
        os._exit(0)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    session.kill("milltask")
    try:
        for _ in range(500):
            if rng.random() < 0.3:
                act()
            if not op.app.tick():
                break
            clock.sleep(0.02)
        else:
            print("the screen did not end")
    except lib.tk.TclError:      # the screen has ended itself
        pass
    except Exception:
        Trouble.texts.append(f"{traceback.format_exc()} {log[-6:]}")
    end()


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
