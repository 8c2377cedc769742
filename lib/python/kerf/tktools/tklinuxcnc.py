# SPDX-License-Identifier: GPL-2.0-or-later
"""tklinuxcnc: a small screen for a machine, worked by keys and menus."""

import os
import subprocess
import sys
import tkinter as tk
import tkinter.font
from pathlib import Path
from tkinter import filedialog, messagebox, simpledialog, ttk

import linuxcnc

from .. import tkstyle
from ..language import _, N_
from ..tree import Tree
from .machine import Jog, Machine
from .tklinuxcnc_popups import Popups
from .widgets import put

TITLE = "TkLinuxCNC"
RELEASE_MS = 40             # a key that repeats is let go and pressed again within this time
STATES = {linuxcnc.STATE_ESTOP: _("ESTOP"), linuxcnc.STATE_ESTOP_RESET: _("ESTOP RESET"), linuxcnc.STATE_OFF: _("OFF"),
          linuxcnc.STATE_ON: _("ON")}
MODES = {linuxcnc.MODE_MANUAL: _("MANUAL"), linuxcnc.MODE_AUTO: _("AUTO"), linuxcnc.MODE_MDI: "MDI"}
SHOWN = {"estop": STATES.values(), "mist": (_("MIST ON"), _("MIST OFF")),
         "spindle": (_("SPINDLE FORWARD"), _("SPINDLE REVERSE"), _("SPINDLE OFF")),
         "brake": (_("BRAKE ON"), _("BRAKE OFF")), "flood": (_("FLOOD ON"), _("FLOOD OFF")), "mode": MODES.values()}
CONTINUOUS = _("continuous")
TYPING = ("Entry", "TEntry", "Text", "TCombobox")
JOG_KEYS = {"Left": ("X", -1), "Right": ("X", 1), "Down": ("Y", -1), "Up": ("Y", 1), "Next": ("Z", -1),
            "Prior": ("Z", 1)}


