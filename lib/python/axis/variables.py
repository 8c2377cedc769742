# SPDX-License-Identifier: GPL-2.0-or-later
"""The screen's Tk variables; each is a Tcl global of the same name. List: GUI reference, section 14."""

import tkinter as tk

STRINGS = ("linuxcnctop_command", "emcini", "mdi_command", "taskfile", "ja_rbutton", "tool", "active_codes",
           "touch_off_system", "machine", "trajcoordinates", "jogincrement", "task_state_string", "control_name",
           "run_time", "position", "pane_top", "pane_bottom")
INTEGERS = ("interp_pause", "exec_state", "task_state", "task_paused", "interp_state", "task_mode",
            "has_ladder", "has_editor", "spindledir", "running_line", "highlight_line", "feedrate", "rapidrate",
            "spindlerate", "metric", "coord_type", "display_type", "override_limits", "view_type", "teleop_mode",
            "motion_mode", "kinematics_type", "optional_stop",
            "block_delete", "rotate_mode", "on_any_limit", "queued_mdi_commands", "max_queued_mdi_commands")
FLAGS = ("tto_g11", "mist", "flood", "brake", "show_program", "program_alpha", "show_live_plot", "show_tool",
         "show_extents", "show_offsets", "show_machine_limits", "show_machine_speed", "show_distance_to_go",
         "dro_large_font", "show_pyvcppanel", "show_rapids", "dark_theme", "large_touch_targets")
REALS = ("grid_size", "jog_speed", "jog_aspeed", "max_speed", "max_aspeed", "maxvel_speed", "max_maxvel",
         "jog_slider_val", "interface_scale", "ajog_slider_val", "maxvel_slider_val")


class Variables:
    """One attribute for each variable, with get() and set()."""

    def __init__(self, root):
        for names, kind in ((STRINGS, tk.StringVar), (INTEGERS, tk.IntVar), (FLAGS, tk.BooleanVar),
                            (REALS, tk.DoubleVar)):
            for name in names:
                setattr(self, name, kind(root, name=name))
        self.highlight_line.set(-1)
        self.running_line.set(-1)
        self.spindledir.set(0)

    def put(self, name, value):
        """Sets a variable only when it changes, so that traces run only then."""
        variable = getattr(self, name)
        try:
            if variable.get() == value:
                return
        except tk.TclError:
            pass
        variable.set(value)


class Options:
    """Values of the variables as plain attributes, for the preview and the readout."""

    def __init__(self, variables, **fixed):
        self.__dict__.update(fixed, _variables=variables)

    def __getattr__(self, name):
        return getattr(self._variables, name).get()

    def __setattr__(self, name, value):
        if name in self.__dict__:
            self.__dict__[name] = value
        else:
            self._variables.put(name, value)
