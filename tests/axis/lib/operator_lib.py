# SPDX-License-Identifier: GPL-2.0-or-later
"""An operator in front of the AXIS screen, in virtual time.

A test is the display program of a machine: `operator_lib.run(script)` makes the screen and calls
script(Operator). Keys and clicks are Tk events; between them the screen is updated every 20 ms
of the machine's time, so a run does not depend on the speed of the computer.
"""

import os
import sys
import tkinter as tk
import traceback

import linuxcnc
from axis import dialogs
from axis.app import App
from kerf import clock

CYCLE_S = 0.02


class Operator:
    """What a test does: press, hold, click, look."""

    def __init__(self, app):
        self.app, self.root = app, app.root
        self.trouble = []
        self.root.report_callback_exception = self.failed

    def failed(self, kind, error, trace):
        if issubclass(kind, KeyboardInterrupt):
            self.app.callback_failed(kind, error, trace)
        else:
            self.trouble.append("".join(traceback.format_exception(kind, error, trace)))

    def wait(self, seconds):
        """The machine's time passes, the screen follows."""
        end = clock.now() + seconds
        while clock.now() < end:
            self.app.tick()
            self.app.look_around()
            self.root.update()
            clock.sleep(CYCLE_S)

    def until(self, condition, what, limit=60.0):
        end = clock.now() + limit
        while not condition():
            if clock.now() > end:
                raise AssertionError(f"{what}: did not happen within {limit} s; messages: {self.messages()}")
            self.wait(CYCLE_S)

    def key(self, name, widget=None, state=0):
        """A key pressed and let go, for example "F1", "r", "Home" with state 4 (Control)."""
        self.hold(name, widget, state)
        self.let_go(name, widget, state)
        self.wait(0.1)

    def hold(self, name, widget=None, state=0):
        (widget or self.root).event_generate(f"<KeyPress-{name}>", state=state)
        self.wait(CYCLE_S)

    def let_go(self, name, widget=None, state=0):
        (widget or self.root).event_generate(f"<KeyRelease-{name}>", state=state)
        self.root.update()
        self.wait(0.05)

    def click(self, path):
        """A button, by its Tk path; a disabled one does nothing."""
        self.root.tk.call(path, "invoke")
        self.wait(0.1)

    def type(self, text):
        """A line into the MDI entry, then Return."""
        entry = self.app.widgets.mdi_command
        self.app.vars.mdi_command.set(text)
        entry.event_generate("<KeyPress-Return>")
        self.wait(0.1)

    def enabled(self, path):
        return str(self.root.tk.call(path, "cget", "-state")) != "disabled"

    def messages(self):
        return [box.text for _, box in self.app.notifications.shown]

    @property
    def stat(self):
        self.app.stat.poll()
        return self.app.stat

    def position(self, i):
        return round(self.stat.actual_position[i], 4)

    def power_on(self):
        if self.stat.task_state == linuxcnc.STATE_ESTOP:
            self.key("F1")
            self.until(lambda: self.stat.task_state != linuxcnc.STATE_ESTOP, "emergency stop is reset")
        self.key("F2")
        self.until(lambda: self.stat.task_state == linuxcnc.STATE_ON, "power")

    def home(self):
        self.key("Home", state=4)
        self.until(self.app.all_homed, "homing")
        self.wait(0.2)

    def idle(self):
        self.until(lambda: self.stat.interp_state == linuxcnc.INTERP_IDLE and self.stat.inpos,
                   "end of the program", 600)

    def answer(self, index):
        """Dialogs are answered with this button, without a window."""
        def ask(root, title, question, icon, default, *buttons, extra=None, **_):
            print(f"dialog: {title}: {question.splitlines()[0]} [{buttons[index]}]", extra or "")
            return index
        dialogs.ask = ask

    def answer_touchoff(self, text, system=None):
        def wait(dialog, focus=None):
            dialog.value.set(text)
            if system and dialog.system:
                dialog.system.set(next(s for s in dialogs.SYSTEMS if s.startswith(system)))
            print(f"dialog: {dialog.window.title()}: {dialog.shown.cget('text').strip()}")
            dialog.accept()
            dialog.window.destroy()
            return dialog.result
        dialogs.Touchoff.wait = wait


def run(script):
    """Main of a display program."""
    ini = sys.argv[sys.argv.index("-ini") + 1]
    rest = [a for a in sys.argv[1:] if a not in ("-ini", ini)]
    clock.join("axis")
    root = tk.Tk(className="Axis")
    app = App(root, os.path.abspath(ini))
    operator = Operator(app)
    operator.answer(0)
    app.start(os.path.abspath(rest[0]) if rest else None)
    status = 0
    try:
        operator.wait(0.3)
        operator.until(lambda: not rest or (app.loaded_file and not app.loading), "the program is opened")
        script(operator)
    except Exception:
        traceback.print_exc(file=sys.stdout)
        status = 1
    for text in operator.trouble:
        print("TRACEBACK", text)
        status = 1
    app.close()
    root.destroy()
    sys.stdout.flush()
    os._exit(status)