class Window:
    def __init__(self, root, machine):
        self.root, self.m, self.timer, self.releases, self.loaded, self.shown_line = root, machine, None, {}, None, 0
        style = self.style = tkstyle.apply(root)
        root.title(f"{TITLE}: {machine.ini.find('EMC', 'MACHINE') or ''}")
        self.jog = Jog(machine)
        self.popups = Popups(self)
        self._variables()
        self._menus()
        self._state_row()
        body = ttk.Frame(root, padding=style.px(6))
        body.pack(fill="x")
        self._readout(body)
        self._manual(body)
        self._mdi()
        self._program()
        self._keys()
        root.update_idletasks()
        tkstyle.centre(root, max(style.px(760), root.winfo_reqwidth()), max(style.px(640), root.winfo_reqheight()),
                       (style.px(560), style.px(420)))
        root.protocol("WM_DELETE_WINDOW", self.exit)
        self.tick()

    # -- parts --------------------------------------------------------------------------

    def _variables(self):
        find = self.m.ini.find
        self.relative = tk.IntVar(self.root, (find("DISPLAY", "POSITION_OFFSET") or "RELATIVE").upper() == "RELATIVE")
        self.actual = tk.IntVar(self.root, (find("DISPLAY", "POSITION_FEEDBACK") or "ACTUAL").upper() == "ACTUAL")
        self.world = tk.IntVar(self.root, 1)
        self.units = tk.StringVar(self.root, "auto")
        self.joints = None      # rows are joints
        self.was_homed = False
        self.selected = tk.IntVar(self.root, 0)
        self.incremental = tk.StringVar(self.root, CONTINUOUS)
        self.linear, self.angular = (tk.DoubleVar(self.root, self.m.linear_speed),
                                     tk.DoubleVar(self.root, self.m.angular_speed))
        self.optional_stop, self.override = tk.BooleanVar(self.root), tk.BooleanVar(self.root)
        self.balloons = tk.BooleanVar(self.root,
                                      (find("DISPLAY", "BALLOON_HELP") or "0").lower() in ("1", "yes", "true", "on"))

    def _menus(self):
        bar = tk.Menu(self.root)
        self.root.configure(menu=bar)
        self.menus = {}
        ini = str(self.m.path)
        run = self.run_program
        entries = {
            N_("File"): ((N_("Open..."), self.open), (N_("Edit..."), self.edit),
                         (N_("Tool Table Editor..."), self.edit_tools),
                         (N_("Reload Tool Table"), self.m.command.load_tool_table),
                     (N_("Reset"), self.m.command.reset_interpreter), None, (N_("Exit"), self.exit)),
            N_("View"): ((N_("Offsets and Variables..."), self.popups.offsets),
                         (N_("Diagnostics..."), lambda: run("linuxcnctop", "-ini", ini)),
                     (N_("Backplot..."), self.popups.backplot)),
            N_("Settings"): ((N_("Calibration..."), lambda: run("emccalib", "-ini", ini)), (N_("Testing..."), None),
                             (N_("Debug..."), lambda: run("debuglevel", "-ini", ini)),
                         (N_("Font..."), self.choose_font)),
            N_("Units"): tuple((unit, ("unit", unit)) for unit in ("auto", "inches", "mm", "cm")),
            N_("Utilities"): ((N_("Hal Scope"), lambda: run("halscope")), (N_("Hal Meter"), lambda: run("halmeter"))),
            N_("Scripts"): ((N_("Set Coordinates"), self.popups.set_coordinates),
                            (N_("HAL Show"), lambda: run("halshow")), (N_("HAL Config"), lambda: run("halconfig"))),
            N_("Help"): ((N_("Help..."), self.help), (N_("Balloon help"), ("check", self.balloons)),
                         (N_("About..."), self.about)),
        }
        for title, lines in entries.items():
            menu = self.menus[title] = tk.Menu(bar, tearoff=False)
            bar.add_cascade(label=_(title), menu=menu, underline=0)
            for line in lines:
                if line is None:
                    menu.add_separator()
                elif isinstance(line[1], tuple) and line[1][0] == "unit":
                    menu.add_radiobutton(label=line[0], value=line[1][1], variable=self.units)
                elif isinstance(line[1], tuple):
                    menu.add_checkbutton(label=_(line[0]), variable=line[1][1])
                else:
                    menu.add_command(label=_(line[0]), command=line[1] or (lambda: None),
                                     state="normal" if line[1] else "disabled")

    def _state_row(self):
        """Buttons that show a state and change it."""
        m, px = self.m, self.style.px
        row = ttk.Frame(self.root, padding=px(6))
        row.pack(fill="x")
        self.state_buttons = {}
        choices = {
            "estop": ((N_("Estop on"), lambda: m.state(linuxcnc.STATE_ESTOP)),
                      (N_("Estop off"), lambda: m.state(linuxcnc.STATE_ESTOP_RESET)),
                      (N_("Machine on"), lambda: m.state(linuxcnc.STATE_ON)),
                      (N_("Machine off"), lambda: m.state(linuxcnc.STATE_OFF))),
            "mist": ((N_("Mist on"), lambda: m.command.mist(linuxcnc.MIST_ON)),
                     (N_("Mist off"), lambda: m.command.mist(linuxcnc.MIST_OFF))),
            "spindle": ((N_("Spindle forward"), lambda: m.spindle(1)), (N_("Spindle reverse"), lambda: m.spindle(-1)),
                        (N_("Spindle off"), lambda: m.spindle(0))),
            "brake": ((N_("Brake on"), lambda: m.command.brake(linuxcnc.BRAKE_ENGAGE)),
                      (N_("Brake off"), lambda: m.command.brake(linuxcnc.BRAKE_RELEASE))),
            "flood": ((N_("Flood on"), lambda: m.command.flood(linuxcnc.FLOOD_ON)),
                      (N_("Flood off"), lambda: m.command.flood(linuxcnc.FLOOD_OFF))),
            "mode": ((N_("Manual"), lambda: self.go(linuxcnc.MODE_MANUAL)),
                     (N_("Auto"), lambda: self.go(linuxcnc.MODE_AUTO)), ("MDI", self.go_mdi)),
        }
        for column, (name, entries) in enumerate(choices.items()):
            button = self.state_buttons[name] = ttk.Menubutton(row)
            menu = tk.Menu(button, tearoff=False)
            for text, action in entries:
                menu.add_command(label=_(text), command=action)
            button.configure(menu=menu)
            button.grid(row=0, column=column, sticky="ew", padx=px(2))
            # it stays where it is
            row.columnconfigure(column, weight=1, minsize=self.widest(button, SHOWN[name]) + 2 * px(2))
            self.balloon(button, _("Shows the state; a click changes it"))
        self.abort_button = ttk.Button(row, text=_("ABORT"), command=self.abort, takefocus=False)
        self.abort_button.grid(row=0, column=len(choices), sticky="ew", padx=px(2))

    @staticmethod
    def widest(button, texts):
        """Pixels that a button needs for the longest of the texts."""
        widths = []
        for text in texts:
            button.configure(text=text)
            widths.append(button.winfo_reqwidth())
        return max(widths)

    def _readout(self, body):
        px = self.style.px
        box = ttk.Frame(body)
        box.pack(side="left", fill="both", expand=True)
        wanted = self.m.ini.find("DISPLAY", "POSITION_FONT")
        self.font = tkinter.font.Font(self.root, family="DejaVu Sans Mono", size=-px(26), weight="bold")
        if wanted:
            try:
                self.font.configure(**tkinter.font.Font(self.root, font=wanted).actual())
                size = self.root.tk.splitlist(wanted)[1:2]
                if size and size[0].lstrip("-").isdigit():      # actual() has rounded pixels to points
                    self.font.configure(size=int(size[0]))
            except tk.TclError as error:
                print(f"tklinuxcnc: [DISPLAY]POSITION_FONT: {error}", file=sys.stderr)
        self.values, self.names = [], []
        for row in range(max(len(self.m.letters), self.m.stat.joints)):
            button = ttk.Radiobutton(box, value=row, variable=self.selected, takefocus=False)
            button.grid(row=row, column=0, sticky="w")
            value = ttk.Label(box, width=12, anchor="e", font=self.font)
            value.grid(row=row, column=1, sticky="e", padx=px(6))
            self.names.append(button)
            self.values.append(value)
        choice = ttk.Frame(box)
        choice.grid(row=0, column=2, rowspan=max(3, len(self.values)), padx=px(12), sticky="n")
        for row, (variable, off, on) in enumerate(((self.relative, _("machine"), _("relative")),
                                                   (self.actual, _("commanded"), _("actual")),
                                                   (self.world, _("joint"), _("world")))):
            for column, (text, value) in enumerate(((on, 1), (off, 0))):
                button = ttk.Radiobutton(choice, text=text, value=value, variable=variable, takefocus=False,
                                         command=self.choose_world if variable is self.world else None)
                button.grid(row=row, column=column, sticky="w")
        self.info = ttk.Label(choice, justify="left")
        self.info.grid(row=4, column=0, columnspan=2, sticky="w", pady=(px(8), 0))

    def _manual(self, body):
        px, m = self.style.px, self.m
        box = ttk.Frame(body)
        box.pack(side="right", fill="y")
        jog = ttk.Frame(box)
        jog.pack(fill="x")
        for text, direction in (("-", -1), ("+", 1)):
            button = ttk.Button(jog, text=text, width=3, takefocus=False)
            button.bind("<ButtonPress-1>", lambda event, d=direction: self.start_jog(self.selected.get(), d))
            button.bind("<ButtonRelease-1>", lambda event: self.stop_jog())
            button.pack(side="left", padx=px(2))
        self.home_button = ttk.Button(jog, text=_("Home"), command=self.home, takefocus=False)
        self.home_button.pack(side="left", padx=px(2))
        ttk.Checkbutton(jog, text=_("override limits"), variable=self.override, takefocus=False,
                        command=m.override_limits).pack(side="left", padx=px(4))
        self.increments = ttk.Combobox(box, textvariable=self.incremental, values=[CONTINUOUS] + m.increments,
                                       state="readonly", takefocus=False, width=14)
        self.increments.pack(fill="x", pady=px(4))
        # its keys jog again
        self.increments.bind("<<ComboboxSelected>>", lambda event: self.root.focus_set())
        self.scales = {}
        for name, variable, most in ((N_("Jog speed (linear)"), self.linear, m.max_linear),
                                     (N_("Jog speed (angular)"), self.angular, m.max_angular)):
            self.scales[name] = self.scale(box, name, variable, 0, most)
        self.feed, self.spindle = tk.DoubleVar(self.root, 100), tk.DoubleVar(self.root, 100)
        find = m.ini.find
        self.scales["feed"] = self.scale(box, N_("Feed override %"), self.feed, 0,
                                         100 * float(find("DISPLAY", "MAX_FEED_OVERRIDE") or 1.2),
                                         lambda v: m.command.feedrate(float(v) / 100))
        self.scales["spindle"] = self.scale(box, N_("Spindle override %"), self.spindle,
                                            100 * float(find("DISPLAY", "MIN_SPINDLE_OVERRIDE") or 0),
                                            100 * float(find("DISPLAY", "MAX_SPINDLE_OVERRIDE") or 1),
                                            lambda v: m.command.spindleoverride(float(v) / 100))

    def scale(self, parent, text, variable, low, high, command=None):
        row = ttk.Frame(parent)
        row.pack(fill="x")
        label = ttk.Label(row, width=max(26, len(_(text)) + 7))
        label.pack(side="left")
        slider = ttk.Scale(row, from_=low, to=high, variable=variable, length=self.style.px(140), command=command,
                           takefocus=False)
        slider.pack(side="right")

        def show(*_event):
            label.configure(text=f"{_(text)}: {variable.get():.0f}")
        variable.trace_add("write", show)
        show()
        return slider

    def _mdi(self):
        px = self.style.px
        row = ttk.Frame(self.root, padding=(px(6), 0))
        row.pack(fill="x")
        ttk.Label(row, text="MDI:").pack(side="left")
        self.mdi = ttk.Entry(row, font="TkFixedFont")
        self.mdi.pack(side="left", fill="x", expand=True, padx=px(6))
        for key in ("<Return>", "<KP_Enter>"):
            self.mdi.bind(key, lambda event: self.send_mdi())
        self.codes = ttk.Label(self.root, anchor="w", padding=(px(6), px(2)), style="Faint.TLabel")
        self.codes.pack(fill="x")

    def _program(self):
        px, m = self.style.px, self.m
        row = ttk.Frame(self.root, padding=px(6))
        row.pack(side="bottom", fill="x")
        self.program_buttons = {}
        for name, action in ((N_("Open"), self.open), (N_("Run"), self.run), (N_("Pause"), m.pause),
                             (N_("Resume"), m.resume), (N_("Step"), m.step), (N_("Verify"), m.verify)):
            self.program_buttons[name] = ttk.Button(row, text=_(name), command=action, takefocus=False)
            self.program_buttons[name].pack(side="left", expand=True, fill="x", padx=px(2))
        ttk.Checkbutton(row, text=_("Optional Stop"), variable=self.optional_stop, takefocus=False,
                        command=lambda: m.command.set_optional_stop(self.optional_stop.get())).pack(side="left", padx=px(4))
        self.program_label = ttk.Label(self.root, anchor="w", padding=(px(6), 0))
        self.program_label.pack(side="top", fill="x")
        box = ttk.Frame(self.root, padding=px(6))
        box.pack(fill="both", expand=True)
        self.text = tk.Text(box, height=8, wrap="none", state="disabled", takefocus=False, relief="flat")
        bar = ttk.Scrollbar(box, command=self.text.yview)
        self.text.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        self.text.pack(fill="both", expand=True)
        self.text.tag_configure("running", background=self.style.colours["select"], foreground="#ffffff")

    def balloon(self, widget, text):
        """Help beside the pointer while Balloon help is on."""
        def show(_event):
            if self.balloons.get():
                self.tip = tk.Toplevel(self.root)
                self.tip.wm_overrideredirect(True)
                ttk.Label(self.tip, text=text, relief="solid", padding=self.style.px(3)).pack()
                self.tip.geometry(f"+{widget.winfo_rootx()}+{widget.winfo_rooty() + widget.winfo_height()}")

        def hide(_event):
            if getattr(self, "tip", None):
                self.tip.destroy()
                self.tip = None
        widget.bind("<Enter>", show, add=True)
        widget.bind("<Leave>", hide, add=True)

    # -- keys ---------------------------------------------------------------------------

    def _keys(self):
        m, root = self.m, self.root
        anywhere = {"F1": m.toggle_estop, "F2": m.toggle_power, "F3": lambda: self.go(linuxcnc.MODE_MANUAL),
                    "F4": lambda: self.go(linuxcnc.MODE_AUTO), "F5": self.go_mdi, "F6": m.command.reset_interpreter,
                    "Escape": self.abort, "Alt-o": self.open, "Alt-x": self.exit,
                    "Alt-t": self.popups.tool_offset}
        for key, action in anywhere.items():
            root.bind(f"<{key}>", lambda event, a=action: self.act(a))
        root.bind("<KeyPress>", self.key_press)
        root.bind("<KeyRelease>", self.key_release)
        root.bind("<FocusOut>", lambda event: self.stop_jog())
        root.bind("<Unmap>", lambda event: self.stop_jog() if event.widget is root else None)
        self.manual_keys = {
            "F7": lambda: m.command.mist(not m.stat.mist), "F8": lambda: m.command.flood(not m.stat.flood),
            "F9": lambda: m.spindle(0 if m.stat.spindle[0]["direction"] else 1),
            "F10": lambda: m.spindle(0 if m.stat.spindle[0]["direction"] else -1),
            "b": lambda: m.command.brake(linuxcnc.BRAKE_RELEASE), "B": lambda: m.command.brake(linuxcnc.BRAKE_ENGAGE),
            "Home": self.home, "comma": lambda: self.faster(self.linear, -1, m.max_linear),
            "period": lambda: self.faster(self.linear, 1, m.max_linear),
            "semicolon": lambda: self.faster(self.angular, -1, m.max_angular),
            "apostrophe": lambda: self.faster(self.angular, 1, m.max_angular),
            "c": self.toggle_continuous, "i": self.next_increment, "grave": lambda: self.selected.set(0),
            "F11": lambda: m.command.spindle(linuxcnc.SPINDLE_DECREASE),
            "F12": lambda: m.command.spindle(linuxcnc.SPINDLE_INCREASE)}
        self.auto_keys = {"o": self.open, "r": self.run, "p": m.pause, "s": m.resume, "a": m.step, "v": m.verify}
        self.both_keys = {"at": lambda: self.actual.set(not self.actual.get()),
                          "numbersign": lambda: self.relative.set(not self.relative.get()),
                          "dollar": self.toggle_world}

    def act(self, action):
        if not isinstance(self.root.focus_get(), tk.Widget) or self.root.focus_get().winfo_toplevel() is self.root:
            action()
        return "break"

    def key_press(self, event):
        typing = event.widget.winfo_class() in TYPING and event.widget is not self.text
        if typing or event.widget.winfo_toplevel() is not self.root or event.state & 0x8C:
            return None
        key, mode = event.keysym, self.m.stat.task_mode
        pending = self.releases.pop(key, None)
        if pending:                     # the key repeats: it was never let go
            self.root.after_cancel(pending)
            return "break"
        if mode == linuxcnc.MODE_MANUAL and (jog := self.jog_of(key)):
            self.start_jog(*jog, key)
        elif mode == linuxcnc.MODE_MANUAL and key.isdigit() and int(key) < len(self.m.names(self.joints)):
            self.selected.set(int(key))
        elif mode == linuxcnc.MODE_MANUAL and (row := self.m.row_of(key.upper(), self.joints)) is not None:
            self.selected.set(row)
        elif mode == linuxcnc.MODE_AUTO and key.isdigit():
            self.m.command.feedrate((int(key) or 10) / 10)
        else:
            keys = (self.manual_keys if mode == linuxcnc.MODE_MANUAL else self.auto_keys
                    if mode == linuxcnc.MODE_AUTO else {})
            action = keys.get(key) or (self.both_keys.get(key) if mode != linuxcnc.MODE_MDI else None)
            if not action:
                return None
            action()
        return "break"

    def jog_of(self, key):
        """(row, direction) that a key jogs, or None."""
        if key in ("minus", "equal", "KP_Subtract", "KP_Add"):
            return self.selected.get(), -1 if key in ("minus", "KP_Subtract") else 1
        letter, direction = JOG_KEYS.get(key, (None, 0))
        row = self.m.row_of(letter, self.joints)
        return None if row is None else (row, direction)

    def key_release(self, event):
        """A release counts when no press of the same key follows at once: keys repeat."""
        key = event.keysym
        if key in ("F11", "F12") and self.m.stat.task_mode == linuxcnc.MODE_MANUAL:
            self.m.command.spindle(linuxcnc.SPINDLE_CONSTANT)
        if self.jog.key == key and key not in self.releases:
            self.releases[key] = self.root.after(RELEASE_MS, lambda: self.released(key))

    def released(self, key):
        self.releases.pop(key, None)
        if self.jog.key == key:
            self.stop_jog()

    # -- actions ------------------------------------------------------------------------

    def start_jog(self, row, direction, key=None):
        if self.m.stat.task_mode == linuxcnc.MODE_MANUAL:
            text = self.incremental.get()
            self.selected.set(row)
            self.jog.start(row, direction, (self.linear.get(), self.angular.get()),
                           None if text == CONTINUOUS else text, key, self.joints)

    def stop_jog(self):
        for pending in self.releases.values():
            self.root.after_cancel(pending)
        self.releases.clear()
        self.jog.stop()

    def home(self):
        self.m.home(self.selected.get(), self.joints)

    def faster(self, variable, step, most):
        variable.set(min(max(variable.get() + step * most / 20, 0), most))

    def toggle_continuous(self):
        self.incremental.set(CONTINUOUS if self.incremental.get() != CONTINUOUS or not self.m.increments
                             else self.m.increments[0])

    def next_increment(self):
        values = self.m.increments
        if values:
            now = self.incremental.get()
            self.incremental.set(values[(values.index(now) + 1) % len(values)] if now in values else values[0])

    def choose_world(self):
        self.stop_jog()
        self.m.teleop(self.world.get())

    def toggle_world(self):
        self.world.set(not self.world.get())
        self.choose_world()

    def go(self, mode):
        """Manual or auto, whose keys do not go to the MDI entry."""
        if self.m.mode(mode):
            self.root.focus_set()

    def go_mdi(self):
        self.m.mode(linuxcnc.MODE_MDI)
        self.mdi.focus_set()

    def send_mdi(self):
        text = self.mdi.get().strip()
        if text and self.m.mode(linuxcnc.MODE_MDI):
            self.m.command.mdi(text)
            self.mdi.selection_range(0, "end")

    def abort(self):
        self.stop_jog()
        self.m.command.abort()
        self.root.focus_set()

    def open(self):
        folder = os.path.expanduser(self.m.ini.find("DISPLAY", "PROGRAM_PREFIX") or ".")
        path = filedialog.askopenfilename(parent=self.root, title=_("Open"), initialdir=folder,
                                          filetypes=((_("G-code"), "*.ngc *.nc *.tap"), (_("All files"), "*")))
        if path:
            self.open_file(path)

    def open_file(self, path):
        if self.m.mode(linuxcnc.MODE_AUTO):
            self.m.command.program_open(os.path.abspath(path))
            self.m.command.wait_complete()

    def run(self):
        if self.m.stat.file and self.m.mode(linuxcnc.MODE_AUTO):
            self.m.command.auto(linuxcnc.AUTO_RUN, 0)

    def edit(self):
        if self.m.stat.file:
            self.run_program(*(self.m.ini.find("DISPLAY", "EDITOR") or "xdg-open").split(), self.m.stat.file)

    def edit_tools(self):
        table = self.m.ini.find("EMCIO", "TOOL_TABLE")
        if table:
            self.run_program(*(self.m.ini.find("DISPLAY", "TOOL_EDITOR") or "tooledit").split(),
                             str(self.m.path.parent / os.path.expanduser(table)))

    def run_program(self, *words):
        try:
            subprocess.Popen(words, stdin=subprocess.DEVNULL, cwd=self.m.path.parent, start_new_session=True)
        except OSError as error:
            messagebox.showerror(TITLE, f"{words[0]}: {error.strerror}", parent=self.root)

    def choose_font(self):
        size = simpledialog.askinteger(_("Font"), _("Height of the position's digits (pixels)"), parent=self.root,
                                       initialvalue=abs(self.font.cget("size")), minvalue=8, maxvalue=200)
        if size:
            self.font.configure(size=-size)

    def help(self):
        name = self.m.ini.find("DISPLAY", "HELP_FILE")
        path = next((p for p in (self.m.path.parent / name, Path(name)) if p.is_file()), None) if name else None
        if name and path is None:
            print(f"tklinuxcnc: [DISPLAY]HELP_FILE: there is no file {name}", file=sys.stderr)
        self.popups.text(_("Help"), path.read_text(errors="replace") if path else HELP)

    def about(self):
        messagebox.showinfo(TITLE, _("%s\nVersion %s") % (TITLE, Tree.find().version()), parent=self.root)

    # -- status -------------------------------------------------------------------------

    def tick(self):
        try:
            self.m.stat.poll()
        except linuxcnc.error:
            self.root.destroy()
            return
        self.show()
        self.m_errors()
        self.timer = self.root.after(self.m.cycle_ms, self.tick)

    def show(self):
        s, buttons = self.m.stat, self.state_buttons
        spindle = s.spindle[0]
        direction = {1: 0, -1: 1}.get(spindle["direction"], 2)
        for name, text in (("estop", STATES.get(s.task_state, "?")), ("mist", SHOWN["mist"][not s.mist]),
                           ("spindle", SHOWN["spindle"][direction]), ("brake", SHOWN["brake"][not spindle["brake"]]),
                           ("flood", SHOWN["flood"][not s.flood]), ("mode", MODES.get(s.task_mode, "?"))):
            put(buttons[name], text=text)
        self.show_rows()
        unit = self.m.unit_name(self.units.get())
        put(self.info, text=_("Units: %s\nTool: %s\nSystem: G%s")
            % (unit, s.tool_in_spindle, self.m.system_name()))
        gcodes = " ".join(f"G{c / 10:g}" for c in s.gcodes[1:] if c != -1)
        put(self.codes, text=f"{gcodes}  " + " ".join(f"M{c:g}" for c in s.mcodes[1:] if c != -1)
            + f"  F{s.settings[1]:.0f} S{s.settings[2]:.0f}")
        self.optional_stop.set(bool(s.optional_stop))
        self.override.set(self.m.limits_overridden())
        for name, variable, value in (("feed", self.feed, s.feedrate), ("spindle", self.spindle, spindle["override"])):
            if not self.scales[name].instate(["pressed"]) and abs(variable.get() - 100 * value) > 0.5:
                variable.set(100 * value)
        self.show_program()

    def follow_homing(self):
        """Rows are joints where that is chosen, or there is no other way; the end of homing leads to axes."""
        if self.m.all_homed and not self.was_homed and self.world.get():
            self.m.teleop(True)
        self.was_homed = self.m.all_homed
        joints = not self.world.get() or self.m.joints_only()
        if joints != self.joints:
            self.stop_jog()
            self.joints = joints
            self.selected.set(0)

    def show_rows(self):
        self.follow_homing()
        names, colours = self.m.names(self.joints), self.style.colours
        for row, (label, value) in enumerate(zip(self.names, self.values)):
            if row >= len(names):
                label.grid_remove()
                value.grid_remove()
                continue
            label.grid()
            value.grid()
            put(label, text=names[row])
            position = self.m.position(row, self.joints, self.relative.get(), self.actual.get(), self.units.get())
            put(value, text="%10.4f" % position,
                foreground=colours["good" if self.m.row_homed(row, self.joints) else "bad"])

    def show_program(self):
        s = self.m.stat
        status = {linuxcnc.INTERP_IDLE: N_("idle"), linuxcnc.INTERP_PAUSED: N_("paused")}.get(s.interp_state, N_("running"))
        put(self.program_label, text=_("Program: %s  -  Status: %s") % (s.file or _("none"), _(status)))
        if s.file != self.loaded:
            self.loaded = s.file
            try:
                text = Path(s.file).read_text(errors="backslashreplace") if s.file else ""
            except OSError as error:
                text = f"{s.file}: {error.strerror}"
            self.text.configure(state="normal")
            self.text.delete("1.0", "end")
            self.text.insert("end", "".join(f"{n:6d}: {line}\n" for n, line in enumerate(text.split("\n"), 1)))
            self.text.configure(state="disabled")
        line = (s.motion_line or s.current_line) if status != "idle" else 0
        if line != self.shown_line:
            self.shown_line = line
            self.text.tag_remove("running", "1.0", "end")
            if line:
                self.text.tag_add("running", f"{line}.0", f"{line + 1}.0")
                self.text.see(f"{line}.0")

    def m_errors(self):
        """What the controller says comes in a window that does not stop anything."""
        while message := self.m.errors.poll():
            self.popups.message(message[1], message[0] in (linuxcnc.OPERATOR_ERROR, linuxcnc.NML_ERROR))

    def exit(self):
        self.stop_jog()
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()


