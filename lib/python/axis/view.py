# SPDX-License-Identifier: GPL-2.0-or-later
"""Widgets of the operator's screen. The view shows what it is told; bindings decide what happens."""

import tkinter as tk
from tkinter import font, ttk

INK, PAPER, LINE = "#20242b", "#f6f6f3", "#ffe08a"
GOOD, BAD, QUIET = "#1f7a3a", "#b3261e", "#5f6670"


class View:
    """All widgets, by name. Colours are told apart by text too."""

    def __init__(self, root, machine):
        self.root = root
        root.title("AXIS")
        root.minsize(800, 520)
        width, height = min(1280, root.winfo_screenwidth()), min(800, root.winfo_screenheight())
        root.geometry(f"{width}x{height}")
        style = ttk.Style(root)
        style.theme_use("clam")
        base = font.nametofont("TkDefaultFont")
        base.configure(size=max(11, height // 62))
        root.option_add("*Font", base)
        self.big = font.Font(family="DejaVu Sans Mono", size=max(20, height // 26), weight="bold")
        self.mono = font.Font(family="DejaVu Sans Mono", size=max(11, height // 64))
        style.configure("TButton", padding=(10, 8))
        style.configure("Stop.TButton", foreground=BAD)
        style.configure("State.TLabel", padding=8, anchor="center")
        self.buttons = {}
        self.tool_bar(root)
        body = ttk.PanedWindow(root, orient="horizontal")
        body.pack(fill="both", expand=True, padx=8, pady=4)
        left, right = ttk.Frame(body), ttk.Frame(body)
        body.add(left, weight=2)
        body.add(right, weight=3)
        self.readout(left, machine)
        self.jog_pad(left, machine)
        self.sliders(left, machine)
        self.program(right)
        self.mdi_line(right)
        self.status_bar(root)

    def button(self, parent, name, text, **options):
        self.buttons[name] = ttk.Button(parent, text=text, takefocus=False, **options)
        return self.buttons[name]

    def tool_bar(self, root):
        bar = ttk.Frame(root, padding=(8, 8, 8, 0))
        bar.pack(fill="x")
        for name, text in (("estop", "E-Stop  F1"), ("power", "Power  F2"), ("home", "Home all"), (None, None),
                           ("open", "Open  O"), ("run", "Run  R"), ("step", "Step  T"), ("pause", "Pause  P"),
                           ("stop", "Stop  Esc")):
            if name is None:
                ttk.Separator(bar, orient="vertical").pack(side="left", fill="y", padx=8)
                continue
            style = {"style": "Stop.TButton"} if name in ("estop", "stop") else {}
            self.button(bar, name, text, **style).pack(side="left", padx=2)

    def readout(self, parent, machine):
        self.state = ttk.Label(parent, style="State.TLabel", font=self.mono)
        self.state.pack(fill="x")
        box = ttk.LabelFrame(parent, text=f"Position ({machine.units})", padding=8)
        box.pack(fill="x")
        self.digits = {}
        for axis in machine.axes:
            row = tk.Frame(box, bg=INK)
            row.pack(fill="x", pady=1)
            tk.Label(row, text=axis, font=self.big, fg="#9fd3ff", bg=INK, width=2).pack(side="left")
            homed = tk.Label(row, font=self.mono, fg="#9fd3ff", bg=INK, width=6, anchor="w")
            homed.pack(side="left")
            value = tk.Label(row, font=self.big, fg="#ffffff", bg=INK, anchor="e")
            value.pack(side="right", padx=8)
            self.digits[axis] = (value, homed)
        self.velocity = ttk.Label(box, font=self.mono)
        self.velocity.pack(anchor="e")

    def jog_pad(self, parent, machine):
        box = ttk.LabelFrame(parent, text="Jog (hold)", padding=8)
        box.pack(fill="x", pady=8)
        self.jog_buttons = {}
        for column, axis in enumerate(machine.axes):
            box.columnconfigure(column, weight=1)
            for row, direction in ((0, 1), (1, -1)):
                b = ttk.Button(box, text=f"{axis}{'+' if direction > 0 else '−'}", width=4, takefocus=False)
                b.grid(row=row, column=column, padx=2, pady=2, sticky="ew")
                self.jog_buttons[axis, direction] = b

    def sliders(self, parent, machine):
        box = ttk.Frame(parent)
        box.pack(fill="x")
        box.columnconfigure(1, weight=1)
        self.feed, self.feed_text = self.slider(box, 0, "Feed override", 0, 100 * machine.max_feed, 100)
        self.speed, self.speed_text = self.slider(box, 1, "Jog speed", 0, machine.max_jog_speed, machine.jog_speed)

    @staticmethod
    def slider(box, row, title, low, high, value):
        ttk.Label(box, text=title).grid(row=row, column=0, sticky="w")
        scale = ttk.Scale(box, from_=low, to=high, value=value, takefocus=False)
        scale.grid(row=row, column=1, sticky="ew", padx=8, pady=4)
        text = ttk.Label(box, width=12, anchor="e")
        text.grid(row=row, column=2)
        return scale, text

    def program(self, parent):
        box = ttk.LabelFrame(parent, text="Program", padding=4)
        box.pack(fill="both", expand=True)
        self.code = tk.Text(box, font=self.mono, wrap="none", bg=PAPER, fg=INK, state="disabled", takefocus=False,
                            width=20, height=5)
        bar = ttk.Scrollbar(box, command=self.code.yview)
        self.code.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        self.code.pack(fill="both", expand=True)
        self.code.tag_configure("number", foreground=QUIET)
        self.code.tag_configure("now", background=LINE)

    def mdi_line(self, parent):
        box = ttk.Frame(parent)
        box.pack(fill="x", pady=8)
        ttk.Label(box, text="MDI  F5").pack(side="left")
        self.mdi = ttk.Entry(box, font=self.mono)
        self.mdi.pack(side="left", fill="x", expand=True, padx=8)
        self.button(box, "go", "Go").pack(side="right")

    def status_bar(self, root):
        self.message = ttk.Label(root, padding=8, anchor="w", wraplength=1100)
        self.message.pack(fill="x", side="bottom")

    # -- what is shown ---------------------------------------------------------------------

    def show_message(self, text, is_error=False):
        self.message.configure(text=text, foreground=BAD if is_error else INK)

    def show_code(self, lines):
        self.code.configure(state="normal")
        self.code.delete("1.0", "end")
        for number, line in enumerate(lines, 1):
            self.code.insert("end", f"{number:6d}  ", "number", line.rstrip("\n") + "\n")
        self.code.configure(state="disabled")

    def show_line(self, number):
        self.code.tag_remove("now", "1.0", "end")
        if number > 0:
            self.code.tag_add("now", f"{number}.0", f"{number + 1}.0")
            self.code.see(f"{number}.0")

    def enable(self, name, on):
        self.buttons[name].state(["!disabled" if on else "disabled"])
