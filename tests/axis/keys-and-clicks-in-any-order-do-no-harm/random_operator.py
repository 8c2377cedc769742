#!/usr/bin/python3
import os
import random
import re
import signal
import sys
import traceback
from tkinter import filedialog

import hal
import linuxcnc
import operator_lib as lib
import screen_agrees
import session
from operator_checks import outside_limits, still_jogging, work
from axis import dialogs
from kerf import clock

SEED = int(os.environ.get("SEED", "20"))
STEPS = int(os.environ.get("STEPS", "350"))
KILL = int(os.environ.get("KILL", "-1"))             # task is killed after so many steps
PLAIN = ("F1 F2 F3 F4 F5 F7 F8 F9 F10 F11 F12 b o r t p s Escape l v d x y z a i I c grave 1 5 0 exclam at numbersign "
         "dollar comma period less "
         "greater semicolon apostrophe Home End Return B R F minus equal Left Right Up Down Next Prior bracketleft "
         "KP_Left KP_8 KP_Home space "
         "Delete q Tab r r r r t t p s s").split()
JOGS = "Left Right Up Down Next Prior minus equal bracketright KP_6".split()
CONTROL = "r s k Home End e space Tab m h x".split()
BUTTONS = (".toolbar.machine_power .toolbar.reload .toolbar.program_run .toolbar.program_step .toolbar.program_pause "
           ".toolbar.program_stop "
           ".toolbar.program_blockdelete .toolbar.program_optpause .toolbar.view_zoomin .toolbar.view_zoomout "
           ".toolbar.view_z .toolbar.view_p "
           ".toolbar.view_x .toolbar.view_y .toolbar.view_z2 .toolbar.view_y2 "
           ".pane.top.tabs.fmanual.spindlef.ccw .pane.top.tabs.fmanual.spindlef.brake "
           ".pane.top.tabs.fmanual.axes.axisz "
           ".pane.top.tabs.fmanual.joints.joint0 .pane.top.tabs.fmanual.joints.joint1 "
           ".toolbar.rotate .toolbar.clear_plot .pane.top.tabs.fmanual.jogf.zerohome.home "
           ".pane.top.tabs.fmanual.jogf.zerohome.zero "
           ".pane.top.tabs.fmanual.jogf.zerohome.tooltouch .pane.top.tabs.fmanual.jogf.override "
           ".pane.top.tabs.fmanual.spindlef.cw "
           ".pane.top.tabs.fmanual.spindlef.stop .pane.top.tabs.fmanual.mist .pane.top.tabs.fmanual.flood "
           ".pane.top.tabs.fmanual.axes.axisy "
           ".pane.top.tabs.fmdi.go").split()
MDI = ("G0 X1 Y1 Z40", "G1 X5 F500", "M3 S500", "M5", "G0 X", "G55", "G54", "T2 M6", "G43", "M2", "#1=[1/0]",
       "G91 G0 X1", "G90", "hello", "G92 X1", "G92.1", "G4 P0.1")
PULSES = [f"halui.{name}"
          for name in ("abort", "machine.off", "machine.on", "estop.activate", "estop.reset", "mode.mdi", "mode.manual",
                       "mode.auto", "program.run", "program.pause", "program.stop", "program.block-delete.on",
                       "program.block-delete.off", "program.optional-stop.off")]
SWITCHES = ("joint.0.neg-lim-sw-in", "joint.1.pos-lim-sw-in", "joint.2.home-sw-in")
EVENTS = {"click": ("<Enter>", "<Button-1>", "<ButtonRelease-1>", "<Leave>"), "press": ("<Enter>", "<Button-1>"),
          "let go": ("<ButtonRelease-1>", "<Leave>"),
          "double": ("<Enter>", *("<Button-1>", "<ButtonRelease-1>") * 2, "<Leave>"),
          "triple": ("<Enter>", *("<Button-1>", "<ButtonRelease-1>") * 3),
          "wheel": ("<Enter>", "<Button-4>", "<Button-5>", "<Button-5>"),
          "right": ("<Enter>", "<Button-3>", "<ButtonRelease-3>"),
          "drag": ("<Enter>", "<Button-1>", "<B1-Motion>", "<B1-Motion>", "<ButtonRelease-1>", "<Leave>")}
MOVERS = re.compile("hold|MDI|mdi|control Home|program.run|resume|"
                    "key ([rtspR]|Home|KP_|Left|Right|Up|Down|Next|Prior|minus|equal|bracket)|"
                    "(run|step|pause|home|go|history|jogplus|jogminus)$|menu (Run|Step|Resume|Home)")
STARTERS = re.compile("F[0-9]+|MDI|mdi|key [rtspR]|program.run|resume|"
                      "(run|step|pause|cw|ccw|mist|flood|go|history|spindle[a-z]*)$|menu (Run|Step|Resume)")