HELP = _("""F1 emergency stop        F2 machine on and off
F3 manual   F4 auto   F5 MDI   F6 reset the interpreter   Esc abort

Manual
  ` 0-9 x y z         select a joint or axis       Home     home it
  arrows, PgUp PgDn   jog X, Y, Z                  - =      jog the selected one
  , .  linear jog speed    ; '  angular jog speed
  c  continuous or by increments                   i        next increment
  F7 mist  F8 flood   F9 F10 spindle   F11 F12 slower, faster   b B brake
Auto
  1-9 0  feed override 10 to 100 %
  o open  r run  p pause  s resume  a step  v verify
Display
  @ actual or commanded    # relative or machine    $ joint or world
Any
  Alt-o open   Alt-t tool offset   Alt-x exit
""")


def source_user_file(root, machine):
    """[DISPLAY]USER_COMMAND_FILE: Tcl, with the commands of package Linuxcnc."""
    name = machine.ini.find("DISPLAY", "USER_COMMAND_FILE")
    if not name:
        return
    path = machine.path.parent / os.path.expanduser(name)
    root.tk.eval(f"lappend auto_path {{{Tree.find().tcl}}}; package require Linuxcnc")
    try:
        root.tk.call("emc_init", "-ini", str(machine.path))
        root.tk.call("source", str(path))
    except tk.TclError as error:
        messagebox.showerror(TITLE, f"{path}: {error}", parent=root)


def main(arguments):
    words = list(arguments)
    path = os.environ.get("INI_FILE_NAME")
    if "-ini" in words[:-1]:
        place = words.index("-ini")
        path = words[place + 1]
        del words[place:place + 2]
    if not path:
        print("Usage: tklinuxcnc -ini FILE [PROGRAM]", file=sys.stderr)
        return 1
    root = tkstyle.open_display("tklinuxcnc", "TkLinuxcnc")
    try:
        machine = Machine(path)
    except linuxcnc.error as error:
        print(f"tklinuxcnc: {error}: no controller is running", file=sys.stderr)
        return 1
    window = Window(root, machine)
    source_user_file(root, machine)
    if words:
        window.open_file(words[0])
    root.mainloop()
    return 0
