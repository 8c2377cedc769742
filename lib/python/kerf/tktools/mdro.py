# SPDX-License-Identifier: GPL-2.0-or-later
"""mdro: a read-out for a machine that is moved by hand."""

import argparse
import os
import subprocess
import sys
import tkinter as tk
import tkinter.font
from tkinter import ttk

import hal

from .. import tkstyle
from ..language import _, N_
from ..numbertext import plain, with_point

PERIOD_MS = 100
SYSTEMS = 4                         # that can be set, beside the machine's own
AXES = "XYZABCUVW"
FIRST_PARAMETER, PER_SYSTEM = 5221, 20
INCH_MM = 25.4
FORMATS = {"inch": "%.4f", "mm": "%.2f"}
KEYS = ("7", "8", "9", "4", "5", "6", "1", "2", "3", "0", ".", "-", "C", "⌫", N_("Enter"))


class Readout:
    """Positions and offsets, in the units of the pins. System 0 is the machine's, whose offsets are 0."""

    def __init__(self, axes, read, unit):
        """read(i): the pin of an axis; unit: "inch" or "mm", that of the pins and at first of the display."""
        self.axes, self.read, self.pin_unit, self.unit, self.system = axes, read, unit, unit, 1
        self.offsets = [[0.0] * len(axes) for _ in range(SYSTEMS + 1)]
        self.loaded = False

    @property
    def factor(self):
        """Display units for a unit of the pins."""
        if self.unit == self.pin_unit:
            return 1.0
        return INCH_MM if self.unit == "mm" else 1 / INCH_MM

    def value(self, i):
        return (self.read(i) + self.offsets[self.system][i]) * self.factor

    def text(self, i):
        text = FORMATS[self.unit] % self.value(i)
        return text.removeprefix("-") if not float(text) else text

    def enter(self, i, value):
        """The display shows this value here. False: the machine's own system stays as it is."""
        if self.system == 0:
            return False
        self.offsets[self.system][i] = value / self.factor - self.read(i)
        return True

    def load(self, path):
        """Offsets of G54 and the following systems, from a file of parameters. Raises OSError."""
        parameters = {}
        with open(path) as file:
            for line in file:
                words = line.split()
                try:
                    parameters[int(words[0])] = float(words[1])
                except (ValueError, IndexError):
                    continue
        for system in range(1, SYSTEMS + 1):
            for i, axis in enumerate(self.axes):
                number = FIRST_PARAMETER + PER_SYSTEM * (system - 1) + AXES.index(axis)
                self.offsets[system][i] = -parameters.get(number, 0.0)
        self.loaded = True

    def names(self):
        return ["MCS"] + [f"G{53 + k}" if self.loaded else f"CS{k}" for k in range(1, SYSTEMS + 1)]


