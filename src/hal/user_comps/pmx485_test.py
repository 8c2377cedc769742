#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A window that talks with a Powermax plasma cutter, to try line and cutter without HAL.

pmx485-test [PORT]
"""

import argparse
import math
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

from kerf import tkstyle
from kerf.language import _, N_
from kerf.numbertext import plain, with_point
from kerf.powermax import (ARC_HIGH, ARC_LOW, CURRENT, CURRENT_MAX, CURRENT_MIN, FAULT, MODE, PRESSURE, PRESSURE_MAX,
                           PRESSURE_MIN, SCALE, SET, Line, raw)

PROGRAM = "pmx485-test"
POLL_MS = 20            # a register each time
BAD_ANSWERS = 3         # more in a row: there is no cutter
MODES = (N_("Normal"), N_("Continuous pilot arc"), N_("Gouge"))
LIMITS = {CURRENT: (CURRENT_MIN, CURRENT_MAX), PRESSURE: (PRESSURE_MIN, PRESSURE_MAX)}
REGISTERS = (*SET, FAULT, CURRENT_MIN, CURRENT_MAX, PRESSURE_MIN, PRESSURE_MAX, ARC_LOW, ARC_HIGH)


class Cutter:
    """What is known of a cutter, one register more with each look. Raises OSError when the line is gone."""

    def __init__(self, port):
        self.line, self.values, self.next, self.bad, self.remote = Line(port), {}, 0, 0, False

    def look(self):
        register = REGISTERS[self.next]
        self.next = (self.next + 1) % len(REGISTERS)
        value = self.line.read(register)
        if value is None:
            self.bad += 1
            if self.bad > BAD_ANSWERS:
                self.values.clear()     # nothing is known
            return
        self.bad = 0
        self.values[register] = value

    def answers(self):
        return bool(self.values)

    def value(self, register):
        """In its unit; None: not known."""
        value = self.values.get(register)
        return None if value is None else value / SCALE[register]

    def arc_s(self):
        low, high = self.values.get(ARC_LOW), self.values.get(ARC_HIGH)
        return None if None in (low, high) else high << 16 | low

    def control(self, settings):
        """Remote mode with these values by register. False: the cutter did not take all."""
        self.remote = True
        return all([self.line.write(register, raw(register, value)) for register, value in settings.items()])

    def release(self):
        """The cutter's own panel rules again. False: it did not hear of it."""
        done = not self.remote or all([self.line.write(register, 0) for register in SET])
        self.remote = self.remote and not done
        return done

    def close(self):
        try:
            self.release()
        except OSError:
            pass                        # gone
        self.line.close()


def duration(seconds):
    return "" if seconds is None else f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}"


