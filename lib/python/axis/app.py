# SPDX-License-Identifier: GPL-2.0-or-later
"""The AXIS screen: start-up in the documented order, modes, offsets, overrides."""

import getopt
import math
import os
import signal
import subprocess
import sys
import threading
import tkinter as tk
import traceback

import linuxcnc
from kerf import clock, gl, language, process, tkstyle
from kerf.failures import Recorder
from kerf.language import N_
from kerf.screen_record import Record
from kerf.tktools import ngcgui_tabs
from kerf.tree import Tree

from . import dialogs, program, remote
from .dro import SYSTEMS
from .estimate import Estimate
from .follow import OPTIONS, FollowPart
from .jog import SLIDER_LEAST, SLIDER_STEP, position, speed
from .opening import OpeningPart
from .panels import PanelsPart
from .pins import PinsPart
from .prefs import Preferences
from .settings import LETTERS, MM_PER_INCH, SettingsError, parse_increment, read
from .takeup import TakeUpPart
from .touchoff import G21_ACTIVE, Checker, brackets, scale_text
from .usercode import UserPart
from .variables import Variables
from .waits import Waits
from .window import WindowPart

OFTEN = ("redraw_soon", "redraw", "redraw_dro")      # not worth a note
STARTS = {"task_run", "task_run_line", "task_step", "task_resume", "task_pauseresume", "task_reverse",
          "task_forward", "send_mdi", "mdi_history_double_butt_1", "home_all_joints", "home_joint", "home_joint_number",
          "spindle", "spindle_forward_toggle", "spindle_backward_toggle", "spindle_increase", "mist", "flood",
          "mist_toggle", "flood_toggle", "brake_off", "brake",
          "set_axis_offset", "toggle_override_limits"}      # what starts something: not long after it was asked for
STATUS_TRIES = 9
CRASHED = 70             # exit status of a screen that an exception ended
MAXVEL_QUIET_S = 1.0     # after an own change the slider does not follow the status
HOMING = N_("Homing is going on: wait for its end, or stop it (Escape).")
NO_STATUS = ("A configuration error is preventing LinuxCNC from starting.\n"
             "More information may be available when running from a terminal.")


