#!/usr/bin/python3
import os
import sys

import linuxcnc
import operator_lib as lib
from axis import dialogs


class Hand:
    """Works the dialog that is open while the screen waits for its answer."""

    def __init__(self, op):
        self.op, self.tcl = op, op.root.tk
        dialogs.ask = self.real_ask      # the library's answers are not wanted here

    real_ask = staticmethod(dialogs.ask)

    def window(self):
        found = [w for w in self.tcl.splitlist(self.tcl.call("winfo", "children", "."))
                 if str(self.tcl.call("winfo", "class", w)) == "Dialog"
                 and int(self.tcl.call("winfo", "viewable", w)) and str(w) not in (".about", ".keys")]
        return str(found[-1]) if found else None

    def texts(self, path, kind):
        out = []
        for child in self.tcl.splitlist(self.tcl.call("winfo", "children", path)):
            if str(self.tcl.call("winfo", "class", child)) == kind:
                out.append(str(child))
            out += self.texts(child, kind)
        return out

    def stuck(self, path):
        if int(self.tcl.call("winfo", "exists", path)):
            print("    still open:", end="")
            self.describe()
            os._exit(1)

    def describe(self):
        w = self.window()
        labels = [str(self.tcl.call(x, "cget", "-text")) for x in self.texts(w, "Label")]
        buttons = [str(self.tcl.call(x, "cget", "-text"))
                   + ("" if str(self.tcl.call(x, "cget", "-state")) != "disabled" else " (off)")
                   for x in self.texts(w, "Button")]
        focus = str(self.tcl.call("focus"))
        has = (str(self.tcl.call(focus, "cget", "-text")) if str(self.tcl.call("winfo", "class", focus)) == "Button"
               else str(self.tcl.call("winfo", "class", focus)))
        print("  ", self.tcl.call("wm", "title", w), labels, buttons, "keyboard:", has)

    def __call__(self, begin, *steps):
        """begin() opens the dialog; each step is a key (with modifiers), or a text that is typed into the entry."""
        todo, tries, over = list(steps), [0], []

        def go_on():
            w = self.window()
            if w is None or not str(self.tcl.call("focus")).startswith(w + "."):
                tries[0] += 1
                if tries[0] > 1000:
                    raise AssertionError(f"no dialog is open for {steps}")
                self.op.root.after(10, guarded)
                return
            step = todo.pop(0)
            if step == "look":
                self.describe()
            elif step == "close":
                self.tcl.eval(self.tcl.eval(f"wm protocol {w} WM_DELETE_WINDOW"))
            elif step.startswith("="):
                entry = self.texts(w, "Entry")[0]
                self.tcl.call(entry, "delete", 0, "end")
                self.tcl.call(entry, "insert", 0, step[1:])
            else:
                self.tcl.call("event", "generate", str(self.tcl.call("focus")), f"<{step}>")
            if todo:
                self.op.root.after(20, guarded)
            else:
                self.op.root.after(5000, lambda: over or self.stuck(w))
        def guarded():
            if over:
                return
            try:
                go_on()
            except Exception as e:
                print("   ", e)
                os._exit(1)
        self.op.root.after(10, guarded)
        result = begin()
        over.append(True)
        self.op.wait(0.2)
        if todo:
            print("   not reached:", todo)
        return result


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, tcl, v = op.app, op.root.tk, op.app.vars
    hand = Hand(op)
    op.power_on()
    op.home()

    def close():
        app.confirm_close()
        return bool(tcl.call("winfo", "exists", "."))
    print("close window, Return:", hand(close, "look", "Return"), "Escape:", hand(close, "Escape"), "space:",
          hand(close, "KeyPress-space", "KeyRelease-space"))

    def homing():
        before = op.stat.echo_serial_number
        tcl.call("home_joint")
        op.wait(0.1)
        return op.stat.echo_serial_number > before           # commands were sent
    print("homed already, Escape:", hand(homing, "look", "Escape"), "closed:", hand(homing, "close"), "Return:",
          hand(homing, "Return"))
    op.until(lambda: app.all_homed() and not any(j["homing"] for j in op.stat.joint), "homed again")
    op.wait(0.3)
    hand(lambda: tcl.call("home_all_joints"), "look", "Escape")

    def runs():
        tcl.call("task_run")
        op.wait(0.1)
        return any("would exceed" in m for m in op.messages())       # it started, and stopped there
    print("beyond the limits, Escape:", hand(runs, "look", "Escape"), "Tab and Return (cancel):",
          hand(runs, "Tab", "Return"))
    app.notifications.clear()
    print("looked at again:", hand(runs, "Shift-Tab", "Return", "Escape"), "run anyway:", hand(runs, "Return"))
    op.key("Escape")
    op.idle()
    op.until(lambda: op.stat.task_mode == linuxcnc.MODE_MANUAL, "manual")
    app.notifications.clear()

    app.activate_ja_widget("x")
    op.wait(0.2)
    for what, steps in (("Escape", ("look", "Escape")),
                        ("wrong, Return does nothing", ("=[1+2", "look", "Return", "look", "Escape")),
                        ("unknown", ("=nothing", "look", "Escape")), ("empty", ("=", "look", "Escape")),
                        ("no number of the language", ("=1e3", "look", "=nan", "look", "Escape")),
                        ("a decimal comma", ("=1,5", "look", "Escape")),
                        ("expression, Return", ("=[sqrt[16]+1]*2", "look", "Return")),
                        ("Alt-3, KP_Enter", ("=4", "Alt-Key-3", "KP_Enter")), ("once more", ("look", "Escape")),
                        ("Alt-1", ("Alt-Key-1", "look", "Escape"))):
        before = op.stat.g5x_offset[0]
        print(what)
        hand(lambda: tcl.call("touch_off_system"), *steps)
        op.idle()
        if op.stat.g5x_offset[0] != before:
            print("   changed:", round(op.stat.g5x_offset[0], 4))
        print("   system:", v.touch_off_system.get(), [m.split(".")[0] for m in op.messages()])
        app.notifications.clear()
    print("without a tool")
    hand(lambda: tcl.call("touch_off_tool"), "look", "Escape")
    op.key("F5")
    op.type("T1 M6 G43")
    op.idle()
    op.key("F3")
    print("tool")
    hand(lambda: tcl.call("touch_off_tool"), "look", "=12", "Return")
    op.idle()
    print("   ", app.vars.tool.get(), [m.split(".")[0] for m in op.messages()])
    print("grid")
    hand(lambda: tcl.call("set_grid_size_custom"), "look", "=1/2in", "Return")
    print("   ", v.grid_size.get())
    print("user's:", hand(lambda: app.nf_dialog((".error", "-ext", "more"), "Title", "text", "info", 1, "a", "b", "c"),
                          "look", "Tab", "Return"),
          hand(lambda: app.nf_dialog(".error", "Title", "text", "info", 0, "a", "b"), "close"))
    op.key("F5")
    op.type("G10 L2 P1 X-10 R90")
    op.idle()
    op.key("F3")
    print("float:", hand(lambda: app.prompt_float("Title", "text", 1.5, "mm"), "look", "=2*3", "Return"),
          hand(lambda: app.prompt_float("Title", "text", 1.5, "mm"), "Escape"))
    print("properties:", hand(lambda: tcl.call("gcode_properties"), "Escape"))


lib.run(script)
