# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of the main window. Table: GUI reference, section 11. Entries keep their own keys."""

import re
import tkinter as tk

MODIFIERS = 1 | 4 | 8 | 32 | 64 | 128      # Shift Control Mod1 ...; NumLock (16) and Lock (2) are allowed
JOG_KEYS = {                               # keysym -> (place in the jog order, direction)
    "Left": (0, -1), "Right": (0, 1), "Down": (1, -1), "Up": (1, 1), "Next": (2, -1), "Prior": (2, 1),
    "bracketleft": (3, -1), "bracketright": (3, 1), "KP_Left": (0, -1), "KP_Right": (0, 1), "KP_4": (0, -1),
    "KP_6": (0, 1), "KP_Down": (1, -1), "KP_Up": (1, 1), "KP_2": (1, -1), "KP_8": (1, 1), "KP_Next": (2, -1),
    "KP_Prior": (2, 1), "KP_3": (2, -1), "KP_9": (2, 1),
}
# with Shift on some keyboards
SIGNS = set("0123456789I") | {"grave", "comma", "period", "less", "greater", "semicolon", "apostrophe"}
FUNCTION_KEY = re.compile("F[0-9]+")
CHORD = ("Shift_L", "Shift_R", "Control_L", "Control_R", "Alt_L", "Alt_R", "Meta_L", "Meta_R", "Super_L", "Super_R")
OWN_KEYS = ("Entry", "Spinbox", "Listbox", "TEntry", "TCombobox", "TSpinbox", "Treeview")
PLAIN = {                                  # without modifiers: key -> command
    "F2": "onoff_clicked", "F4": "next_tab", "F7": "mist_toggle", "F8": "flood_toggle", "F9": "spindle_forward_toggle",
    "F10": "spindle_backward_toggle", "b": "brake_off", "o": "open_file", "r": "task_run", "t": "task_step",
    "p": "task_pause", "s": "task_resume", "Escape": "task_stop", "l": "toggle_override_limits", "v": "cycle_view",
    "Home": "home_joint", "End": "touch_off_system", "KP_Home": "home_joint", "KP_End": "touch_off_system",
}
BOUND = {                                  # as Tk names them: exactly these modifiers; Shift does not matter for signs
    "<Shift-Key-B>": "brake_on", "<Shift-Key-R>": "task_reverse", "<Shift-Key-F>": "task_forward",
    "<Control-Key-r>": "reload_file", "<Control-Key-s>": "save_gcode", "<Control-Key-k>": "clear_live_plot",
    "<Control-Key-Home>": "home_all_joints", "<Shift-Key-Home>": "set_axis_offset",
    "<Control-Key-End>": "touch_off_tool", "<Key-exclam>": "toggle_metric", "<Key-at>": "toggle_display_type",
    "<Key-numbersign>": "toggle_coord_type", "<Key-dollar>": "toggle_teleop_mode",
}
SHIFT, CONTROL = 1, 4