class App(WindowPart, OpeningPart, PinsPart, FollowPart, UserPart, PanelsPart, TakeUpPart):
    """One screen."""

    def __init__(self, root, ini_path):
        self.root = root
        process.give_back_memory()
        self.record = Record()
        fault = self.record.by_fault()
        self.probe = gl.Probe(f"the screen before {fault}" if fault else "")
        self.ini = linuxcnc.ini(ini_path)
        self.recorder = Recorder("axis", ini_path, Tree.find().version())
        self.former = self.record.former     # what a screen that crashed left; None: the session is new
        root.report_callback_exception = self.callback_failed
        self.settings = read(self.ini)
        self.settings.ini_path = ini_path
        nml = self.ini.find("EMC", "NML_FILE")
        if nml:
            linuxcnc.nmlfile = os.path.join(os.path.dirname(ini_path), nml)
        self.stat, self.command = linuxcnc.stat(), linuxcnc.command()
        self.errors = linuxcnc.error_channel()
        self.wait_for_status()
        self.prefs = Preferences()
        self.vars = Variables(root)
        self.translate = language._
        # what the operator chose; what task opens; a copy of that
        self.loaded_file = self.shown_file = self.kept = None
        self.is_filtered = self.loading = self.cancel_loading = False
        self.loads = 0               # so many programs were shown
        self.first_waits = True      # the program of the start is not yet opened
        self.disk_state, self.changed_on_disk, self.loaded_text, self.comparison = None, False, (0, None), None
        # what the limits are checked against, under which conditions it was read
        self.limit_path = self.limit_conditions = None
        self.limits_final = False    # another reading would find out no more
        self.joints_shown = None
        self.last_increment = None
        self.seen_maxvel = None
        self.maxvel_quiet_until = 0.0
        self.follows_maxvel = False  # the slider is moved to what the machine has
        self.picture_conditions = None   # under which the preview was made
        self.stale_since = None      # when something changed that the preview does not know
        self.select_moved = self.settings.flag("DISPLAY", "SELECT_MOVED_AXIS")
        self.own_values = {}
        self.undo_lines = None   # MDI lines that take the last touch off back
        self.children, self.told_children = [], set()
        self.tab_names = []      # components of PyVCP panels in tabs
        self.loaded = {}         # components of POSTGUI in processes of their own: name -> process
        self.writers = {}        # which pins had one when widgets were hidden
        self.place = ""          # file and line of a subroutine that runs
        self.panel = None
        self.views = []          # panels and tabs that scroll where they have no room
        self.widget_signs = {}
        self.loader = program.Loader(self.settings, self.former_folder())
        self.waits = Waits(self.prefs, ini_path, self.hal_value)
        self.estimate = Estimate(ini_path, self.waits)
        self.awake_at, self.late = clock.now(), False
        self.timed = False       # a program ran at the last look
        self.open_directory = self.settings.find("DISPLAY", "PROGRAM_PREFIX", "programs")
        self.user = {}
        self.told_faults = set()     # of update cycles
        self.last_state = None
        self.build()

    def wait_for_status(self):
        """Until task has told the number of joints. Raises SettingsError."""
        wait = 0.01
        for _ in range(STATUS_TRIES):
            try:
                self.stat.poll()
                if self.stat.joints and self.stat.kinematics_type >= linuxcnc.KINEMATICS_IDENTITY:
                    return
            except linuxcnc.error:
                pass
            clock.sleep(wait)
            wait *= 2
        raise SettingsError(NO_STATUS)

    def run_program(self, words):
        """Starts an editor or the like; one that is not there is told."""
        try:
            subprocess.Popen(words)
        except OSError as e:
            self.notifications.add("error", f"{words[0]}: {e.strerror}")

    # -- guards ----------------------------------------------------------------------------

    def guarded(self, function):
        """The function for Tcl: what goes wrong is shown to the operator, never a traceback on the screen."""
        name = getattr(function, "__name__", str(function))

        def call(*args):
            if name not in OFTEN:
                self.recorder.note(name, *args)
            if name in STARTS and self.is_late():
                self.notifications.add("info",
                                       self.translate("Not done, the screen did not get on when it was asked for: %s")
                                       % name)
                return ""
            try:
                result = function(*args)
                return "" if result is None else result
            except linuxcnc.error as e:
                self.notifications.add("error", str(e))
            except tk.TclError:
                if not self.gone():
                    raise
            except Exception as e:
                self.failed(e)
            return ""
        return call

    def failed(self, error):
        """A fault of the screen's own code or of a user's: told, reported, and nothing ends."""
        traceback.print_exc()
        path = self.recorder.write(traceback.format_exc())
        self.notifications.add("error",
                               f"{type(error).__name__}: {error}"
                               + (f"\n{self.translate('Report:')} {path}" if path else ""))

    def callback_failed(self, kind, error, trace):
        """What Tk calls for exceptions of bindings and timers."""
        if issubclass(kind, KeyboardInterrupt):      # the launcher ends the session
            self.root.destroy()
            return
        gone = self.gone()
        if gone and isinstance(error, tk.TclError):  # what still wanted to draw at the end
            return
        text = "".join(traceback.format_exception(kind, error, trace))
        print(text, file=sys.stderr)
        path = self.recorder.write(text)
        if not gone:
            self.notifications.add("error",
                                   f"{kind.__name__}: {error}"
                                   + (f"\n{self.translate('Report:')} {path}" if path else ""))

    def tcl_failed(self, text):
        """A mistake in a user's Tcl code that the code does not catch itself: told once as long as the message stands.
        The rest of a file is left out; Tk's own question would keep the keys from the operator."""
        if not any(box.text == text for _, box in self.notifications.shown):
            print(self.root.tk.getvar("::errorInfo"), file=sys.stderr)
            self.notifications.add("error", text)

    def gone(self):
        """Is the window no more?"""
        try:
            return not int(self.root.tk.call("winfo", "exists", "."))
        except tk.TclError:              # "application has been destroyed"
            return True

    def running(self):
        self.stat.poll()
        return (self.stat.task_mode in (linuxcnc.MODE_AUTO, linuxcnc.MODE_MDI)
                and self.stat.interp_state != linuxcnc.INTERP_IDLE)

    def manual_ok(self):
        """Commands by hand are possible: the machine is on and idle, or MDI has room in its queue."""
        self.stat.poll()
        s = self.stat
        if s.task_state != linuxcnc.STATE_ON:
            return False
        return s.interp_state == linuxcnc.INTERP_IDLE or \
            (s.task_mode == linuxcnc.MODE_MDI and s.queued_mdi_commands < self.vars.max_queued_mdi_commands.get())

    def jog_allowed(self):
        return self.manual_ok() and not self.running() and self.raised_tab() == "manual" and not self.refused_while_homing() and \
            self.ensure_mode(linuxcnc.MODE_MANUAL)

    def goes_on(self):
        """Something moves, or will: what a stop ends."""
        self.stat.poll()
        s = self.stat
        return s.interp_state != linuxcnc.INTERP_IDLE or not s.inpos or bool(self.jogger.running) or self.homing() or \
            any(spindle["enabled"] for spindle in s.spindle)

    def ensure_mode(self, mode, *others):
        """Brings task into the mode; True when it is there (or in one of the others)."""
        self.stat.poll()
        if self.stat.task_mode == mode or self.stat.task_mode in others:
            return True
        if self.running():
            return False
        self.command.mode(mode)
        self.command.wait_complete()
        self.stat.poll()
        return self.stat.task_mode == mode

    def set_motion_teleop(self, value):
        """Joint (0) or axis (1) motion."""
        self.stat.poll()
        teleop = self.stat.motion_mode == linuxcnc.TRAJ_MODE_TELEOP
        if bool(value) != teleop:
            self.command.teleop_enable(int(value))
            self.command.wait_complete()
            self.stat.poll()

    def all_homed(self):
        self.stat.poll()
        return all(self.stat.homed[:self.settings.joints])

    def homing(self):
        return any(j["homing"] for j in self.stat.joint[:self.settings.joints])

    def any_homing(self):
        self.stat.poll()
        if self.homing():
            print("axis: a joint is homing: wait for its end")
            return True
        return False

    def refused_while_homing(self):
        """True while a joint is homing: a jog, a program or an MDI line would end that half
        way. The operator is told."""
        homing = self.any_homing()
        if homing:
            self.notifications.drop(lambda text: text == self.translate(HOMING))
            self.notifications.add("info", self.translate(HOMING))
        return homing

    def confirm_rehome(self, text):
        return dialogs.ask(self.root, self.translate("Warning"), text, "warning", 0, self.translate("Ok"),
                           self.translate("Cancel"), escape=1) == 0

    def go_home(self, n):
        self.root.tk.call("home_joint_number", n)

    # -- units -----------------------------------------------------------------------------

    def to_display(self, value):
        """Length from machine units to the units shown."""
        mm = value / self.settings.units_per_mm
        return mm if self.vars.metric.get() else mm / MM_PER_INCH

    def to_machine(self, value):
        return (value if self.vars.metric.get() else value * MM_PER_INCH) * self.settings.units_per_mm

    def units_changed(self):
        tcl = self.root.tk
        unit = "mm/min" if self.vars.metric.get() else "in/min"
        for w in ("jogspeed", "maxvel"):
            tcl.call(f".pane.top.{w}.l1", "configure", "-text", unit)
        tcl.call(".pane.top.ajogspeed.l1", "configure", "-text", self.translate("deg/min"))
        self.slider("jog", None)
        self.seen_maxvel = None      # is shown anew

    # -- sliders ---------------------------------------------------------------------------

    def slider(self, kind, value, send=True):
        """Position 0..1 of a speed slider (None: where it is): the speed in the units shown, a minute."""
        v, s = self.vars, self.settings
        name, shown, top, start = {
            "jog": ("jog_slider_val", v.jog_speed, s.max_linear, s.default_linear),
            "ajog": ("ajog_slider_val", v.jog_aspeed, s.max_angular, s.default_angular),
            "maxvel": ("maxvel_slider_val", v.maxvel_speed, s.max_velocity, s.max_velocity)}[kind]
        x = float(getattr(v, name).get() if value is None else value)
        if 0 < x < SLIDER_LEAST:
            x = SLIDER_LEAST
        # the speed of the INI file is that, not the one of the nearest position
        exact = x > 1 - SLIDER_STEP / 2 or abs(x - position(60 * start, top)) < 0.51 * SLIDER_STEP
        units = 60 * top if x > 1 - SLIDER_STEP / 2 else 60 * start if exact else speed(x, top)
        step = abs(speed(x, top) - speed(x - SLIDER_STEP, top))
        least, most = s.min_speed(kind == "ajog") if x > 0 and kind != "maxvel" else 0.0, 60 * top
        if kind != "ajog":
            units, step, least, most = map(self.to_display, (units, step, least, most))
        if not exact and step > 0:       # digits that tell two positions apart
            units = round(units, -math.floor(math.log10(step))) or units
        units = min(most, max(units, least))
        self.show_speed(shown, units)
        if kind == "maxvel" and send:
            self.set_maxvel(self.to_machine(units) / 60)

    def slider_moved(self, kind):
        """By its variable: the hand and the keys of the screen come here, too, and user code."""
        if kind == "maxvel" and self.follows_maxvel:
            return
        before = self.vars.maxvel_speed.get()
        self.slider(kind, None, send=False)
        if kind == "maxvel" and self.vars.maxvel_speed.get() != before:
            self.slider(kind, None)

    @staticmethod
    def show_speed(variable, units):
        units = float("%.4g" % units)
        variable.set(int(units) if units.is_integer() else units)

    def set_maxvel(self, units_per_s):
        self.maxvel_quiet_until = clock.now() + MAXVEL_QUIET_S
        self.command.maxvel(units_per_s)

    def step_slider(self, name, direction):
        variable = getattr(self.vars, name)
        variable.set(min(1.0, max(SLIDER_LEAST, round(variable.get() + SLIDER_STEP * direction, 3))))
        self.slider(name.split("_")[0], variable.get())

    def set_override(self, name, percent):
        send = {"feedrate": self.command.feedrate, "rapidrate": self.command.rapidrate,
                "spindlerate": self.command.spindleoverride}
        self.own_values[name] = (percent, clock.now() + 0.5)
        self.vars.put(name, percent)
        send[name](percent / 100.0)

    def set_feedrate(self, percent):
        self.set_override("feedrate", int(percent))

    def set_rapidrate(self, percent):
        self.set_override("rapidrate", int(percent))

    def set_option(self, name, on):
        """Block delete or the optional stop, for the machine and for the next time."""
        self.prefs.putpref(name, bool(on))
        self.send_option(name, on)

    def send_option(self, name, on):
        self.own_values[name] = (on, clock.now() + 0.5)
        {"block_delete": self.command.set_block_delete, "optional_stop": self.command.set_optional_stop}[name](int(on))

    def digit(self, number, is_grave):
        if self.joints_shown:
            if number < self.settings.joints and self.manual_ok():
                self.select(str(number))
        elif is_grave:
            self.set_feedrate(0)
        else:
            percent = 10 * number if number else 100
            self.set_feedrate(min(percent, int(100 * self.settings.max_feed_override + .5)))

    # -- increments ------------------------------------------------------------------------

    def increments(self):
        return [str(text) for text in self.root.tk.splitlist(self.widgets.jogincr.cget("values"))]

    def next_increment(self, direction):
        if self.jogger.running:
            return
        all_, now = self.increments(), self.vars.jogincrement.get()
        index = all_.index(now) if now in all_ else 0
        if index == 0 and direction > 0 and self.last_increment in all_[1:]:
            index = all_.index(self.last_increment)
        else:
            index = min(len(all_) - 1, max(0 if direction > 0 else 1, index + direction))
        self.vars.jogincrement.set(all_[index])

    def continuous(self):
        if not self.jogger.running:
            self.vars.jogincrement.set(self.translate("Continuous"))

    def increment_chosen(self, *args):
        if self.vars.jogincrement.get() != self.translate("Continuous"):
            self.last_increment = self.vars.jogincrement.get()
        self.set_pin("jog.increment", self.jogger.distance())

    # -- selection -------------------------------------------------------------------------

    def selectable(self):
        """Names of joints or axes that can be selected, as they stand in COORDINATES."""
        return [str(j) for j in range(self.settings.joints)] if self.joints_shown else \
            list(self.settings.coordinates.lower())

    def activate_ja_widget(self, place, force=False):
        """Selects a letter or joint (text), or a place (number) in COORDINATES or among the
        joints; force: whatever goes on."""
        if not isinstance(place, str):
            names = self.selectable()
            if not 0 <= place < len(names) or not force and not self.manual_ok():
                return
            place = names[place]
        self.vars.ja_rbutton.set(place.lower())
        self.show_selected()

    def select(self, name):
        """Selects a letter or joint by the function that a user's file may have replaced, which knows places."""
        names, name = self.selectable(), name.lower()
        self.activate_ja_widget(names.index(name) if name in names else name, True)

    def show_selected(self):
        chosen = self.vars.ja_rbutton.get()
        for c in LETTERS.lower():
            self.set_pin(f"jog.{c}", c == chosen)

    def jog_target(self, place):
        """Letter or joint number of a jog key."""
        order = self.jog_order
        if self.joints_shown and not self.settings.lathe:
            return str(place) if place < self.settings.joints else None
        return order[place].lower() if place < len(order) else None

    def selected_joint(self):
        chosen = self.vars.ja_rbutton.get()
        if chosen.isdigit():
            return int(chosen)
        letter = chosen.upper()
        if self.stat.kinematics_type != linuxcnc.KINEMATICS_IDENTITY or self.settings.coordinates.count(letter) != 1:
            return None
        return self.settings.joint_of(letter)

    # -- tabs ------------------------------------------------------------------------------

    def raised_tab(self):
        return str(self.root.tk.call(".pane.top.tabs", "raise"))

    def pages(self, book):
        return [str(page) for page in self.root.tk.splitlist(self.root.tk.call(book, "pages"))]

    def raise_tab(self, name):
        if name not in self.pages(".pane.top.tabs"):         # a user's file has removed it
            return
        self.root.tk.call(".pane.top.tabs", "raise", name)
        if name == "mdi":
            self.widgets.mdi_command.focus_set()
            self.widgets.mdi_command.selection_range(0, "end")
        else:
            self.root.focus_set()

    def other_tab(self):
        self.raise_tab("mdi" if self.raised_tab() == "manual" else "manual")

    def tab_raised(self, *args):
        if hasattr(self, "jogger"):
            self.jogger.stop_all()
            if self.raised_tab() == "manual" and hasattr(self, "commands"):
                self.TclCommands.ensure_manual()

    def next_tab(self):
        pages = self.pages(".pane.top.right")
        now = str(self.root.tk.call(".pane.top.right", "raise"))
        if pages:
            self.root.tk.call(".pane.top.right", "raise", pages[(pages.index(now) + 1) % len(pages)]
                              if now in pages else pages[0])

    def add_tab(self, name, text):
        """A new page of the right notebook; returns the path of its frame."""
        self.root.tk.call(".pane.top.right", "insert", "end", name, "-text", text)
        return self.root.tk.call(".pane.top.right", "getframe", name)

    def lathe_view(self):
        return "y2" if self.settings.back_tool_lathe else "y"

    # -- offsets ---------------------------------------------------------------------------

    def mdi_lines(self, *lines):
        """Runs MDI lines one after the other and waits for each. False when one is refused: task told why."""
        if not self.manual_ok() or not self.ensure_mode(linuxcnc.MODE_MDI):
            return False
        for line in lines:
            self.command.mdi(line)
            if self.command.wait_complete() == linuxcnc.RCS_ERROR:
                return False
        return True

    def after_mdi(self, before):
        """Back to the mode before; with the axes of a homed machine under control again."""
        self.ensure_mode(before)
        if self.all_homed():
            self.set_motion_teleop(1)

    def active_system(self):
        """Number of the coordinate system in force, 1 to 9."""
        return self.stat.g5x_index if 1 <= self.stat.g5x_index <= 9 else 1

    def touch_off(self, tool, value=None):
        """Sets the offset of the chosen axis so that it stands at a value; asks for it when there is none."""
        s, _ = self.settings, self.translate
        letter = self.vars.ja_rbutton.get().upper()
        if not self.manual_ok() or letter not in s.axes or (tool and self.stat.tool_in_spindle <= 0):
            return
        if self.running():               # where a touch off would take place is not known before the move's end
            self.notifications.add("info", self.translate("No touch off while the machine moves."))
            return
        if self.refused_while_homing():
            return
        before, number = self.stat.task_mode, self.stat.tool_in_spindle
        metric = bool(self.vars.metric.get())
        actual = s.find(f"AXIS_{letter}", "TOUCHOFF_ACTUAL")
        self.write_parameters()
        check = Checker(s, self.loader.own_parameters("touchoff.var"))
        if value is None:
            title = _("Tool %d TouchOff") % number if tool else _("Touch Off (system)") if actual is None \
                else _("Touch Off (system ACTUAL)")
            value, system = self.prompt_touchoff(title, _("Enter %s coordinate relative to workpiece:") % letter, 0.0,
                                                 tool, self.vars.touch_off_system.get())
            if value is None:
                return
            if system:
                self.vars.touch_off_system.set(system)
        elif brackets(value):
            return
        scale = scale_text(letter, s, self.stat, metric)
        at = LETTERS.index(letter)
        if tool:
            form = 11 if self.vars.tto_g11.get() else 10
            place, find = _("Tool %d") % number, lambda: self.stat.tool_table[0][1 + at]
            old = find()
            undo = [f"G10 L1 P{number} {letter}{self.in_program_units(letter, old)}", "G43"]
            done = self.mdi_lines(f"G10 L{form} P{number} {letter.lower()}[[{value}]*{scale}]", "G43")
        else:
            if actual is not None:
                here = self.stat.actual_position[at]
                number = check(value)[0]
                value = str(number - here if actual.upper() == "MINUS" else number + here)
            system = int(self.vars.touch_off_system.get().split()[0][1:]) or self.active_system()
            place, find = SYSTEMS[system], lambda: self.system_offset(system, at)
            old = find()
            undo = [f"G10 L2 P{system} {letter}{self.in_program_units(letter, old)}"]
            done = self.mdi_lines(f"G10 L20 {self.vars.touch_off_system.get().split()[0]} "
                                  f"{letter.lower()}[[{value}]*{scale}]")
        self.after_mdi(before)
        if done:
            self.reload_file(False)
            self.stat.poll()
            self.tell_touch_off(letter, place, old, find(), undo)

    def touch_off_note(self, letter, tool):
        """What the dialog says below the question: which axis, where it stands, what would change."""
        _, at = self.translate, LETTERS.index(letter)
        angular = self.settings.axis_type(letter) == "ANGULAR"

        def shown(value):
            return "%.4f" % (value if angular else self.to_display(value))
        if tool:
            return _("%s offset of the tool now: %s") % (letter, shown(self.stat.tool_table[0][1 + at]))
        system = SYSTEMS[self.active_system()]
        return _("%s is active; its %s offset now: %s") % (system, letter, shown(self.stat.g5x_offset[at]))

    def in_program_units(self, letter, value):
        """A value of machine units as a number of the program's units."""
        if self.settings.axis_type(letter) == "ANGULAR":
            return "%.6f" % value
        mm = value / self.settings.units_per_mm
        return "%.8f" % (mm if G21_ACTIVE in self.stat.gcodes else mm / MM_PER_INCH)

    def write_parameters(self):
        """Task writes the parameter file, where it can."""
        if self.stat.interp_state == linuxcnc.INTERP_IDLE and self.stat.task_mode != linuxcnc.MODE_AUTO:
            self.command.task_plan_synch()
            self.command.wait_complete()

    def system_offset(self, system, at):
        """Offset of a coordinate system (1 to 9), machine units."""
        if system == self.active_system():
            return self.stat.g5x_offset[at]
        self.write_parameters()
        return program.parameter(self.loader.own_parameters("touchoff.var"), 5201 + 20 * system + at)

    def tell_touch_off(self, letter, place, old, new, undo):
        """Axis, old and new value as a message; the way back is kept."""
        self.undo_lines = undo
        angular = self.settings.axis_type(letter) == "ANGULAR"
        text = ["%.4f" % (v if angular else self.to_display(v)) for v in (old, new)]
        self.notifications.add("info",
                               self.translate("Touch off: %s, %s offset: before %s, now %s. Machine > Undo touch "
                                              "off takes it back.") % (place, letter, *text))
        self.root.tk.call("update_state")

    def undo_touch_off(self):
        """The offset that the last touch off replaced, once."""
        lines, self.undo_lines = self.undo_lines, None
        if lines:
            before = self.stat.task_mode
            done = self.mdi_lines(*lines)
            self.after_mdi(before)
            if done:
                self.reload_file(False)
            else:
                self.undo_lines = lines

    def custom_grid(self):
        dialog = dialogs.Touchoff(self.root, self.translate("Custom Grid"), self.translate("Enter grid size"), "", "",
                                  self.grid_value)
        answer = dialog.wait(dialog.entry)
        if answer is not None:
            self.TclCommands.set_grid_size(self.grid_value(answer[0])[0])

    def grid_value(self, text):
        try:
            default = "" if text.strip()[-1:].isalpha() else "mm" if self.vars.metric.get() else "in"
            return parse_increment(text + default, 1.0) / MM_PER_INCH, None
        except ValueError:
            return None, self.translate("Enter a length, for example 10mm or 1/2in")

    # -- spindle ---------------------------------------------------------------------------

    def spindle(self, direction):
        if not self.manual_ok() or not self.ensure_mode(linuxcnc.MODE_MANUAL):
            return
        if direction == 0:
            self.command.spindle(linuxcnc.SPINDLE_OFF)
        else:
            self.command.spindle(linuxcnc.SPINDLE_FORWARD if direction > 0 else linuxcnc.SPINDLE_REVERSE,
                                 self.settings.default_spindle_speed)

    def spindle_turns(self):
        self.stat.poll()
        return self.stat.spindle[0]["direction"] != 0

    def show(self):
        self.complete = True
        self.keep_record(True)
        self.root.deiconify()
        try:
            self.root.tk.call("send", "popimage", "destroy", ".")
        except tk.TclError:
            pass

    def confirm_close(self):
        _, text = self.translate, [self.translate("Do you really want to close LinuxCNC?")]
        if self.running():
            text.append(_("A program runs: it will be stopped."))
        if any(spindle["direction"] for spindle in self.stat.spindle[:self.stat.spindles]):
            text.append(_("A spindle turns: it will be stopped."))
        if dialogs.ask(self.root, _("Confirm Close"), "\n".join(text), "warning", 1, _("Yes"), _("No"), escape=1) == 0:
            self.root.destroy()

    # -- life ------------------------------------------------------------------------------

    def start(self, first_file):
        """Everything after the widgets, in the documented order."""
        remote.serve(self.root)
        living = self.former is not None     # a machine that others saw before: nothing of it is set anew
        self.tell_crashes(self.recorder.watch_crashes())
        if not living:
            for name in OPTIONS:
                self.send_option(name, getattr(self.vars, name).get())
        self.make_pins()
        self.make_panel()
        self.logging = threading.Thread(target=self.logger.start, args=(0.01,), daemon=True)
        self.logging.start()
        self.select(self.settings.coordinates[0])
        self.show_title()
        initial = first_file or os.environ.get("AXIS_OPEN_FILE") or self.settings.find("DISPLAY", "OPEN_FILE")
        self.preview.set_view(self.lathe_view() if self.settings.lathe else "p")
        if not living:
            for name in ("feedrate", "rapidrate", "spindlerate"):
                self.set_override(name, 100)
        ngcgui_tabs.offer(self)
        for words in self.ini.findall("DISPLAY", "TKPKG") or []:
            try:
                self.root.tk.eval(f"lappend auto_path {{{Tree.find().tcl}}}; package require {words}")
            except tk.TclError as error:
                self.notifications.add("error", f"[DISPLAY]TKPKG = {words}: {error}")
        for path in self.ini.findall("DISPLAY", "TKAPP") or []:
            try:
                self.root.tk.call("source", path)
            except tk.TclError as error:
                self.tcl_failed(f"[DISPLAY]TKAPP = {path}: {error}")
        if self.prefs.damaged:
            self.notifications.add("error",
                                   self.translate("The preferences were damaged: they begin anew. The old file is %s")
                                   % self.prefs.damaged)
        self.hide_unconnected()
        self.fit_screen()
        before = self.places()
        self.run_user_file()
        chosen = {name: value for name, value in self.places().items() if value != before[name]}
        self.fill_windows()
        self.finish_pins()
        self.start_tabs()
        self.fit_screen()
        self.put(chosen)
        self.exit_status = 0
        if living:
            self.first_waits = False
            self.take_up()
            return
        self.command.teleop_enable(0)
        self.command.wait_complete()
        self.update()
        self.poll_errors()
        self.wait_for_children(self.postgui)
        demo = initial is None
        if demo:
            initial = self.demo()
        wanted = initial.strip('"')          # OPEN_FILE = "" is none
        self.root.after(50, lambda: self.open_first(wanted and self.beside_ini(wanted), not demo))

    def open_first(self, path, addrecent):
        """The program of the start; "": none."""
        self.first_waits = False
        if path:
            self.open_file_guts(path, addrecent=addrecent)

    def demo(self):
        """A program to look at for this machine, or "" where none fits its axes."""
        for name, axes in (("lathe", "XZ"), ("mill", "XYZ")):
            if set(axes) <= set(self.settings.axes) and self.settings.lathe == (name == "lathe"):
                return os.path.join(os.path.dirname(__file__), f"demo-{name}.ngc")
        return ""

    # What other programs ask for (remote.py).

    def load(self, path):
        if self.loading:
            return remote.BUSY
        return self.TclCommands.open_file_name(path)

    def reload(self):
        if self.loading:
            return remote.BUSY
        return self.reload_file()

    def send_mdi(self, text):
        self.TclCommands.send_mdi_command(text)

    def clear_live_plot(self):
        self.preview.clear_plot()

    def quit(self):
        self.root.destroy()

    def close(self):
        self.logger.stop()
        if self.logging.is_alive():      # one that sleeps at Python's end would end it by abort()
            self.logging.join(1.0)
        self.estimate.cancel(wait=True)
        self.loader.close()
        self.recorder.close()
        self.record.remove()
        self.end_children()
        if getattr(self, "comp", None) is not None:
            self.comp.exit()