MOUSED = (".pane.top.tabs.fmanual.jogf.jog.jogplus .pane.top.tabs.fmanual.jogf.jog.jogminus "
          ".pane.top.tabs.fmdi.history .pane.bottom.t.text "
          ".toolbar.machine_estop .toolbar.program_run .toolbar.program_step .toolbar.program_pause "
          ".toolbar.program_stop .toolbar.program_blockdelete "
          ".pane.top.tabs.fmanual.spindlef.spindleplus .pane.top.tabs.fmanual.spindlef.spindleminus "
          ".pane.top.tabs.fmanual.spindlef.cw "
          ".pane.top.tabs.fmanual.mist .pane.top.feedoverride.foscale .pane.top.jogspeed.s .pane.top.maxvel.s "
          ".pane.top.tabs.fmdi.go "
          ".pane.top.rapidoverride.foscale .pane.top.spinoverride.foscale .pane.top.ajogspeed.s "
          ".pane.top.tabs.c .pane.top.right.c .pane.bottom.t.sb "
          ".pane.top.tabs.fmanual.jogf.jog.jogincr .pane.top.tabs.fmdi.waiting .info.position .toolbar.machine_power "
          ".pane.top.right.fnumbers.text .pane.top.tabs.fmanual.jogf.zerohome.home").split()


class Trouble:
    """Counts tracebacks, wherever they would be printed."""
    texts = []

    @classmethod
    def print_exc(cls, *args, file=None, **more):
        cls.texts.append(traceback.format_exc())
        if file is not None:             # the operator's own fault
            print(cls.texts[-1], file=file)


