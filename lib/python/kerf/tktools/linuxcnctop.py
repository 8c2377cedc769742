# SPDX-License-Identifier: GPL-2.0-or-later
"""linuxcnctop [-ini FILE] [-t]: every status value of the controller; -t prints it once on the terminal."""

import signal
import sys
import tkinter as tk
from tkinter import ttk

import linuxcnc

from .. import tkstyle
from ..language import _
from . import controller

PERIOD_MS = 100
RED_TICKS = 20          # a changed value is red for 2 s
WORDS = {
    "exec_state": {1: "error", 2: "done", 3: "motion", 4: "motion queue", 5: "io", 7: "motion and io", 8: "delay",
                   9: "system command", 10: "spindle orient"},
    "motion_mode": {1: "free", 2: "coord", 3: "teleop"},
    "interp_state": {1: "idle", 2: "reading", 3: "paused", 4: "waiting"},
    "task_state": {1: "estop", 2: "estop reset", 3: "off", 4: "on"},
    "task_mode": {1: "manual", 2: "auto", 3: "mdi"},
    "state": {1: "rcs_done", 2: "rcs_exec", 3: "rcs_error"},
    "motion_type": {0: "none", 1: "traverse", 2: "feed", 3: "arc", 4: "toolchange", 5: "probing", 6: "indexrotary"},
    "program_units": {1: "inch", 2: "mm", 3: "cm"},
    "kinematics_type": {1: "identity", 2: "forward_only", 3: "inverse_only", 4: "both"},
}
POSES = ("position", "actual_position", "g5x_offset", "g92_offset", "tool_offset", "probed_position", "dtg")
SKIPPED = {"poll", "tool_table", "axis", "joint", "gettaskfile", "toolinfo"}
JOINTS = {"joint_position", "joint_actual_position"}
EMPTY = "-"


def shown(stat, name):
    """The value as text, or None when it is not shown."""
    value = getattr(stat, name)
    if name in JOINTS and stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY:
        return None
    return text_of(stat, name, value).strip() or EMPTY


def text_of(stat, name, value):
    if name in WORDS:
        return WORDS[name].get(value, str(value))
    if name == "gcodes":
        return " ".join(f"G{c / 10:g}" for c in value[1:] if c != -1)
    if name == "mcodes":
        return " ".join(f"M{c:g}" for c in value[1:] if c != -1)
    if name in POSES:
        return " ".join("%-8.4f" % v for n, v in enumerate(value) if stat.axis_mask & (1 << n))
    if name in JOINTS:
        return " ".join("%-8.4f" % v for v in value[:stat.joints])
    if name in ("homed", "limit"):
        return " ".join(str(v) for v in value[:stat.joints])
    if name == "spindle":
        return " ".join(str(s) for s in value[:stat.spindles])
    return str(value)


def names(stat):
    return [n for n in sorted(dir(stat)) if not n.startswith("_") and n not in SKIPPED]


def terminal(stat):
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)       # linuxcnctop -t | head
    sys.stdout.reconfigure(errors="replace")            # names of files are bytes
    for name in names(stat):
        text = shown(stat, name)
        if text is not None:
            print("%-20s %-.58s" % (name, text))
    return 0


class Window:
    """One line per value; only what changes is drawn again, so that a selection stays."""

    def __init__(self, root, stat):
        self.root, self.stat, self.ticks, self.timer = root, stat, 0, None
        self.values, self.since = {}, {}
        self.names, self.seen = names(stat), {}     # seen: name -> (value, its text), of the last look
        style = self.style = tkstyle.apply(root)
        px = style.px
        root.title("LinuxCNC Status")
        self.button = ttk.Button(root, text=_("Copy All"), command=self.copy_all)
        self.button.pack(side="bottom", pady=px(6))
        self.text = tk.Text(root, wrap="none", width=84, height=40, state="disabled", relief="flat",
                            padx=px(6), pady=px(6))
        down = ttk.Scrollbar(root, command=self.text.yview)
        across = ttk.Scrollbar(root, orient="horizontal", command=self.text.xview)
        self.text.configure(yscrollcommand=down.set, xscrollcommand=across.set)
        down.pack(side="right", fill="y")
        across.pack(side="bottom", fill="x")
        self.text.pack(fill="both", expand=True)
        self.text.configure(tabs=(self.text.tk.call("font", "measure", "TkFixedFont", "0" * 22),))
        self.text.tag_configure("changed", background="#c62828", foreground="#ffffff")
        self.text.bind("<Button-1>", lambda event: self.text.focus_set())
        root.update_idletasks()
        tkstyle.centre(root, root.winfo_reqwidth(), root.winfo_reqheight(), (px(300), px(200)))
        root.protocol("WM_DELETE_WINDOW", self.close)
        self.tick()

    def copy_all(self):
        self.root.clipboard_clear()
        self.root.clipboard_append(self.text.get("1.0", "end-1c"))

    def tick(self):
        try:
            self.stat.poll()
        except linuxcnc.error:      # the controller has ended
            self.root.destroy()
            return
        self.update()
        self.timer = self.root.after(PERIOD_MS, self.tick)

    def update(self):
        """What has changed since the last look."""
        self.ticks += 1
        turned = RED_TICKS in (self.ticks - since for since in self.since.values())
        s = self.stat
        machine = s.axis_mask, s.joints, s.spindles, s.kinematics_type
        values = {name: text for name in self.names if (text := self.text_now(name, machine)) is not None}
        if values == self.values and not turned:
            return
        text = self.text
        text.configure(state="normal")
        if list(values) != list(self.values):
            text.delete("1.0", "end")
            text.insert("end", "\n".join(f"{name}\t{value}" for name, value in values.items()))
        else:
            for line, (name, value) in enumerate(values.items(), 1):
                if value != self.values[name]:
                    text.delete(f"{line}.{len(name) + 1}", f"{line}.end")
                    text.insert(f"{line}.{len(name) + 1}", value)
                    self.since[name] = self.ticks
                age = self.ticks - self.since.get(name, -RED_TICKS)
                if age == 0:
                    text.tag_add("changed", f"{line}.{len(name) + 1}", f"{line}.end")
                elif age == RED_TICKS:
                    text.tag_remove("changed", f"{line}.0", f"{line}.end")
        text.configure(state="disabled")
        self.values = values

    def text_now(self, name, machine):
        """shown(), made anew only when the value or what decides on its text is another."""
        now, seen = (getattr(self.stat, name), machine), self.seen.get(name)
        if seen is None or seen[0] != now:
            seen = self.seen[name] = now, shown(self.stat, name)
        return seen[1]

    def close(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()


def main(arguments):
    stat = controller.status("linuxcnctop", arguments)
    if "-t" in arguments:
        return terminal(stat)
    root = tkstyle.open_display("linuxcnctop", "Linuxcnctop")
    Window(root, stat)
    root.mainloop()
    return 0