class Window:
    def __init__(self, root, readout, component, point_size):
        self.root, self.readout, self.component, self.timer = root, readout, component, None
        style = self.style = tkstyle.apply(root)
        px = style.px
        root.title("mdro")
        font = tkinter.font.Font(root, family="DejaVu Sans Mono", size=-px(round(point_size * 4 / 3)))
        self.font = font
        ttk.Style(root).configure("Readout.TButton", font=font, padding=px(2))
        box = ttk.Frame(root, padding=px(8))
        box.pack(fill="both", expand=True)
        self.values, self.entries, self.buttons = [], [], []
        for i, axis in enumerate(readout.axes):
            ttk.Label(box, text=axis, font=font).grid(row=i, column=0, padx=px(4))
            value = ttk.Label(box, width=11, anchor="e", font=font, relief="sunken",
                              background=style.colours["field"], padding=px(3))
            value.grid(row=i, column=1, sticky="ew", padx=px(4), pady=px(2))
            row = {}
            for column, (text, action) in enumerate((("0", lambda i=i: self.enter(i, 0.0)),
                                                     ("1/2", lambda i=i: self.enter(i, readout.value(i) / 2))), 2):
                row[text] = ttk.Button(box, text=text, width=4, style="Readout.TButton", command=action,
                                       takefocus=False)
                row[text].grid(row=i, column=column, padx=px(2))
            entry = ttk.Entry(box, width=9, font=font, justify="right")
            entry.grid(row=i, column=4, sticky="ew", padx=px(4))
            for key in ("<Return>", "<KP_Enter>"):
                entry.bind(key, lambda event, i=i: self.typed(i))
            row["I"] = ttk.Button(box, text="I", width=2, style="Readout.TButton", command=lambda i=i: self.index(i),
                                  takefocus=False)
            row["I"].grid(row=i, column=5, padx=px(2))
            box.rowconfigure(i, weight=1)
            self.values.append(value)
            self.entries.append(entry)
            self.buttons.append(row)
        box.columnconfigure(1, weight=1)
        self.active = 0
        for i, entry in enumerate(self.entries):
            entry.bind("<FocusIn>", lambda event, i=i: setattr(self, "active", i))
        self._keypad(box)
        self._choices(box, len(readout.axes))
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.tick()

    def _keypad(self, box):
        pad = ttk.Frame(box)
        pad.grid(row=0, column=6, rowspan=max(3, len(self.entries)) + 1, padx=(self.style.px(10), 0), sticky="ns")
        self.keys = {}
        for n, key in enumerate(KEYS):
            wide = key == "Enter"
            self.keys[key] = ttk.Button(pad, text=_(key), width=-5 if wide else 3, style="Readout.TButton",
                                        takefocus=False, command=lambda k=key: self.press(k))
            self.keys[key].grid(row=n // 3, column=n % 3, sticky="nsew", padx=1, pady=1)
            pad.rowconfigure(n // 3, weight=1)

    def _choices(self, box, row):
        px = self.style.px
        line = ttk.Frame(box, padding=(0, px(8), 0, 0))
        line.grid(row=row, column=0, columnspan=6, sticky="ew")
        self.system, self.unit = tk.IntVar(self.root, self.readout.system), tk.StringVar(self.root, self.readout.unit)
        self.radios = {}
        for k, name in enumerate(self.readout.names()):
            self.radios[name] = ttk.Radiobutton(line, text=name, value=k, variable=self.system, command=self.choose,
                                                takefocus=False)
            self.radios[name].pack(side="left", padx=px(3))
        for unit in reversed((N_("inch"), "mm")):
            self.radios[unit] = ttk.Radiobutton(line, text=_(unit), value=unit, variable=self.unit, command=self.choose,
                                                takefocus=False)
            self.radios[unit].pack(side="right", padx=px(3))
        self.choose()

    def choose(self):
        self.readout.system, self.readout.unit = self.system.get(), self.unit.get()
        state = "disabled" if self.readout.system == 0 else "normal"
        for row, entry in zip(self.buttons, self.entries):
            entry.configure(state=state)
            for text in ("0", "1/2"):
                row[text].configure(state=state)
        self.show()

    def enter(self, i, value):
        self.readout.enter(i, value)
        self.show()

    def typed(self, i):
        """The entry's number becomes the position; a wrong one stays, red."""
        entry = self.entries[i]
        try:
            value = float(with_point(plain(entry.get())))
        except ValueError:
            entry.configure(foreground=self.style.colours["bad"])
            return
        entry.configure(foreground=self.style.colours["ink"])
        entry.delete(0, "end")
        self.enter(i, value)

    def press(self, key):
        """A key of the pad, for the entry that was clicked last."""
        entry = self.entries[self.active]
        if str(entry.cget("state")) == "disabled":
            return
        if key == "Enter":
            self.typed(self.active)
        elif key == "C":
            entry.delete(0, "end")
        elif key == "⌫":
            entry.delete(len(entry.get()) - 1, "end")
        else:
            entry.insert("end", key)
        entry.configure(foreground=self.style.colours["ink"]) if key != "Enter" else None

    def index(self, i):
        """The next index pulse of the encoder sets the pin to 0."""
        self.component[f"index-enable.{i}"] = True
        self.show()

    def show(self):
        for i, value in enumerate(self.values):
            value.configure(text=self.readout.text(i))
            self.buttons[i]["I"].configure(state="disabled" if self.component[f"index-enable.{i}"] else "normal")

    def tick(self):
        self.show()
        self.timer = self.root.after(PERIOD_MS, self.tick)

    def close(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()


def options(arguments):
    p = argparse.ArgumentParser(prog="mdro", description="Read-out for a machine that is moved by hand.",
                                allow_abbrev=False)
    p.add_argument("-v", "--verbose", action="count", default=0)
    p.add_argument("-p", "--point_size", type=int, default=20, metavar="POINT", help="size of the letters (20)")
    p.add_argument("-m", "--mm", action="store_true", help="the pins are in mm (else inch)")
    p.add_argument("-l", "--load_cs", metavar="FILE.var", help="offsets of G54 to G57 from a file of parameters")
    p.add_argument("-ini", "--ini", metavar="FILE",
                   help="[DISPLAY]GEOMETRY, MDRO_VAR_FILE, POINT_SIZE, MM; [HAL]POSTGUI_HALFILE")
    p.add_argument("axes", nargs="?", default="XYZ", metavar="AXES", help="letters (XYZ)")
    return p.parse_args(arguments)


def take_ini(o, ini):
    """The INI file's values go before the command line's."""
    o.axes = ini.find("DISPLAY", "GEOMETRY") or o.axes
    o.load_cs = ini.find("DISPLAY", "MDRO_VAR_FILE") or o.load_cs
    o.point_size = int(ini.find("DISPLAY", "POINT_SIZE") or o.point_size)
    o.mm = (ini.find("DISPLAY", "MM") or str(int(o.mm))) not in ("0", "")


def run_postgui(ini_path, files):
    for name in files:
        program = ["haltcl", "-i", ini_path] if name.split()[0].endswith(".tcl") else ["halcmd", "-i", ini_path, "-f"]
        status = subprocess.run(program + name.split()[:1], stdin=subprocess.DEVNULL).returncode
        if status:
            print(f"mdro: {name}: status {status}", file=sys.stderr)


def main(arguments):
    o = options(arguments)
    import linuxcnc
    files = []
    try:
        if o.ini:
            ini = linuxcnc.ini(o.ini)
            take_ini(o, ini)
            files = ini.findall("HAL", "POSTGUI_HALFILE")
        linuxcnc.stat().poll()
    except (linuxcnc.error, ValueError) as error:
        print(f"mdro: Linuxcnc interface aborted\n{error}", file=sys.stderr)
        return 1
    axes = [c for c in o.axes.upper() if c in AXES]
    if not axes:
        print(f"mdro: '{o.axes}': axes are letters of {AXES}", file=sys.stderr)
        return 1
    root = tkstyle.open_display("mdro", "Mdro")
    component = hal.component("mdro")
    for i in range(len(axes)):
        component.newpin(f"axis.{i}", hal.HAL_FLOAT, hal.HAL_IN)
        component.newpin(f"index-enable.{i}", hal.HAL_BIT, hal.HAL_IO)
    component.ready()
    if o.verbose:
        print(f"mdro: axes {''.join(axes)}, {'mm' if o.mm else 'inch'}, offsets from {o.load_cs or 'no file'}, "
              f"HAL files {files}")
    if o.ini:
        run_postgui(os.path.abspath(o.ini), files)
    readout = Readout(axes, lambda i: component[f"axis.{i}"], "mm" if o.mm else "inch")
    if o.load_cs:
        try:
            readout.load(o.load_cs)
        except OSError as error:
            print(f"mdro: {o.load_cs}: {error.strerror}", file=sys.stderr)
    Window(root, readout, component, o.point_size)
    root.mainloop()
    component.exit()
    return 0
