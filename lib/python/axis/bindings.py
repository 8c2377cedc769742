# SPDX-License-Identifier: GPL-2.0-or-later
"""Connects keys, buttons and the status to the model and the view."""

import os
import tkinter as tk
from tkinter import filedialog

import linuxcnc

from . import remote

POLL_MS = 50
RELEASE_MS = 40      # X repeats a held key as release and press: a release counts after this time


class Bindings:
    def __init__(self, root, machine, view):
        self.root, self.machine, self.view = root, machine, view
        self.pending_release = None
        self.jog_key = None
        self.shown_line = -1
        v, m = view, machine
        for name, action in (("estop", m.toggle_estop), ("power", m.toggle_power), ("home", m.home_all),
                             ("open", self.open), ("run", m.run), ("step", m.step), ("pause", m.pause_or_resume),
                             ("stop", m.abort), ("go", self.mdi)):
            v.buttons[name].configure(command=self.safely(action))
        for (axis, direction), b in v.jog_buttons.items():
            b.bind("<ButtonPress-1>", self.safely(lambda a=axis, d=direction: m.start_jog(a, d)))
            b.bind("<ButtonRelease-1>", self.safely(m.stop_jog))
        v.mdi.bind("<Return>", self.safely(self.mdi))
        v.mdi.bind("<Escape>", self.safely(lambda: root.focus_set()))
        v.feed.configure(command=lambda text: m.feed_override(float(text) / 100))
        v.speed.configure(command=lambda text: setattr(m, "jog_speed", float(text)))
        self.keys()
        root.bind("<FocusOut>", self.safely(m.stop_jog))
        root.protocol("WM_DELETE_WINDOW", self.quit)
        self.tick()

    def safely(self, action):
        """The action as a callback: a refusal becomes a message."""
        def call(*_):
            try:
                self.machine.poll()        # decide on what is true now, not on the last screen
                action()
            except linuxcnc.error as e:
                self.view.show_message(str(e), True)
        return call

    def keys(self):
        m = self.machine

        def key(name, action):
            run = self.safely(action)
            # Keys typed into the MDI line are text, not commands; function keys always work.
            self.root.bind(name, lambda e: None if len(e.keysym) == 1 and e.widget is self.view.mdi else run())
        for name, action in (("<F1>", m.toggle_estop), ("<F2>", m.toggle_power), ("<Escape>", m.abort),
                             ("<Key-r>", m.run), ("<Key-t>", m.step), ("<Key-p>", m.pause_or_resume),
                             ("<Key-s>", m.pause_or_resume), ("<Key-o>", self.open), ("<F5>", self.view.mdi.focus_set),
                             ("<Control-Home>", m.home_all)):
            key(name, action)
        for name, axis, direction in (("Right", "X", 1), ("Left", "X", -1), ("Up", "Y", 1), ("Down", "Y", -1),
                                      ("Prior", "Z", 1), ("Next", "Z", -1)):
            if axis in m.axes:
                self.root.bind(f"<KeyPress-{name}>", lambda e, a=axis, d=direction: self.press(e, a, d))
                self.root.bind(f"<KeyRelease-{name}>", self.release)

    def press(self, event, axis, direction):
        if event.widget is self.view.mdi:
            return
        if self.pending_release:
            self.root.after_cancel(self.pending_release)
            self.pending_release = None
        if self.jog_key is None:
            self.jog_key = event.keysym
            self.safely(lambda: self.machine.start_jog(axis, direction))()

    def release(self, event):
        if event.keysym == self.jog_key and not self.pending_release:
            self.pending_release = self.root.after(RELEASE_MS, self.released)

    def released(self):
        self.pending_release = self.jog_key = None
        self.safely(self.machine.stop_jog)()

    def open(self):
        folder = self.machine.ini.find("DISPLAY", "PROGRAM_PREFIX") or "."
        path = filedialog.askopenfilename(initialdir=os.path.abspath(folder),
                                          filetypes=[("G-code", "*.ngc *.nc *.tap"), ("All files", "*")])
        if path:
            self.load(path)

    def load(self, path):
        try:
            with open(path, errors="replace") as f:
                lines = f.readlines()
        except OSError as e:
            self.view.show_message(f"{path}: {e.strerror}", True)
            return
        self.safely(lambda: self.machine.open(path))()
        self.view.show_code(lines)
        self.view.show_message(path)

    # What other programs ask for (remote.py).

    def reload(self):
        if self.machine.file:
            self.load(self.machine.file)

    def send_mdi(self, text):
        if not self.machine.mdi(text):
            self.view.show_message("MDI needs the machine on, homed and idle", True)

    def clear_live_plot(self):
        """The path drawn so far goes away, where the view draws one."""
        if clear := getattr(self.view, "clear_plot", None):
            clear()

    def mdi(self):
        text = self.view.mdi.get()
        if self.machine.mdi(text):
            self.view.mdi.delete(0, "end")
        elif text.strip():
            self.view.show_message("MDI needs the machine on, homed and idle", True)

    def tick(self):
        try:
            self.machine.poll()
            self.show()
        except linuxcnc.error as e:
            self.view.show_message(f"No connection to the controller: {e}", True)
        self.root.after(POLL_MS, self.tick)

    def show(self):
        m, v, s = self.machine, self.view, self.machine.stat
        while (message := m.message()):
            v.show_message(message[1], message[0])
        v.state.configure(text=m.state_text(), foreground="#1f7a3a" if m.is_on() else "#b3261e")
        for i, axis in enumerate(m.axes):
            value, homed = v.digits[axis]
            value.configure(text=f"{m.position(axis):12.4f}" if m.units != "inch" else f"{m.position(axis):12.5f}")
            joint_homed = s.homed[i] if i < m.joints else 0
            homed.configure(text="homed" if joint_homed else "")
        v.velocity.configure(text=f"velocity {s.current_vel * 60:9.1f} {m.units}/min")
        v.feed_text.configure(text=f"{100 * s.feedrate:.0f} %")
        v.speed_text.configure(text=f"{m.jog_speed * 60:.0f} {m.units}/min")
        ready = m.is_on() and m.idle()
        for name, on in (("power", not m.estop()), ("home", ready), ("open", m.idle()),
                         ("run", ready and m.homed() and m.file), ("step", m.is_on() and m.homed() and m.file),
                         ("pause", not m.idle()), ("stop", m.is_on()), ("go", ready and m.homed())):
            v.enable(name, bool(on))
        v.buttons["pause"].configure(text="Resume  S" if m.paused() else "Pause  P")
        for b in v.jog_buttons.values():
            b.state(["!disabled" if m.can_jog() else "disabled"])
        line = s.motion_line if not m.idle() else 0
        if line != self.shown_line:
            self.shown_line = line
            v.show_line(line)

    def quit(self):
        self.safely(self.machine.stop_jog)()
        self.root.destroy()


def main(argv):
    ini_path = argv[argv.index("-ini") + 1] if "-ini" in argv else os.environ.get("INI_FILE_NAME", "")
    if not os.environ.get("DISPLAY"):
        print("axis: no display (DISPLAY is not set)")
        return 1
    from .model import Machine
    from .view import View
    root = tk.Tk(className="Axis")
    machine = Machine(ini_path)
    machine.poll()
    bindings = Bindings(root, machine, View(root, machine))
    remote.serve(root, bindings, lambda: not machine.idle())
    rest = [a for i, a in enumerate(argv) if a != "-ini" and (i == 0 or argv[i - 1] != "-ini")]
    if rest and os.path.isfile(rest[-1]):
        root.after(200, lambda: bindings.load(os.path.abspath(rest[-1])))
    root.mainloop()
    return 0
