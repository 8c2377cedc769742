# SPDX-License-Identifier: GPL-2.0-or-later
"""The user's code: ~/.axisrc or [DISPLAY]USER_COMMAND_FILE."""

import glob
import math
import os
import re
import shutil
import string
import subprocess
import sys
import time
import tkinter as tk
import traceback
from types import SimpleNamespace

import hal
import linuxcnc
from kerf.language import N_

from . import dialogs
from . import help as help_texts
from .settings import LETTERS
from .touchoff import Checker, unit_text


# functions of the screen that a user's file may replace by its own
REPLACEABLE = ("running", "manual_ok", "ensure_mode", "all_homed", "go_home", "set_motion_teleop", "activate_ja_widget",
               "open_file_guts", "reload_file", "prompt_touchoff", "set_feedrate", "set_rapidrate", "get_jog_speed")


class UserPart:
    """Part of App: what users add to the screen."""

    def run_user_file(self):
        given = self.settings.find("DISPLAY", "USER_COMMAND_FILE")
        path = os.path.expanduser(given or "~/.axisrc")
        for name in REPLACEABLE:
            vars(self).pop(name, None)
        self.user = self.user_names()
        self.given = dict(self.user)
        if not os.path.exists(path):
            if given:
                self.notifications.add("error",
                                       f"[DISPLAY]USER_COMMAND_FILE: {self.translate('%s does not exist') % path}")
            return
        try:
            with open(path) as f:
                exec(compile(f.read(), path, "exec"), self.user)
        except Exception:
            text = traceback.format_exc()
            print(text, file=sys.stderr)
            dialogs.ask(self.root, self.translate("Error in ~/.axisrc"),
                        self.translate("The error given below occurred in your ~/.axisrc; AXIS goes on "
                                       "without the rest of it."),
                        "error", 0, self.translate("OK"), extra=text)
        for name in REPLACEABLE:         # whenever the file puts its own there, at once or later
            setattr(self, name, lambda *words, n=name, **named: self.user[n](*words, **named))

    def replaced(self, name):
        """The function that a user's file has put in the place of the screen's, or None."""
        own = self.user.get(name)
        return own if own is not None and own != self.given.get(name) else None

    @property
    def jog_invert(self):
        """Letters whose keys are turned round; user code may change them at any time."""
        return str(self.user["jog_invert"]).upper() if "jog_invert" in self.user else self.settings.jog_invert()

    @property
    def jog_order(self):
        return [c for c in str(self.user["jog_order"]).upper() if c in self.settings.axes] \
            if "jog_order" in self.user else self.settings.jog_order()

    def user_names(self):
        """What the user's code finds in its globals."""
        names = dict(root_window=self.root, widgets=self.widgets, vars=self.vars, commands=self.commands,
                     TclCommands=self.TclCommands, inifile=self.ini, s=self.stat, c=self.command, e=self.errors,
                     o=self.preview, t=self.text, comp=self.comp, hal=hal,
                     linuxcnc=linuxcnc, live_plotter=SimpleNamespace(logger=self.logger, clear=self.preview.clear_plot),
                     notifications=self.notifications, ap=self.prefs, help1=help_texts.help1, help2=help_texts.help2,
                     trajcoordinates=self.settings.coordinates.lower(), num_joints=self.settings.joints,
                     lathe=int(self.settings.lathe), foam=int(self.settings.foam), jog_order="".join(self.jog_order),
                     jog_invert=self.jog_invert, loaded_file=self.loaded_file, current_tool=None,
                     set_feedrate=self.set_feedrate, set_rapidrate=self.set_rapidrate,
                     get_jog_speed=self.get_jog_speed,
                     jog_on=self.jog_on, jog_off=self.jog_off, running=self.running, manual_ok=self.manual_ok,
                     ensure_mode=self.ensure_mode, prompt_float=self.prompt_float, prompt_touchoff=self.prompt_touchoff,
                     all_homed=self.all_homed, go_home=self.go_home, set_motion_teleop=self.set_motion_teleop,
                     activate_ja_widget=self.activate_ja_widget, open_file_guts=self.open_file_guts,
                     reload_file=self.reload_file, rClicker=self.right_click_menu,
                     user_live_update=lambda: None, user_hal_pins=lambda: None, tabs_mdi=".pane.top.tabs.fmdi",
                     tabs_manual=".pane.top.tabs.fmanual", tabs_preview=".pane.top.right.fpreview",
                     tabs_numbers=".pane.top.right.fnumbers", pane_top=".pane.top", pane_bottom=".pane.bottom",
                     _=self.translate, nf_dialog=self.nf_dialog, tk=tk, Tkinter=tk, tkinter=tk)
        names |= {module.__name__: module
                  for module in (glob, math, os, re, shutil, string, subprocess, sys, time, traceback)}
        names["__name__"] = "axis"
        return names

    def get_jog_speed(self, number):
        return self.jogger.speed_of(int(number), self.jogger.joint_mode())

    def jog_on(self, number, speed_now):
        """Jogs a letter or a number, which is that of a joint or of an axis as the mode has
        it; machine units a second."""
        if isinstance(number, str) and not number.isdigit():
            name = number
        else:
            name = str(number) if self.jogger.joint_mode() else LETTERS[int(number)]
        self.jogger.start(f"user {number}", name, 1 if speed_now > 0 else -1, speed=abs(speed_now))

    def jog_off(self, number):
        owner = f"user {number}"
        if owner in self.jogger.running:
            self.jogger.stop(owner)
        elif not isinstance(number, str):        # of a jog that user code commanded itself
            self.command.jog(linuxcnc.JOG_STOP, self.jogger.joint_mode(), int(number))

    def right_click_menu(self, event):
        """Cut, copy and paste for a text or an entry."""
        widget = event.widget
        menu = tk.Menu(self.root, tearoff=0)
        for text, what in ((N_("Cut"), "<<Cut>>"), (N_("Copy"), "<<Copy>>"), (N_("Paste"), "<<Paste>>")):
            menu.add_command(label=self.translate(text), command=lambda w=what: widget.event_generate(w))
        widget.focus_set()
        menu.tk_popup(event.x_root, event.y_root)
        menu.bind("<Unmap>", lambda e: menu.after_idle(menu.destroy))
        return "break"

    def prompt_float(self, title, text, default, unit):
        """(value, None) or (None, None) when cancelled."""
        dialog = dialogs.Touchoff(self.root, title, text, default, unit,
                                  Checker(self.settings, self.loader.own_parameters("prompt.var")))
        answer = dialog.wait(dialog.entry)
        return (float(dialog.check(answer[0])[0]), None) if answer else (None, None)

    def prompt_touchoff(self, title, text, default, tool_only=False, system=None):
        """(text as typed, system) or (None, None) when cancelled."""
        checker = Checker(self.settings, self.loader.own_parameters("prompt.var"))
        letter = self.vars.ja_rbutton.get().upper()
        unit, note = (unit_text(letter, self.settings, self.stat, bool(self.vars.metric.get())),
                      self.touch_off_note(letter, tool_only)) if letter in self.settings.axes else ("", None)
        dialog = dialogs.Touchoff(self.root, title, text, default, unit, checker,
                                  None if tool_only else system or self.vars.touch_off_system.get(), note,
                                  self.translate)
        return dialog.wait(dialog.entry) or (None, None)

    def nf_dialog(self, path, title, text, icon, default, *buttons):
        extra = None
        if isinstance(path, (list, tuple)) and "-ext" in path:
            extra = path[path.index("-ext") + 1]
        return dialogs.ask(self.root, title, text, icon, int(default), *buttons, extra=extra)