def main(argv):
    if len(argv) < 2 or argv[0] != "-ini":
        print("-ini must be first argument")
        return 1
    ini_path = os.path.abspath(argv[1])
    try:
        rest = getopt.getopt(argv[2:], "d:")[1]
    except getopt.GetoptError as e:
        print(f"axis: {e}")
        return 1
    if not os.environ.get("DISPLAY"):
        print("axis: no display (DISPLAY is not set)")
        return 1
    try:
        root = tk.Tk(className="Axis", baseName="axis")
        tkstyle.need_letters(root)
    except tk.TclError as e:
        print(f"axis: {e}", file=sys.stderr)
        return 1
    root.withdraw()
    try:
        app = App(root, ini_path)
    except (SettingsError, linuxcnc.error) as e:
        print(f"axis: {ini_path}: {e}", file=sys.stderr)
        return 1
    for warning in app.settings.warnings:
        print(f"axis: {warning}")
    root.at_interrupt = root.destroy
    tkstyle.hear_signals(root)
    try:
        app.start(os.path.abspath(rest[0]) if rest else None)
        root.mainloop()
    # the launcher ends the session; a question was open when the screen was closed
    except (KeyboardInterrupt, SystemExit):
        pass
    except BaseException:        # a crash like one of the process: the launcher starts the screen again
        if not root.interrupted:
            text = traceback.format_exc()
            print(text, file=sys.stderr, flush=True)
            app.recorder.fell(text)
            os._exit(CRASHED)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # one is enough: nothing interrupts the end
    app.close()
    return app.exit_status