class Keys:
    """Binds the keys of the window and filters their auto-repeat."""

    def __init__(self, app):
        self.app = app
        self.held = {}            # keycode -> id of a release that waits for a repeat, or None. Not the
                                  # keysym: with another modifier the release has another one than the press.
        self.spindle_keys = set() # of the keys that change the spindle's speed, those that are held
        root = app.root
        for key in (*JOG_KEYS, "minus", "equal", *PLAIN, *SIGNS, *"xyzaicd"):
            root.bind(f"<KeyPress-{key}>", self.press)       # one by one: a user's file may take any of them away
        root.bind_all("<KeyRelease>", self.release)          # whatever a user's file binds, a jog ends
        root.bind_all("<Key-F1>", lambda event: self.call("estop_clicked"))      # whatever else is held
        for sequence, command in BOUND.items():
            self.bind(sequence, lambda name=command: self.call(name))
        for sequence, function in (
                ("<Key-F3>", lambda: app.raise_tab("manual")), ("<Key-F5>", lambda: app.raise_tab("mdi")),
                ("<Control-Key-Tab>", app.other_tab), ("<Control-Key-e>", app.toggle_panel),
                ("<Control-Key-space>", app.notifications.clear), ("<Key-Return>", root.focus_set),
                ("<Key-KP_Enter>", root.focus_set)):
            self.bind(sequence, function)
        for key, command in (("F11", "spindle_decrease"), ("F12", "spindle_increase")):
            root.bind(f"<KeyPress-{key}>", lambda event, c=command: self.spindle(event, c))
            root.bind(f"<KeyRelease-{key}>", self.spindle_end)
        root.bind("<FocusOut>", self.focus_out)

    def bind(self, sequence, function):
        """The function for exactly these modifiers, and in entries only for keys that are none of theirs."""
        wanted = (SHIFT if "Shift" in sequence else 0) | (CONTROL if "Control" in sequence else 0)
        ignored = SHIFT if sequence[5:-1] in ("exclam", "at", "numbersign", "dollar") else 0
        entries_too = any(key in sequence for key in ("F3", "F5", "Tab", "space", "Return", "Enter"))

        def called(event):
            if (event.state & MODIFIERS & ~ignored) != wanted or (self.in_entry(event) and not entries_too):
                return None
            function()
            return "break"
        self.app.root.bind(sequence, called)

    def call(self, name):
        app = self.app
        if name == "toggle_metric":
            app.vars.metric.set(0 if app.vars.metric.get() else 1)
            name = "redraw"
        if name not in ("reload_file", "save_gcode") or not app.running():
            app.root.tk.call(name)
        return "break"

    def spindle(self, event, name):
        if not event.state & MODIFIERS and event.keysym not in self.spindle_keys and self.app.spindle_turns():
            self.spindle_keys.add(event.keysym)
            self.app.root.tk.call(name)
        return "break"

    def spindle_end(self, event):
        if event.keysym in self.spindle_keys:
            self.spindle_keys.discard(event.keysym)
            self.app.root.tk.call("spindle_constant")
        return "break"

    def in_entry(self, event):
        """The keyboard belongs to a widget that takes text or has keys of its own; it may be one that a user's Tcl
        code made."""
        call, path = self.app.root.tk.call, str(event.widget)
        try:
            kind = str(call("winfo", "class", path))
            return kind in OWN_KEYS or (kind == "Text" and str(call(path, "cget", "-state")) == "normal")
        except tk.TclError:              # is gone
            return True

    # -- plain keys ------------------------------------------------------------------------

    def press(self, event):
        try:
            if str(self.app.root.tk.call("winfo", "toplevel", event.widget)) != ".":
                return None
        except tk.TclError:              # is gone
            return None
        key = event.keysym
        if self.in_entry(event) and not FUNCTION_KEY.fullmatch(key) and key != "Escape":
            return None
        code = event.keycode
        if code in self.held:            # auto-repeat: the waiting release was no release
            if self.held[code]:
                self.app.root.after_cancel(self.held[code])
                self.held[code] = None
            return "break"
        if key in JOG_KEYS or key in ("minus", "equal"):
            if event.state & (MODIFIERS & ~SHIFT) or (event.state & SHIFT and key in ("minus", "equal")):
                return None
            self.held[code] = None
            self.jog(key, code, bool(event.state & SHIFT))
            return "break"
        if event.state & MODIFIERS & ~(SHIFT if key in SIGNS else 0):
            return "break" if key == "F10" else None       # Tk's own F10 opens a menu
        if key in PLAIN:
            return self.call(PLAIN[key])
        return "break" if self.other(key) else None

    def jog(self, key, code, fast):
        app = self.app
        if key in ("minus", "equal"):
            app.jogger.start(code, app.vars.ja_rbutton.get(), -1 if key == "minus" else 1)
            return
        place, direction = JOG_KEYS[key]
        selected = app.jog_target(place)
        if selected is None:
            return
        if not selected.isdigit() and selected.upper() in app.jog_invert:
            direction = -direction
        if app.jogger.start(code, selected, direction, fast):
            app.select(selected)

    def release(self, event):
        code = event.keycode
        if code in self.held and self.held[code] is None:
            # an auto-repeat sends release and press together: wait for the press
            self.held[code] = self.app.root.after(1, lambda: self.let_go(code))
        if event.keysym in CHORD:        # FP-061: a jog does not outlive a part of its chord
            self.app.jogger.stop_all()

    def let_go(self, code):
        self.held.pop(code, None)
        self.app.jogger.stop(code)

    def focus_out(self, event):
        """Releases go to another window from now on: nothing may wait for them."""
        for code in list(self.held):
            if self.held[code]:
                self.app.root.after_cancel(self.held[code])
            self.let_go(code)
        self.app.jogger.stop_all()
        if self.spindle_keys:
            self.spindle_keys.clear()
            self.app.root.tk.call("spindle_constant")

    def other(self, key):
        app = self.app
        if key in "xyza" and len(key) == 1:
            if key.upper() in app.settings.axes and not app.joints_shown and app.manual_ok():
                app.select(key)
            return True
        if key == "grave" or (len(key) == 1 and key.isdigit()):
            app.digit(0 if key == "grave" else int(key), key == "grave")
            return True
        steps = {"comma": ("jog_slider_val", -1), "period": ("jog_slider_val", 1), "less": ("ajog_slider_val", -1),
                 "greater": ("ajog_slider_val", 1), "semicolon": ("maxvel_slider_val", -1),
                 "apostrophe": ("maxvel_slider_val", 1)}
        if key in steps:
            app.step_slider(*steps[key])
        elif key == "i":
            app.next_increment(1)
        elif key == "I":
            app.next_increment(-1)
        elif key == "c":
            app.continuous()
        elif key == "d" and not app.settings.lathe:
            app.vars.rotate_mode.set(0 if app.vars.rotate_mode.get() else 1)
            app.root.tk.call("::axis::show_rotate")
        else:
            return False
        return True
