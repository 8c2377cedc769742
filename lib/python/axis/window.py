# SPDX-License-Identifier: GPL-2.0-or-later
"""The window: its widgets, their look, and what this machine does not need taken away."""

import tkinter as tk
import tkinter.ttk
from types import SimpleNamespace

import linuxcnc
from kerf.language import N_
from kerf.tree import Tree

from . import commands as command_table
from .codeview import CodeView
from .compose import ALPHA, COLOURS, plot_colours
from .dro import Readout
from .jog import Jogger, position, speed
from .keys import Keys
from .looks import SCALES, LooksPart
from .notify import WRAP_PX, Notifications
from .preview import Preview
from .settings import LETTERS, MM_PER_INCH, parse_increment
from .variables import Options

VERBS = {"Home": N_("Home"), "Unhome": N_("Unhome")}
ALL_OF = {("Home", True): N_("Home All Axes"), ("Home", False): N_("Home All Joints"),
          ("Unhome", True): N_("Unhome All Axes"), ("Unhome", False): N_("Unhome All Joints")}
CONSTANTS = {name: getattr(linuxcnc, name) for name in (
    "STATE_ESTOP", "STATE_ESTOP_RESET", "STATE_OFF", "STATE_ON", "INTERP_IDLE", "INTERP_READING", "INTERP_PAUSED",
    "INTERP_WAITING", "TRAJ_MODE_FREE", "KINEMATICS_IDENTITY")} | {
    "TASK_MODE_MANUAL": linuxcnc.MODE_MANUAL, "TASK_MODE_AUTO": linuxcnc.MODE_AUTO, "TASK_MODE_MDI": linuxcnc.MODE_MDI,
    "MAX_JOINTS": 16, "MAX_AXIS": 9}


def widget_names():
    """Names of the documented widgets and their Tk paths."""
    manual, mdi = ".pane.top.tabs.fmanual", ".pane.top.tabs.fmdi"
    names = {
        "help_window": ".keys", "about_window": ".about", "text": ".pane.bottom.t.text",
        "preview_frame": ".pane.top.right.fpreview", "numbers_text": ".pane.top.right.fnumbers.text",
        "tabs": ".pane.top.tabs", "right": ".pane.top.right",
        "mdi_history": f"{mdi}.history", "mdi_command": f"{mdi}.command", "mdi_waiting": f"{mdi}.waiting",
        "code_text": ".pane.top.gcodes", "axes": f"{manual}.axes",
        "joints": f"{manual}.joints", "jogincr": f"{manual}.jogf.jog.jogincr", "override": f"{manual}.jogf.override",
        "ajogspeed": ".pane.top.ajogspeed", "coolant": f"{manual}.coolant", "flood": f"{manual}.flood",
        "mist": f"{manual}.mist", "brake": f"{manual}.spindlef.brake", "spindlel": f"{manual}.spindlel",
        "spindlef": f"{manual}.spindlef", "spindle_ccw": f"{manual}.spindlef.ccw",
        "spindle_stop": f"{manual}.spindlef.stop", "spindle_cw": f"{manual}.spindlef.cw",
        "spindle_minus": f"{manual}.spindlef.spindleminus", "spindle_plus": f"{manual}.spindlef.spindleplus",
        "rotate": ".toolbar.rotate", "feedoverride": ".pane.top.feedoverride.foscale",
        "rapidoverride": ".pane.top.rapidoverride.foscale",
        "spinoverride": ".pane.top.spinoverride.foscale", "spinoverridef": ".pane.top.spinoverride",
        "menu_view": ".menu.view", "menu_grid": ".menu.view.grid", "menu_file": ".menu.file",
        "menu_machine": ".menu.machine", "menu_touchoff": ".menu.machine.touchoff",
        "homebutton": f"{manual}.jogf.zerohome.home", "homemenu": ".menu.machine.home",
        "unhomemenu": ".menu.machine.unhome"}
    names |= {f"view_{n}": f".toolbar.view_{n}" for n in ("z", "z2", "x", "y", "y2", "p")}
    names |= {f"axis_{c.lower()}": f"{manual}.axes.axis{c.lower()}" for c in LETTERS}
    names |= {f"joint_{n}": f"{manual}.joints.joint{n}" for n in range(CONSTANTS["MAX_JOINTS"])}
    return names


class Menu(tk.Menu):
    """A menu that Tcl made: what its entries call stays when a user's file deletes one."""

    def deletecommand(self, name):
        if name in (self._tclCommands or ()):
            super().deletecommand(name)


