# SPDX-License-Identifier: GPL-2.0-or-later
"""What menus, buttons and keys call: the class TclCommands, whose functions become Tcl commands."""

import os
import shutil
import tkinter as tk
from tkinter import filedialog

import linuxcnc

from . import dialogs, program, waits
from .mdi import MdiHistory
from .remote import answers
from .settings import MM_PER_INCH

ABORT_PULSE_MS = 300
TOGGLES = ("show_program", "show_rapids", "program_alpha", "show_live_plot", "show_tool", "show_extents",
           "show_offsets", "show_machine_limits", "show_machine_speed", "show_distance_to_go", "dro_large_font")

# What a command made in Python returns: (failed, value or message)
CALL = """proc ::axis::call {command args} {
    lassign [$command {*}$args] failed value
    if {$failed} { return -code error $value }
    return $value
}"""


def make_command(tcl, name, function):
    """A command whose exceptions are errors of the Tcl code that calls it, to be caught there: those of a command of
    tkinter end the main loop, caught or not."""
    def call(*words):
        try:
            value = function(*words)
            return 0, "" if value is None else value
        except tk.TclError as error:
            return 1, str(error)
        except Exception as error:
            return 1, f"{name}: {type(error).__name__}: {error}"
    hidden = f"::axis::python_{name.replace('::', '_')}"
    tcl.createcommand(hidden, call)
    tcl.call("interp", "alias", "", name, "", "::axis::call", hidden)