class Watch:
    """Nothing moves, turns or flows that nobody started: looks after each step at what was done since the last look."""

    def __init__(self, op):
        self.op, self.seen = op, None

    def look(self, done):
        s = self.op.stat
        busy = s.interp_state != linuxcnc.INTERP_IDLE or bool(self.op.app.jogger.running) or \
            any(j["homing"] for j in s.joint)
        moves = any(abs(j["velocity"]) > 1e-9 for j in s.joint) or not s.inpos
        now = (busy, moves, s.joint_position, any(sp["direction"] for sp in s.spindle), s.flood or s.mist)
        was, self.seen = self.seen, now
        if was is None or was[0] or busy:
            return
        moved = moves or max(abs(a - b) for a, b in zip(was[2], now[2])) > 1e-6
        if not was[1] and moved and not any(MOVERS.search(d) for d in done):
            yield f"moves, nobody asked: {was[2][:5]} {now[2][:5]} {done}"
        for n, what in ((3, "spindle"), (4, "coolant")):
            if now[n] and not was[n] and not any(STARTERS.search(d) for d in done):
                yield f"{what} on, nobody asked: {done}"


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
    panel = lib.tk.Frame(root)           # of a user: fields with the keyboard in them
    panel.grid(row=0, column=4, rowspan=6)
    for kind in (lib.tk.Entry, lib.tk.Spinbox, lib.tk.Button):
        kind(panel, width=4).pack()
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
        what = rng.choice(("pulse", "pulse", "pulse", "switch", "chain", "client", "remote", "opens"))
        if what == "remote":
            words = rng.choice((("open_file_name", sys.argv[-1]), ("reload_file",), ("send_mdi_command", "G0 X2"),
                                ("clear_live_plot",), ("nonsense",)))
            log.append(f"remote {words[0].replace('send_mdi', 'mdi')}")
            root.tk.call("remote", *words)
            return
        if what == "opens":
            log.append("opens")
            other.program_open(rng.choice((sys.argv[-1], os.path.abspath("saved.ngc"), "/nowhere.ngc")))
            return
        if what == "client":
            name, *arguments = rng.choice((("mode", linuxcnc.MODE_MDI), ("mode", linuxcnc.MODE_MANUAL),
                                           ("mode", linuxcnc.MODE_AUTO), ("mdi", "G0 X3"), ("abort",),
                                           ("teleop_enable", 0), ("teleop_enable", 1), ("unhome", -1),
                                           ("feedrate", 0.5), ("set_block_delete", 0), ("state", linuxcnc.STATE_OFF)))
            log.append(f"client {name} {arguments}")
            getattr(other, name)(*arguments)
            return
        pin, value = (("chain.in1", "0") if what == "chain"
                      else (rng.choice(SWITCHES if what == "switch" else PULSES), "1"))
        log.append(f"{pin} {value}")
        try:
            hal.set_p(pin, value)
        except RuntimeError:             # this machine does not have it, or it has a switch of its own there
            return
        raised.append((pin, "1" if value == "0" else "0"))

    def mouse():
        path, what = rng.choice((*MOUSED, str(app.preview.picture))), rng.choice(list(EVENTS))
        log.append(f"{what} {path}")
        x, y = rng.randrange(2, 60), rng.randrange(2, 16)
        for event in EVENTS[what]:
            root.tk.call("event", "generate", path, event, "-x", x, "-y", y)
            x, y = x + rng.randrange(-9, 9), y + rng.randrange(-9, 9)
        root.tk.call("tk::MenuUnpost", "")

    def focus():
        log.append("focus")
        w = app.widgets
        rng.choice((root, w.mdi_command, w.numbers_text, w.jogincr, *panel.winfo_children())).focus_force()
        root.update()

    def window():
        """The desktop does something with the window; a list of increments; a page."""
        what = rng.choice(("iconify", "size", "increment", "page", "close message", "light"))
        log.append(what)
        if what == "iconify":
            root.iconify()
            root.update()
            root.deiconify()
        elif what == "size":
            root.geometry(rng.choice(("640x480", "1024x600", "1024x768", "200x100")))
        elif what == "increment" and not app.jogger.running:
            app.vars.jogincrement.set(rng.choice(app.increments()))
            app.widgets.jogincr.event_generate("<<ComboboxSelected>>")
        elif what == "page":
            root.tk.call(".pane.top.right", "raise", rng.choice(("preview", "numbers")))
        elif what == "close message" and app.notifications.shown:
            app.notifications.remove(rng.choice(app.notifications.shown)[1])
        root.update()

    def hands_off():
        for key in list(held):
            root.event_generate(f"<KeyRelease-{key}>")
        held.clear()
        for path in MOUSED:
            root.tk.call("event", "generate", path, "<ButtonRelease-1>")
        op.wait(0.2)

    def asked_steps():
        """So many presses move at most so many steps, and one axis or joint alone."""
        if app.joints_shown or not app.all_homed() or op.stat.task_state != linuxcnc.STATE_ON:
            return
        app.vars.jogincrement.set("1mm")
        app.increment_chosen()
        before, presses = op.stat.actual_position, rng.randrange(1, 6)
        axis = "XYZABCUVW".index(app.jog_target(0).upper())
        for _ in range(presses):
            press("Right")
            root.event_generate("<KeyRelease-Right>")
            op.wait(rng.choice((0.0, 0.02, 0.1)))
        op.wait(1.0)
        moved = [b - a for a, b in zip(before, op.stat.actual_position)]
        step = 1.0 if axis not in (3, 4, 5) else app.jogger.distance()
        if abs(moved[axis]) > presses * step + 1e-3 or any(abs(v) > 1e-3 for i, v in enumerate(moved) if i != axis):
            yield f"{presses} steps moved {moved}"
        app.continuous()

    def act():
        if rng.random() < 0.2:
            rng.choice((outside, outside, mouse, mouse, mouse, focus, window))()
            return
        kind = rng.random()
        if kind < 0.42:
            key = rng.choice(PLAIN)
            if key in ("F1", "F2") and rng.random() < 0.7:
                key = "r"
            state = 1 if key in "BRFI" and len(key) == 1 else rng.choice((0, 0, 0, 0, 0, 1, 8, 2, 16))
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
            if op.enabled(path) and root.tk.call("winfo", "viewable", path):
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

    faults, watch, seen = 0, Watch(op), 0
    work(op)
    for step in range(STEPS):
        act()
        if step == KILL:
            end_of_task(op, act, rng, log)
        op.wait(rng.choice((0.0, 0.02, 0.1, 0.4)))
        for wrong in (*outside_limits(op), *watch.look(log[seen:])):
            faults += 1
            print("step", step, wrong, log[-6:])
        seen = len(log)
        if rng.random() < 0.06:      # hands off: nothing that was jogged may go on
            hands_off()
            wrong = still_jogging(op)
            if wrong:
                faults += 1
                print("step", step, wrong, log[-6:])
        if step % 25 == 24:
            op.wait(0.8)
            for wrong in screen_agrees.all_of_it(op):
                faults += 1
                print("step", step, wrong, log[-6:])
        if step % 40 == 39:          # back to work: otherwise most of the time the machine would be off
            quiet_outside()
            hands_off()
            root.focus_force()
            work(op)
            watch.seen = None
        if step % 80 == 79:
            for wrong in asked_steps():
                faults += 1
                print("step", step, wrong, log[-6:])
            watch.seen = None
    for text in Trouble.texts + op.trouble:
        faults += 1
        print(text)
    op.trouble.clear()
    print("steps:", STEPS, "faults:", faults)
    sys.stdout = sys.__stdout__


def end_of_task(op, act, rng, log):
    """Task is killed: the operator goes on for a while, then the screen ends by itself, with
    no traceback. Does not return."""
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
    for menu in (".menu.file", ".menu.machine", ".menu.view", ".menu.machine.home", ".menu.machine.unhome",
                 ".menu.machine.clearoffset", ".menu.view.grid", ".menu.help"):
        for i in range(int(root.tk.call(menu, "index", "end")) + 1):
            kind = str(root.tk.call(menu, "type", i))
            if kind in ("command", "checkbutton", "radiobutton"):
                label = str(root.tk.call(menu, "entrycget", i, "-label"))
                if label != "Quit":
                    found.append((menu, i, label))
    return found


lib.run(script)