class WindowPart(LooksPart):
    """Part of App: builds the window."""

    def build(self):
        root, s = self.root, self.settings
        tree = Tree.find()
        self.first_look()
        tcl = root.tk
        for name, value in CONSTANTS.items():
            tcl.setvar(name, value)
        tcl.setvar("version", tree.version())
        for name, path in (("manual", "tabs.fmanual"), ("mdi", "tabs.fmdi"), ("preview", "right.fpreview"),
                           ("numbers", "right.fnumbers")):
            tcl.setvar(f"_tabs_{name}", f".pane.top.{path}")
        tcl.setvar("::axis::tcl_dir", str(tree.tcl))
        tcl.eval(command_table.CALL)
        command_table.make_command(tcl, "_", self.translate)
        command_table.make_command(tcl, "::axis::icon", self.icons.get)
        command_table.make_command(tcl, "::axis::notify_error", lambda text: self.notifications.add("error", text))
        command_table.make_command(tcl, "bgerror", self.tcl_failed)
        for name, function in {"jog_slider": lambda x: self.slider("jog", x),
                               "ajog_slider": lambda x: self.slider("ajog", x),
                               "maxvel_slider": lambda x: self.slider("maxvel", x), "raised_manual": self.tab_raised,
                               "raised_mdi": self.tab_raised,
                               "can_undo": lambda: int(self.undo_lines is not None),
                               "dark_theme": lambda: self.set_dark(self.vars.dark_theme.get()),
                               "large_touch_targets": lambda: self.set_touch(self.vars.large_touch_targets.get()),
                               "interface_scale": lambda: self.set_scale(self.vars.interface_scale.get())}.items():
            command_table.make_command(tcl, f"::axis::{name}", self.guarded(function))
        command_table.make_command(tcl, "val2vel", lambda value, top=1.0: "%g" % speed(float(value), float(top)))
        tcl.eval(f"source {{{tree.tcl}/axis.tcl}}")
        tcl.eval("::axis::build")
        self.widgets = SimpleNamespace()
        for name, path in widget_names().items():
            setattr(self.widgets, name,
                    root.nametowidget(path) if path in root.children or self.known(path) else self.wrap(path))
        self.text = self.widgets.text
        self.code = CodeView(self.text, self.wrap(".pane.bottom.t.sb"))
        self.notifications = Notifications(root, self.errors_shown, self.style.px(WRAP_PX))
        self.jogger = Jogger(self)
        self.restore()
        self.logger = linuxcnc.positionlogger(linuxcnc.stat(), *plot_colours(COLOURS, ALPHA), s.geometry, s.foam)
        self.options = Options(self.vars, cone_size=self.cone_size(),
                               cone_scaling=not s.flag("DISPLAY", "DISABLE_CONE_SCALING"),
                               min_tool_diameter=s.real(("DISPLAY", "GCODE_VIEW_TOOL_MIN_DIA"), default=0.0))
        self.preview = Preview(self.widgets.preview_frame, s, self.options, self.logger, self.letters_px())
        self.preview.pack(fill="both", expand=True)
        linuxcnc.gui_respect_offsets(s.coordinates, int("!" in s.geometry))
        reason = self.preview.show_with(self.probe.result())
        if reason:
            print(f"axis: the preview is drawn without OpenGL: {reason}")
        self.preview.on_select = self.set_highlight_line
        self.readout = Readout(s)
        self.TclCommands = command_table.make(self)
        self.commands = self.TclCommands(root)
        self.adapt_widgets()
        self.fill_menus()
        self.bind_text()
        self.keys = Keys(self)
        root.protocol("WM_DELETE_WINDOW", self.confirm_close)
        for name in ("task_state", "interp_state", "taskfile", "task_paused", "highlight_line", "task_mode",
                     "motion_mode", "tool", "spindledir", "on_any_limit", "queued_mdi_commands", "block_delete",
                     "optional_stop", "has_ladder", "has_editor", "kinematics_type", "max_queued_mdi_commands"):
            getattr(self.vars, name).trace_add("write", self.state_changed)
        self.vars.jogincrement.trace_add("write", self.increment_chosen)
        for kind in ("jog", "ajog", "maxvel"):   # user code may move the sliders by their variables
            getattr(self.vars, f"{kind}_slider_val").trace_add("write", lambda *_, k=kind: self.slider_moved(k))
        self.state_pending = False
        self.state_changed()

    def known(self, path):
        try:
            self.root.nametowidget(path)
            return True
        except KeyError:
            return False

    def wrap(self, path):
        """A Python object for a widget that Tcl made."""
        kinds = {"Text": tk.Text, "Button": tk.Button, "Radiobutton": tk.Radiobutton, "Checkbutton": tk.Checkbutton,
                 "Entry": tk.Entry, "Listbox": tk.Listbox, "Scrollbar": tk.Scrollbar, "Scale": tk.Scale,
                 "Menu": Menu, "Label": tk.Label, "Toplevel": tk.Toplevel,
                 "TCombobox": tkinter.ttk.Combobox}
        kind = kinds.get(self.root.tk.eval(f"winfo class {path}"), tk.Frame)
        widget = kind.__new__(kind)
        parent, _, name = path.rpartition(".")
        widget.master = self.root
        widget.tk, widget._w, widget._name, widget.children = self.root.tk, path, name, {}
        widget.destroy = lambda: self.root.tk.call("destroy", path)      # axis.tcl: out of sight, no more
        if parent:
            holder = self.root
            for part in parent.strip(".").split("."):
                if part not in holder.children:
                    frame = tk.Frame.__new__(tk.Frame)
                    frame.master, frame.tk, frame.children, frame._name = holder, self.root.tk, {}, part
                    frame._w = ("" if holder is self.root else holder._w) + "." + part
                    holder.children[part] = frame
                holder = holder.children[part]
            widget.master = holder
            holder.children.setdefault(name, widget)
        else:
            self.root.children.setdefault(name, widget)
        return widget

    def restore(self):
        """Variables from preferences, settings and the present status."""
        v, s, p = self.vars, self.settings, self.prefs
        for name in ("show_program", "show_rapids", "show_live_plot", "show_tool", "show_extents", "show_offsets",
                     "show_machine_limits", "show_machine_speed"):
            getattr(v, name).set(p.getpref(name, True))
        for name in ("program_alpha", "show_distance_to_go", "dro_large_font", "tto_g11"):
            getattr(v, name).set(p.getpref(name, False))
        if self.stat.num_extrajoints:
            v.show_offsets.set(False)
        v.grid_size.set(p.getpref("grid_size", 0.0, float))
        for name in ("dark_theme", "large_touch_targets"):
            getattr(v, name).set(p.getpref(name, False))
        v.interface_scale.set(p.getpref("interface_scale", 0.0, float))
        v.block_delete.set(p.getpref("block_delete", True))
        v.optional_stop.set(p.getpref("optional_stop", True))
        v.emcini.set(s.ini_path)
        v.machine.set(s.machine)
        v.trajcoordinates.set(s.coordinates)
        v.metric.set(int(s.metric))
        v.coord_type.set(int(s.relative))
        v.display_type.set(int(s.commanded))
        v.touch_off_system.set("P0")          # the active one, until another is chosen
        v.has_editor.set(int(s.find("DISPLAY", "EDITOR") is not None))
        v.max_queued_mdi_commands.set(int(s.real(("TASK", "MDI_QUEUED_COMMANDS"), default=10)))
        v.max_speed.set(s.max_linear)
        v.max_aspeed.set(s.max_angular)
        v.max_maxvel.set(s.max_velocity)
        v.jog_speed.set(round(self.to_display(s.default_linear * 60), 6))
        v.jog_aspeed.set(round(s.default_angular * 60, 6))
        v.jog_slider_val.set(position(s.default_linear * 60, s.max_linear))
        v.ajog_slider_val.set(position(s.default_angular * 60, s.max_angular))
        v.maxvel_slider_val.set(1.0)
        v.maxvel_speed.set(round(self.to_display(s.max_velocity * 60), 6))
        v.jogincrement.set(self.translate("Continuous"))
        v.ja_rbutton.set(s.axes[0].lower())
        v.show_pyvcppanel.set(True)
        v.pane_top.set(".pane.top")
        v.pane_bottom.set(".pane.bottom")

    def adapt_widgets(self):
        """Removes what this machine does not have; ranges of the sliders."""
        s, tcl = self.settings, self.root.tk
        manual = ".pane.top.tabs.fmanual"
        for c in LETTERS:
            if c not in s.axes or (c == "Y" and s.lathe):
                tcl.call("grid", "remove", f"{manual}.axes.axis{c.lower()}")
        for j in range(CONSTANTS["MAX_JOINTS"]):
            if j >= s.joints:
                tcl.call("grid", "remove", f"{manual}.joints.joint{j}")
        self.widgets.feedoverride.configure(to=int(100 * s.max_feed_override + .5))
        self.widgets.spinoverride.configure(to=int(100 * s.max_spindle_override + .5))
        values = [self.translate("Continuous"), *s.increments]
        tcl.call(f"{manual}.jogf.jog.jogincr", "configure", "-values", values)
        if not s.has_angular():
            tcl.call("grid", "remove", ".pane.top.ajogspeed")
        if not s.has_linear():
            tcl.call("grid", "remove", ".pane.top.jogspeed")
        for name in ("z", "z2", "x", "p") if s.lathe else ("y2",):
            tcl.call("pack", "forget", f".toolbar.view_{name}")
        if s.lathe:
            tcl.call("pack", "forget", ".toolbar.rotate")
            tcl.call(".menu.view", "delete", 0, 5)
        if self.stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY:
            last = int(tcl.call(".menu.view", "index", "end"))
            tcl.call(".menu.view", "delete", last - 2, last)
        if not s.find("DISPLAY", "PYVCP"):
            tcl.call(".menu.view", "delete",
                     tcl.call("::axis::menu_entry", ".menu.view", self.translate("Show P_yVCP panel")))
        tcl.call("::axis::add_looks_menu", SCALES)
        home = N_("Home All") if s.all_sequences() else \
            N_("Home Axis") if self.stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY else N_("Home Joint")
        tcl.call("setup_widget_accel", f"{manual}.jogf.zerohome.home", self.translate(home))
        if s.all_sequences():
            self.widgets.homebutton.configure(command="home_all_joints")
        self.units_changed()

    def fill_menus(self):
        s, _ = self.settings, self.translate
        identity = self.stat.kinematics_type == linuxcnc.KINEMATICS_IDENTITY
        for menu, verb, all_command, one in ((self.widgets.homemenu, "Home", "home_all_joints", "home_joint_number"),
                                             (self.widgets.unhomemenu, "Unhome", "unhome_all_joints",
                                              "unhome_joint_number")):
            if verb == "Unhome" or s.all_sequences():
                menu.add_command(label=_(ALL_OF[verb, identity]), command=all_command)
            letters = s.trivkins_letters()
            for j in range(s.joints):
                label = self.joint_label(j, identity, letters)
                if label:
                    menu.add_command(label=f"{_(VERBS[verb])} {label}", command=f"{one} {j}")
        grid = self.widgets.menu_grid
        grid.add_radiobutton(label=_("Off"), variable="grid_size", value=0.0, command="set_grid_size 0.0")
        grid.add_command(label=_("Custom"), command="set_grid_size_custom")
        for text in s.grids:
            try:
                inches = parse_increment(text, 1.0) / MM_PER_INCH
            except ValueError as e:
                print(f"axis: [DISPLAY]GRIDS: {e}")
                continue
            grid.add_radiobutton(label=text, variable="grid_size", value=inches, command=f"set_grid_size {inches!r}")
        self.show_recent()

    def joint_label(self, j, identity, letters):
        """Text of a joint in the homing menus; None where a letter belongs to several joints."""
        if identity:
            if j >= len(letters) or self.settings.coordinates.count(letters[j]) != 1:
                return None
            return self.translate("Axis") + f"  {letters[j]}"
        sequence = self.settings.home_sequence(j)
        if sequence == "":
            return self.translate("Joint") + f" {j}"
        sync = " SYNC" if sequence.strip().startswith("-") else ""
        return self.translate("Joint %d (Sequence: %s)") % (j, f"{sequence.strip():>2s}{sync}")

    def fill_windows(self):
        from .help import ABOUT, SHIFT, help1, help2
        about, keys = self.widgets.about_window, self.widgets.help_window
        tk.Label(about, text=self.translate(ABOUT) % Tree.find().version(), justify="left", padx=16, pady=12).pack()
        tk.Button(about, text=self.translate("OK"), width=10, command=about.withdraw).pack(pady=8)
        for column, rows in enumerate((help1, help2)):
            for row, (key, text) in enumerate(rows):
                tk.Label(keys, text=self.translate(key) if key == SHIFT else key, anchor="e",
                         font="AxisBold").grid(row=row, column=2 * column, sticky="e", padx=(8, 6))
                tk.Label(keys, text=text and self.translate(text), anchor="w").grid(row=row, column=2 * column + 1, sticky="w", padx=(0, 8))

    def bind_text(self):
        t = self.text
        self.text_colours()
        t.bind("<Button-1>", lambda e: self.set_highlight_line(self.code.line_at(e.x, e.y)) or "break")
        t.bind("<Double-Button-1>", lambda e: self.set_highlight_line(-1) or "break")
        t.bind("<B1-Motion>", lambda e: "break")
        t.bind("<Button-4>", lambda e: t.yview_scroll(-2, "units") or "break")
        t.bind("<Button-5>", lambda e: t.yview_scroll(2, "units") or "break")
        # digits fill the page
        self.widgets.numbers_text.bind("<Configure>", lambda e: self.widget_signs.pop("readout", None))
        self.text_menu = tk.Menu(t, tearoff=0)
        self.text_menu.add_command(label=self.translate("Run from here"), command="task_run_line")
        t.bind("<Button-3>", lambda e: self.vars.highlight_line.get() > 0
               and self.text_menu.tk_popup(e.x_root, e.y_root))

    def cone_size(self):
        size = self.settings.real(("DISPLAY", "CONE_BASESIZE"), default=0.5)
        if 0.025 <= size <= 2.0:
            return size
        print(f"axis: [DISPLAY]CONE_BASESIZE = {size:g} is not from 0.025 to 2: 0.5 is taken")
        return 0.5