class Window:
    def __init__(self, root, port):
        import tkinter as tk
        from tkinter import ttk
        self.tk, self.ttk, self.root, self.cutter, self.timer = tk, ttk, root, None, None
        root.title(PROGRAM)
        self.style = tkstyle.apply(root)
        self.port = tk.StringVar(value=port)
        self.entries, self.labels, self.buttons = {}, {}, {}
        self.build_line()
        self.build_values()
        self.status = ttk.Label(root, anchor="w", wraplength=self.style.px(420), justify="left")
        self.status.pack(fill="x", padx=self.style.px(8), pady=self.style.px(6))
        root.resizable(False, False)
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.show()
        self.poll()

    def frame(self):
        frame = self.ttk.Frame(self.root, padding=self.style.px(8))
        frame.pack(fill="x")
        return frame

    def build_line(self):
        ttk, frame, gap = self.ttk, self.frame(), self.style.px(6)
        ttk.Label(frame, text=_("Port")).pack(side="left")
        entry = ttk.Entry(frame, textvariable=self.port, width=24)
        entry.pack(side="left", padx=gap, fill="x", expand=True)
        entry.bind("<Return>", lambda _event: self.connect())
        self.button(frame, "connect", _("Connect"), self.connect).pack(side="left")

    def build_values(self):
        ttk, frame, gap = self.ttk, self.frame(), self.style.px(6)
        for column, title in enumerate(("", _("Cutter"), _("Wanted"), _("Range"))):
            ttk.Label(frame, text=title, anchor="center").grid(row=0, column=column, sticky="ew", padx=gap)
        rows = ((MODE, _("Mode")), (CURRENT, _("Current (A)")), (PRESSURE, _("Pressure")), (FAULT, _("Fault")),
                (ARC_LOW, _("Arc time")))
        wide = max(len(_(mode)) for mode in MODES)
        for row, (register, title) in enumerate(rows, 1):
            ttk.Label(frame, text=title).grid(row=row, column=0, sticky="w", pady=self.style.px(2))
            label = ttk.Label(frame, width=wide, anchor="e", relief="sunken", style="Value.TLabel",
                              padding=self.style.px(3))
            label.grid(row=row, column=1, padx=gap)
            self.labels[register] = label
            if register not in SET:
                continue
            if register == MODE:
                entry = ttk.Combobox(frame, values=[_(mode) for mode in MODES], state="readonly", width=wide)
                entry.current(0)
            else:
                entry = ttk.Entry(frame, justify="right", width=10)
                entry.insert(0, "0" if register == PRESSURE else "")
            entry.grid(row=row, column=2, sticky="ew", padx=gap)
            self.entries[register] = entry
            self.labels["range", register] = ttk.Label(frame, width=12)
            self.labels["range", register].grid(row=row, column=3)
        buttons = ttk.Frame(frame)
        buttons.grid(row=len(rows) + 1, column=0, columnspan=4, sticky="e", pady=(gap, 0))
        self.button(buttons, "send", _("Send"), self.send).pack(side="left", padx=gap)
        self.button(buttons, "release", _("Back to its panel"), self.release).pack(side="left")

    def button(self, parent, name, text, action):
        self.buttons[name] = self.ttk.Button(parent, text=text, command=action)
        return self.buttons[name]

    def say(self, text, bad=True):
        self.status.configure(text=text, style="Bad.TLabel" if bad else "TLabel")

    # ---- what the buttons do ----

    def connect(self):
        if self.cutter:
            self.disconnect()
            return
        try:
            self.cutter = Cutter(self.port.get())
            self.say(_("No answer yet."), False)
        except OSError as error:
            self.say(f"{self.port.get()}: {error.strerror}")
        self.show()

    def disconnect(self, text=""):
        self.cutter.close()
        self.cutter = None
        self.say(text)
        self.show()

    def wanted(self):
        """By register. Raises ValueError with what is wrong."""
        settings = {MODE: self.entries[MODE].current() + 1}
        for register, limits in LIMITS.items():
            text = self.entries[register].get().strip()
            try:
                value = float(plain(with_point(text)))
            except ValueError:
                value = math.nan
            if not math.isfinite(value):
                raise ValueError(_("%r is no number.") % text)
            low, high = map(self.cutter.value, limits)
            free = register == PRESSURE and value == 0          # the cutter chooses
            if not free and None not in (low, high) and not low <= value <= high:
                raise ValueError(_("%s must be from %g to %g.") % (text, low, high))
            settings[register] = value
        return settings

    def send(self):
        try:
            taken = self.cutter.control(self.wanted())
            self.say(_("The cutter is controlled from here.") if taken else _("The cutter did not take it."), not taken)
        except ValueError as error:
            self.say(str(error))
        except OSError as error:
            self.disconnect(error.strerror)

    def release(self):
        try:
            done = self.cutter.release()
            self.say(_("The cutter's panel rules.") if done else _("The cutter did not take it."), not done)
        except OSError as error:
            self.disconnect(error.strerror)

    def close(self):
        self.root.after_cancel(self.timer)
        if self.cutter:
            self.cutter.close()
            self.cutter = None
        self.root.destroy()

    # ---- what is shown ----

    def show(self):
        cutter = self.cutter
        self.buttons["connect"].configure(text=_("Disconnect") if cutter else _("Connect"))
        usable = "!disabled" if cutter and cutter.answers() else "disabled"
        for name in ("send", "release"):
            self.buttons[name].state([usable])
        known = cutter.value if cutter else lambda _register: None
        mode = known(MODE)
        for register in (CURRENT, PRESSURE, FAULT):
            self.set_label(register, "" if known(register) is None else f"{known(register):g}")
        named = mode is not None and 1 <= mode <= len(MODES)
        self.set_label(MODE, "" if mode is None else _(MODES[int(mode) - 1]) if named else f"{mode:g}")
        self.set_label(ARC_LOW, duration(cutter.arc_s() if cutter else None))
        for register, (low, high) in LIMITS.items():
            there = known(low) is not None and known(high) is not None
            self.set_label(("range", register), f"{known(low):g} - {known(high):g}" if there else "")

    def set_label(self, name, text):
        if self.labels[name].cget("text") != text:
            self.labels[name].configure(text=text)

    def poll(self):
        if self.cutter:
            answered = self.cutter.answers()
            try:
                self.cutter.look()
                if answered != self.cutter.answers():
                    self.say("" if self.cutter.answers() else _("The cutter does not answer."))
                self.show()
            except OSError as error:
                self.disconnect(f"{self.port.get()}: {error.strerror}")
        self.timer = self.root.after(POLL_MS, self.poll)


def main():
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Talks with a Powermax plasma cutter, without HAL.")
    parser.add_argument("port", nargs="?", default="/dev/ttyUSB0", help="serial line (%(default)s)")
    options = parser.parse_args()
    root = tkstyle.open_display(PROGRAM, "Powermax")
    tkstyle.run(root, Window(root, options.port).close)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