def make(app):
    """The class for one screen. Its functions take texts from Tcl and return at once."""
    v, s, c, root, _ = app.vars, app.stat, app.command, app.root, app.translate
    history = MdiHistory(app.settings.find("DISPLAY", "MDI_HISTORY_FILE", "~/.axis_mdi_history"))
    hist_list = app.widgets.mdi_history

    def show_history():
        hist_list.delete(0, "end")
        for line in history.lines:
            hist_list.insert("end", line)
        hist_list.insert("end", "")
        hist_list.see("end")

    def save_copy(path, target):
        """True when it is written; else the operator is told."""
        try:
            shutil.copyfile(path, target)
            return True
        except OSError as e:
            dialogs.ask(root, _("Error saving file"), str(e), "error", 0, _("OK"))
            return False

    class TclCommands:
        def __init__(self, master):
            for name in dir(type(self)):
                function = getattr(type(self), name)
                if not name.startswith("_") and callable(function):
                    setattr(self, name, function)        # no method: commands.NAME(...) is what Tcl calls
                    make_command(master.tk, name, app.guarded(function))

        # -- machine -----------------------------------------------------------------------

        def estop_clicked(*event):
            s.poll()
            c.state(linuxcnc.STATE_ESTOP_RESET if s.task_state == linuxcnc.STATE_ESTOP else linuxcnc.STATE_ESTOP)

        def onoff_clicked(*event):
            s.poll()
            if s.task_state == linuxcnc.STATE_ESTOP:
                return
            if s.task_state == linuxcnc.STATE_ESTOP_RESET or s.task_state == linuxcnc.STATE_OFF:
                if app.is_late():
                    return
                c.state(linuxcnc.STATE_ON)
                c.wait_complete()
                prompt = app.settings.flag("DISPLAY", "HOMING_PROMPT") and not app.all_homed()
                if prompt and s.task_state == linuxcnc.STATE_ON:
                    if dialogs.ask(root, _("Homing request"), _("Do you want to home the machine now?"), "question", 0,
                                   _("Ok"), _("Cancel"), escape=1) == 0:
                        commands.home_all_joints()
            else:
                c.state(linuxcnc.STATE_OFF)

        def toggle_override_limits(*event):
            s.poll()
            if s.interp_state != linuxcnc.INTERP_IDLE:
                return
            if s.joint[0]["override_limits"]:
                app.ensure_mode(linuxcnc.MODE_AUTO)
            else:
                app.ensure_mode(linuxcnc.MODE_MANUAL)
                c.override_limits()

        # -- program -----------------------------------------------------------------------

        def open_file(*event):
            if app.running():
                return
            types = [(name, patterns) for name, patterns in app.loader.file_types(_)]
            chosen = filedialog.askopenfilename(parent=root, filetypes=types, initialdir=app.open_directory,
                                                title=_("Open..."))
            if chosen:
                app.open_directory = os.path.dirname(chosen)
                commands.open_file_name(chosen)

        def open_file_name(path):
            app.open_file_guts(str(path))
            app.preview.set_view(app.preview.camera.view or "p")

        def open_pipe(command):
            if not app.running():
                app.open_pipe(str(command))

        def reload_file(*args):
            if not app.running():
                app.reload_file(str(args[0]) != "0" if args and str(args[0]) in ("0", "1") else True)

        def send_mdi_command(text):
            if not app.refused_while_homing() and app.ensure_mode(linuxcnc.MODE_MDI):
                c.mdi(str(text))

        def save_gcode(*event):
            if not app.loaded_file:
                return
            target = filedialog.asksaveasfilename(parent=root, initialfile=os.path.basename(app.loaded_file),
                                                  initialdir=app.open_directory, defaultextension=".ngc")
            if not target:
                return
            if save_copy(app.shown_file, target):
                app.add_recent(target)

        def edit_program(*event):
            path = app.loaded_file
            editor = app.settings.find("DISPLAY", "EDITOR")
            if not path or not editor:
                return
            if not os.access(path, os.W_OK):
                answer = dialogs.ask(root, _("File not Writable:") + os.path.basename(path),
                                     _("The file cannot be changed: open it to read, or save a copy first?"),
                                     "warning", 0, _("Edit-readonly"), _("Save"), _("Cancel"))
                if answer == 2:
                    return
                if answer == 1:
                    copy = filedialog.asksaveasfilename(parent=root, initialfile="my_" + os.path.basename(path))
                    if not copy:
                        return
                    if not save_copy(path, copy):
                        return
                    path = copy
            app.run_program([*editor.split(), path])

        def edit_tooltable(*event):
            editor = app.settings.find("DISPLAY", "TOOL_EDITOR")
            database = app.settings.find("EMCIO", "DB_PROGRAM")
            table = app.settings.find("EMCIO", "TOOL_TABLE")
            if database:
                words = editor.split() if editor else []
            else:
                words = (editor or "tooledit").split() + ([table] if table else [])
            if words:
                app.run_program(words)

        def reload_tool_table(*event):
            c.load_tool_table()

        def gcode_properties(*event):
            rows = program.properties(app.shown_file, app.loaded_file if app.is_filtered else None, app.preview.program,
                                      app.settings, bool(v.metric.get()), _, app.estimate.total, app.kept)
            rows += waits.rows(app.estimate.times and app.estimate.times.waits, app.waits.values, _)
            text = "\n".join(f"{name + ':':<18} " + str(value).replace("\n", "\n" + 19 * " ") for name, value in rows)
            dialogs.ask(root, _("G-Code Properties"), text, "info", 0, _("OK"), escape=0, font="TkFixedFont")

        def clear_recent_files(*event):
            app.prefs.putpref("recentfiles", [], repr)
            app.show_recent()

        def program_verify(*event):
            app.ensure_mode(linuxcnc.MODE_AUTO)
            c.auto(linuxcnc.AUTO_RUN, -1)

        def task_run(*event):
            app.run_from(0)

        def task_run_line(*event):
            line = v.highlight_line.get()
            if line > 0:
                app.run_from(line)

        def task_step(*event):
            s.poll()
            if s.task_state != linuxcnc.STATE_ON:
                return
            if s.interp_state == linuxcnc.INTERP_IDLE and not app.may_start():
                return
            if app.ensure_mode(linuxcnc.MODE_AUTO):
                c.auto(linuxcnc.AUTO_STEP)

        def task_pause(*event):
            s.poll()
            if s.task_mode in (linuxcnc.MODE_AUTO, linuxcnc.MODE_MDI) and \
                    s.interp_state in (linuxcnc.INTERP_READING, linuxcnc.INTERP_WAITING):
                c.auto(linuxcnc.AUTO_PAUSE)

        def task_resume(*event):
            s.poll()
            if s.paused and s.task_mode in (linuxcnc.MODE_AUTO, linuxcnc.MODE_MDI):
                c.auto(linuxcnc.AUTO_RESUME)

        def task_pauseresume(*event):
            s.poll()
            if s.paused:
                if not app.pin_value("resume-inhibit"):
                    commands.task_resume()
            else:
                commands.task_pause()

        def task_stop(*event):
            s.poll()
            if app.loading:
                app.cancel_loading = True
                if not app.goes_on():
                    return
            if s.task_mode == linuxcnc.MODE_AUTO and v.running_line.get() > 0:
                app.set_highlight_line(v.running_line.get())
            app.jogger.stop_all()
            app.pulse_abort()
            c.abort()
            c.wait_complete()

        def task_reverse(*event):
            if s.task_mode == linuxcnc.MODE_AUTO:
                c.auto(linuxcnc.AUTO_REVERSE)

        def task_forward(*event):
            if s.task_mode == linuxcnc.MODE_AUTO:
                c.auto(linuxcnc.AUTO_FORWARD)

        def toggle_optional_stop(*event):
            app.set_option("optional_stop", v.optional_stop.get())

        def toggle_block_delete(*event):
            app.set_option("block_delete", v.block_delete.get())
            app.ensure_mode(linuxcnc.MODE_MANUAL)
            app.reload_file(False)

        def set_first_line(line):
            app.set_highlight_line(int(line))
            app.code.ignore_before(int(line))

        def copy_line(*event):
            line = app.line_text(v.highlight_line.get())
            root.clipboard_clear()
            root.clipboard_append(line)

        def goto_sensible_line(*event):
            line = v.highlight_line.get() if v.highlight_line.get() > 0 else max(v.running_line.get(), 1)
            app.code.see(line)

        # -- MDI ---------------------------------------------------------------------------

        def send_mdi(*event):
            text = v.mdi_command.get().strip()
            s.poll()
            if (not text or s.task_state != linuxcnc.STATE_ON
                    or s.queued_mdi_commands >= v.max_queued_mdi_commands.get()):
                return
            if app.refused_while_homing():
                return
            if not app.ensure_mode(linuxcnc.MODE_MDI):
                return
            c.mdi(text)
            history.add(text)
            show_history()
            v.mdi_command.set("")

        def mdi_up_cmd(*event):
            v.mdi_command.set(history.step(-1))

        def mdi_down_cmd(*event):
            v.mdi_command.set(history.step(1))

        def clear_mdi_history(*event):
            history.clear()
            show_history()

        def mdi_history_write_to_file(*event):
            history.save()

        def mdi_history_hist2clip(*event):
            chosen = [hist_list.get(i) for i in hist_list.curselection() if hist_list.get(i)]
            root.clipboard_clear()
            root.clipboard_append("".join(line + "\n" for line in chosen))

        def mdi_history_clip2hist(*event):
            try:
                text = root.clipboard_get()
            except tk.TclError:
                return
            for line in text.splitlines():
                if line.strip():
                    history.add(line.strip())
            show_history()

        def mdi_history_butt_1(x="0", y="0"):
            chosen = hist_list.curselection()
            if len(chosen) == 1:
                v.mdi_command.set(hist_list.get(chosen[0]))
                history.at = chosen[0]
            else:
                v.mdi_command.set("")

        def mdi_history_double_butt_1(x="0", y="0"):
            index = hist_list.index(f"@{x},{y}")
            if hist_list.get(index):
                v.mdi_command.set(hist_list.get(index))
                commands.send_mdi()

        def mdi_cancel(x="0", y="0"):
            index = app.widgets.mdi_waiting.index(f"@{x},{y}")
            waiting = app.widget_signs.get("waiting", ())
            if 0 <= index < len(waiting):
                c.mdi_cancel(waiting[index][0])

        # -- modes -------------------------------------------------------------------------

        def ensure_manual(*event):
            if not app.manual_ok() or app.running():         # an MDI line goes on
                return
            s.poll()
            if ((app.all_homed() and s.motion_mode == linuxcnc.TRAJ_MODE_TELEOP)
                    or s.motion_mode == linuxcnc.TRAJ_MODE_COORD):
                app.ensure_mode(linuxcnc.MODE_MANUAL)
                app.set_motion_teleop(1)
            else:
                app.ensure_mode(linuxcnc.MODE_MANUAL)
                app.set_motion_teleop(0)

        def ensure_mdi(*event):
            if app.manual_ok() and not app.running():
                app.set_motion_teleop(0)
                app.ensure_mode(linuxcnc.MODE_MDI)

        def set_teleop_mode(*event):
            if not app.running() and s.kinematics_type != linuxcnc.KINEMATICS_IDENTITY:
                app.jogger.stop_all()
                app.ensure_mode(linuxcnc.MODE_MANUAL)
                app.set_motion_teleop(v.teleop_mode.get())

        def toggle_teleop_mode(*event):
            v.teleop_mode.set(0 if v.teleop_mode.get() else 1)
            commands.set_teleop_mode()

        # -- jogging, homing, offsets --------------------------------------------------------

        def axis_activated(*event):
            app.show_selected()

        def jog_plus(*args):
            app.jogger.start("button", v.ja_rbutton.get(), 1)

        def jog_minus(*args):
            app.jogger.start("button", v.ja_rbutton.get(), -1)

        def jog_stop(*event):
            app.jogger.stop("button")

        def home_all_joints(*event):
            if not app.manual_ok() or app.any_homing() or not app.ensure_mode(linuxcnc.MODE_MANUAL):
                return
            if app.all_homed() and not app.confirm_rehome(_("Joint is already homed, are you sure you want to re-home?")):
                return
            app.set_motion_teleop(0)
            c.home(-1)

        def unhome_all_joints(*event):
            commands.unhome_joint_number(-1)

        def home_joint(*event):
            if not app.manual_ok() or app.running():
                return
            joint = app.selected_joint()
            if joint is None:
                print("axis: this axis has no joint of its own: use the Homing menu")
                return
            s.poll()
            if s.homed[joint] and not app.confirm_rehome(_("This joint is already homed, are you sure "
                                                           "you want to re-home?")):
                return
            app.go_home(joint)

        def home_joint_number(joint):
            if not app.manual_ok() or app.any_homing() or not app.ensure_mode(linuxcnc.MODE_MANUAL):
                return
            app.set_motion_teleop(0)
            c.home(int(joint))

        def unhome_joint_number(joint):
            if not app.manual_ok() or not app.ensure_mode(linuxcnc.MODE_MANUAL):
                return
            app.set_motion_teleop(0)
            c.unhome(int(joint))

        def clear_offset(number):
            app.mdi_lines("G92.1" if str(number) == "G92" else
                          f"G10 L2 P{number} R0 " + " ".join(f"{a}0" for a in app.settings.axes))
            app.ensure_mode(linuxcnc.MODE_MANUAL)
            app.reload_file(False)

        def touch_off_system(*event):
            app.touch_off(tool=False)

        def touch_off_tool(*event):
            app.touch_off(tool=True)

        def set_axis_offset(*event):
            app.touch_off(tool=False, value="0")

        def undo_touch_off(*event):
            app.undo_touch_off()

        def toggle_tto_g11(*event):
            app.prefs.putpref("tto_g11", v.tto_g11.get())

        # -- overrides ---------------------------------------------------------------------

        def set_feedrate(value):
            app.set_feedrate(int(float(value)))

        def set_rapidrate(value):
            app.set_rapidrate(int(float(value)))

        def set_spindlerate(value):
            app.set_override("spindlerate", int(float(value)))

        def set_maxvel(value):
            app.set_maxvel(float(value))

        # -- spindle, coolant --------------------------------------------------------------

        def spindle(*event):
            app.spindle(v.spindledir.get())

        def spindle_forward_toggle(*event):
            if app.manual_ok():
                app.spindle(0 if s.spindle[0]["direction"] else 1)

        def spindle_backward_toggle(*event):
            if app.manual_ok():
                app.spindle(0 if s.spindle[0]["direction"] else -1)

        def spindle_increase(*event):
            c.spindle(linuxcnc.SPINDLE_INCREASE)

        def spindle_decrease(*event):
            c.spindle(linuxcnc.SPINDLE_DECREASE)

        def spindle_constant(*event):
            c.spindle(linuxcnc.SPINDLE_CONSTANT)

        def brake(*event):
            app.ensure_mode(linuxcnc.MODE_MANUAL)
            c.brake(linuxcnc.BRAKE_ENGAGE if v.brake.get() else linuxcnc.BRAKE_RELEASE)

        def brake_on(*event):
            if app.manual_ok():
                c.brake(linuxcnc.BRAKE_ENGAGE)

        def brake_off(*event):
            if app.manual_ok():
                c.brake(linuxcnc.BRAKE_RELEASE)

        def flood(*event):
            c.flood(linuxcnc.FLOOD_ON if v.flood.get() else linuxcnc.FLOOD_OFF)

        def mist(*event):
            c.mist(linuxcnc.MIST_ON if v.mist.get() else linuxcnc.MIST_OFF)

        def flood_toggle(*event):
            s.poll()
            c.flood(linuxcnc.FLOOD_OFF if s.flood else linuxcnc.FLOOD_ON)

        def mist_toggle(*event):
            s.poll()
            c.mist(linuxcnc.MIST_OFF if s.mist else linuxcnc.MIST_ON)

        # -- view --------------------------------------------------------------------------

        def redraw(*event):
            app.units_changed()
            app.preview.invalidate()

        def redraw_soon(*event):
            app.preview.redraw_soon()

        def redraw_dro(*event):
            app.show_readout()

        def zoomin(*event):
            app.preview.zoomin()

        def zoomout(*event):
            app.preview.zoomout()

        def cycle_view(*event):
            camera = app.preview.camera
            app.preview.set_view(app.lathe_view() if app.settings.lathe else camera.next_view())

        def clear_live_plot(*event):
            app.preview.clear_plot()

        def set_grid_size(size):
            v.grid_size.set(float(size))
            app.prefs.putpref("grid_size", float(size), float)
            app.preview.invalidate()

        def set_grid_size_custom(*event):
            app.custom_grid()

        def toggle_display_type(*event):
            v.display_type.set(0 if v.display_type.get() else 1)
            app.preview.invalidate()

        def toggle_coord_type(*event):
            v.coord_type.set(0 if v.coord_type.get() else 1)
            app.preview.invalidate()

        def toggle_show_pyvcppanel(*event):
            app.show_panel()

        def next_tab(*event):
            app.next_tab()

        def dynamic_tab(name, text):
            return app.add_tab(str(name), str(text))

        def inifindall(section, item):
            return tuple(app.settings.ini.findall(str(section), str(item)) or ())

        def to_internal_linear_unit(value, unit=None):
            return float(value) / (app.settings.units_per_mm * MM_PER_INCH)

        def from_internal_linear_unit(value, unit=None):
            return float(value) * app.settings.units_per_mm * MM_PER_INCH

        def launch_website(*event):
            app.run_program(["xdg-open", "https://linuxcnc.org/docs"])

    TclCommands.remote = staticmethod(answers(root, app, lambda: app.running()))

    def toggle(name):
        def function(*event):
            app.prefs.putpref(name, bool(getattr(v, name).get()))
            app.preview.invalidate()
        return function
    for name in TOGGLES:
        setattr(TclCommands, f"toggle_{name}", staticmethod(toggle(name)))
    for name in ("x", "y", "y2", "z", "z2", "p"):
        setattr(TclCommands, f"set_view_{name}", staticmethod(lambda *event, n=name: app.preview.set_view(n)))
    commands = TclCommands      # functions call each other through the class: user code may replace them
    show_history()
    app.show_history = show_history
    return TclCommands


