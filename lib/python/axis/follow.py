# SPDX-License-Identifier: GPL-2.0-or-later
"""Updates: the widgets follow the machine's status."""

import os
import sys
import tkinter as tk
from types import SimpleNamespace

import linuxcnc
from kerf import clock
from kerf.language import N_

from .dro import active_codes, tool_text
from .estimate import Rates, clock_text
from .jog import SLIDER_LEAST, position
from .program import path_codes
from .settings import LETTERS

# relative, commanded
POSITIONS = {(False, False): N_("Position: Machine Actual"), (False, True): N_("Position: Machine Commanded"),
             (True, False): N_("Position: Relative Actual"), (True, True): N_("Position: Relative Commanded")}
STATES = {linuxcnc.STATE_ESTOP: N_("ESTOP"), linuxcnc.STATE_ON: N_("ON"), linuxcnc.STATE_OFF: N_("OFF")}
ERROR_POLL_MS = 200
OPTIONS = ("block_delete", "optional_stop")
SILENT_S = 3.0           # without a cycle of the controller
RETRY_S = 5.0            # between two looks for a server that is gone
LATE_S = 1.0             # keys and clicks older than that start nothing
STALE_S = 0.3            # offsets must rest so long before the preview is read anew


class FollowPart:
    """Part of App: looks at the status and shows it."""

    def state_changed(self, *args):
        if not self.state_pending:
            self.state_pending = True
            self.root.after_idle(self.show_state)

    def show_state(self):
        self.state_pending = False
        self.root.tk.call("update_state")

    def update(self):
        """One update cycle, and the next one in CYCLE_TIME, whatever fails in this one."""
        alive = True
        try:
            alive = self.tick()
        except tk.TclError:
            if self.gone():
                return
            self.failed_once(sys.exc_info()[1])
        except Exception as e:
            self.failed_once(e)
        if alive:
            self.root.after(self.settings.cycle_ms, self.update)

    out_of_touch = False     # what is shown is old
    life, life_at = None, 0.0
    retry_at = 0.0           # of a lost connection

    def look_for_life(self):
        """The controller counts its cycles: while the count stands nobody knows what it does."""
        now = clock.now()
        if self.stat.heartbeat != self.life:
            self.life, self.life_at = self.stat.heartbeat, now
            if self.out_of_touch:
                self.out_of_touch = False
                self.notifications.add("info", self.translate("The controller answers again."))
        elif now - self.life_at > SILENT_S:
            self.lost("")

    def lost(self, why):
        if not self.out_of_touch:
            self.out_of_touch = True
            text = self.translate("The controller does not answer: what is shown is old.")
            self.notifications.add("error", f"{text} {why}".strip())

    def gets_on(self):
        """Called in each update cycle. After a longer rest everything that waits in the queue of events is late."""
        now = clock.now()
        if now - self.awake_at > self.longest_rest():
            self.late = True
            self.root.after_idle(setattr, self, "late", False)
        self.awake_at = now

    def is_late(self):
        """Is what the operator asked for now old, because the screen did not get on?"""
        return self.late or clock.now() - self.awake_at > self.longest_rest()

    def longest_rest(self):
        return max(LATE_S, 3 * self.settings.cycle_ms / 1000)

    def failed_once(self, error):
        """As failed(), but what comes in each cycle is told once."""
        if repr(error) not in self.told_faults:
            self.told_faults.add(repr(error))
            self.failed(error)

    def tick(self):
        """Shows the present status; False when the controller is gone and the screen ends."""
        if self.out_of_touch and clock.now() < self.retry_at:
            return True
        try:
            self.stat.poll()
            self.look_for_life()
            self.gets_on()
            self.jogger.beat()
            self.follow_status()
            self.preview.look()
        except linuxcnc.error as e:
            # they have ended: there are no heartbeats, or there is nothing that moves
            self.jogger.running.clear()
            if not self.out_of_touch:
                print(f"axis: the controller does not answer: {e}", file=sys.stderr)
            if "LINUXCNC_SESSION" in os.environ:  # the launcher tells why
                self.root.destroy()
                return False
            self.lost(str(e))
            self.retry_at = clock.now() + RETRY_S
            return True
        live = self.user.get("user_live_update")
        if live:
            try:
                live()
            except Exception as e:
                self.failed_once(e)
        return True

    def follow_status(self):
        s, v = self.stat, self.vars
        put = v.put
        for name in ("task_state", "task_mode", "interp_state", "exec_state", "motion_mode", "kinematics_type",
                     "queued_mdi_commands"):
            put(name, getattr(s, name))
        put("task_paused", int(s.task_paused))
        put("taskfile", s.file or "")
        put("teleop_mode", int(s.motion_mode == linuxcnc.TRAJ_MODE_TELEOP))
        put("spindledir", int(s.spindle[0]["direction"]))
        put("brake", bool(s.spindle[0]["brake"]))
        put("flood", bool(s.flood))
        put("mist", bool(s.mist))
        put("override_limits", int(s.joint[0]["override_limits"]))
        put("on_any_limit", int(any(s.limit[:self.settings.joints])))
        put("tool", tool_text(s, self.settings.lathe, self.translate))
        put("task_state_string", self.translate(STATES.get(s.task_state, STATES[linuxcnc.STATE_OFF])))
        put("control_name", self.translate("Control: %s") % s.control_name if s.control_pid else "")
        if s.mdi_queue != self.widget_signs.get("waiting", ()):
            self.widget_signs["waiting"] = s.mdi_queue
            self.root.tk.call("::axis::show_waiting", tuple(line for _, line in s.mdi_queue))
        self.follow_overrides()
        self.follow_modes()
        self.follow_moved_axis()
        self.follow_line()
        self.follow_time()
        self.look_at_pins()
        codes = active_codes(s)
        if codes != self.widget_signs.get("codes"):
            self.widget_signs["codes"] = codes
            self.root.tk.call("::axis::show_codes", codes)
        self.show_readout()

    def follow_overrides(self):
        now, s, v = clock.now(), self.stat, self.vars

        def follows(name):               # an own change is on its way for a moment
            own = self.own_values.get(name)
            return own is None or now > own[1]
        for name, value in (("feedrate", s.feedrate), ("rapidrate", s.rapidrate),
                            ("spindlerate", s.spindle[0]["override"])):
            if follows(name):
                v.put(name, round(100 * value))
        for name in OPTIONS:             # halui and panels have buttons for them, too
            value = int(getattr(s, name))
            if follows(name) and getattr(v, name).get() != value:
                getattr(v, name).set(value)
                if name == "block_delete" and self.loaded_file:
                    self.stale_since = now
        if now > self.maxvel_quiet_until and s.max_velocity != self.seen_maxvel:
            self.seen_maxvel = s.max_velocity
            top = self.settings.max_velocity
            shown = v.maxvel_speed.get()
            self.show_speed(v.maxvel_speed, self.to_display(60 * min(top, s.max_velocity)))
            if v.maxvel_speed.get() != shown:
                self.follows_maxvel = True
                v.maxvel_slider_val.set(max(SLIDER_LEAST, position(60 * s.max_velocity, top)))
                self.follows_maxvel = False

    def follow_modes(self):
        s = self.stat
        joints = s.motion_mode == linuxcnc.TRAJ_MODE_FREE and s.kinematics_type != linuxcnc.KINEMATICS_IDENTITY
        if joints != self.joints_shown:
            first = self.joints_shown is None
            self.joints_shown = joints
            self.root.tk.call("::axis::show_joints", int(joints))
            if joints or not first:
                self.select("0" if joints else self.settings.coordinates[0])
        if (s.motion_mode == linuxcnc.TRAJ_MODE_COORD and s.task_mode == linuxcnc.MODE_MANUAL
                and s.interp_state == linuxcnc.INTERP_IDLE):
            self.command.teleop_enable(1)
        if ((self.jogger.running or self.jogger.left_to_user) and (self.raised_tab() != "manual" or s.task_state != linuxcnc.STATE_ON
                                     or s.task_mode != linuxcnc.MODE_MANUAL)):
            self.jogger.stop_all()
        extra = range(self.settings.joints - s.num_extrajoints, self.settings.joints)
        homed = tuple(j for j in extra if s.homed[j])
        if homed != self.widget_signs.get("homed_extra"):
            self.widget_signs["homed_extra"] = homed
            self.root.tk.setvar("::axis::homed_extra", homed)
            self.state_changed()
        state = (s.task_state == linuxcnc.STATE_ON, s.interp_state == linuxcnc.INTERP_IDLE)
        if state == (True, True) and self.last_state not in (None, state) and s.task_mode == linuxcnc.MODE_AUTO:
            self.root.tk.call("set_mode_from_tab")
        self.last_state = state

    def follow_offsets(self):
        """FP-134: the preview follows offsets, rotation, tool length, units and plane that were set by hand, once the
        machine is idle."""
        if self.stale_since and clock.now() - self.stale_since > STALE_S and not self.loading and \
                self.stat.interp_state == linuxcnc.INTERP_IDLE and self.stat.task_mode != linuxcnc.MODE_AUTO:
            self.stale_since = None
            if self.shown_file and self.picture_conditions != self.conditions():
                self.refresh_preview()

    def follow_moved_axis(self):
        """[DISPLAY]SELECT_MOVED_AXIS: the axis that a wheel moves is the one that is touched off."""
        s = self.stat
        if not self.select_moved or s.task_mode != linuxcnc.MODE_MANUAL or s.interp_state != linuxcnc.INTERP_IDLE:
            return
        if self.joints_shown or any(j["homing"] for j in s.joint[:self.settings.joints]):
            return
        if s.motion_mode == linuxcnc.TRAJ_MODE_TELEOP:
            moving = [c for c in self.settings.axes if abs(s.axis[LETTERS.index(c)]["velocity"]) > 1e-9]
        else:
            moving = [c for c in self.settings.axes if abs(s.joint[self.settings.joint_of(c)]["velocity"]) > 1e-9]
        if len(moving) == 1 and moving[0].lower() != self.vars.ja_rbutton.get():
            self.select(moving[0])

    def follow_line(self):
        s = self.stat
        line, busy = -1, s.interp_state != linuxcnc.INTERP_IDLE
        elsewhere = busy and s.task_mode == linuxcnc.MODE_AUTO and bool(s.file) and bool(self.shown_file) and \
            os.path.realpath(s.file) != os.path.realpath(self.shown_file)
        if elsewhere:                # a subroutine of another file: the calling line stays marked
            line = self.vars.running_line.get()
        elif busy:
            line = s.motion_line if s.motion_line > 0 else s.current_line or -1
        self.place = f"{os.path.basename(s.file)}:{s.motion_line}" if elsewhere else ""
        if line != self.vars.running_line.get():
            self.vars.running_line.set(line)
            self.code.mark("executing", line)
            if line > 0 and self.vars.highlight_line.get() <= 0:
                self.code.see(line)

    def follow_time(self):
        """FP-138: the time that the program needs still, or needs at all."""
        s, e = self.stat, self.estimate
        running = s.task_mode == linuxcnc.MODE_AUTO and s.interp_state != linuxcnc.INTERP_IDLE
        self.waits.watch(clock.now(), s)
        e.follow(clock.now(), Rates.of(s), running, not s.task_paused and s.feedrate > 0, s.motion_line)
        if self.timed and not running and s.interp_state == linuxcnc.INTERP_IDLE:
            self.estimate_time()         # the next run begins here, with this tool
        self.timed = running
        seconds = e.remaining if running else e.total
        text = self.translate("Remaining: %s") if running else self.translate("Run time: %s")
        self.vars.put("run_time", "" if seconds is None else text % clock_text(seconds))

    def show_readout(self):
        v, s = self.vars, self.stat
        view = SimpleNamespace(relative=bool(v.coord_type.get()), commanded=bool(v.display_type.get()),
                               metric=bool(v.metric.get()), joints=bool(self.joints_shown),
                               offsets=bool(v.show_offsets.get()), speed=bool(v.show_machine_speed.get()),
                               distance_to_go=bool(v.show_distance_to_go.get()), extra_joints=s.num_extrajoints)
        text = self.translate("Position: Joint") if view.joints else \
            self.translate(POSITIONS[view.relative, view.commanded])
        self.vars.put("position", f"{text}    {self.place}" if self.place else text)
        long_lines = self.readout.lines(s, view)
        view.offsets = False
        self.preview.stat = s
        homed = [bool(s.homed[j]) for j in range(self.settings.joints)]
        limited = [bool(x) for x in s.limit[:self.settings.joints]]
        self.preview.readout_lines = (self.readout.lines(s, view) if not v.show_offsets.get()
                                      else [x for x in long_lines if x])
        self.preview.marks = list(zip(homed, limited))
        key = (tuple(s.actual_position), tuple(long_lines), tuple(homed), tuple(limited),
               s.tool_in_spindle, path_codes(s))
        if key == self.widget_signs.get("readout"):
            return
        still = (tuple(s.g5x_offset), tuple(s.g92_offset), s.rotation_xy, tuple(s.tool_offset),
                 s.tool_in_spindle, path_codes(s))
        if still != self.widget_signs.get("offsets"):
            if "offsets" in self.widget_signs:
                self.stale_since = clock.now()
            self.widget_signs["offsets"] = still
            self.user["current_tool"] = s.tool_table[0] if s.tool_in_spindle > 0 else None
            linuxcnc.gui_rot_offsets(*[a + b for a, b in zip(s.g5x_offset[:3], s.g92_offset[:3])])
            self.preview.dirty = True
        self.widget_signs["readout"] = key
        self.preview.redraw_soon()
        box = self.widgets.numbers_text
        text = "\n".join(long_lines)
        box.configure(state="normal")
        box.delete("1.0", "end")
        box.insert("end", text)
        box.configure(state="disabled", font=("DejaVu Sans Mono", self.digits_size(long_lines)))

    def digits_size(self, lines):
        """Font size (pixels, negative) that fills the DRO tab."""
        width, height = self.widgets.numbers_text.winfo_width(), self.widgets.numbers_text.winfo_height()
        longest = max((len(line) for line in lines), default=1)
        return -max(10, min(int(width / (0.62 * longest)), int(height / (1.25 * max(1, len(lines)))), 96))

    def poll_errors(self):
        """Looks around now and every ERROR_POLL_MS."""
        try:
            self.look_around()
        except linuxcnc.error:
            pass            # tick() tells that the controller is gone
        except Exception as e:
            if self.gone():
                return
            self.failed_once(e)
        self.root.after(ERROR_POLL_MS, self.poll_errors)

    def look_around(self):
        """New messages; whether the file or the offsets changed."""
        self.show_errors()
        self.follow_opened()
        self.look_at_file()
        self.follow_offsets()
        self.look_at_children()
        self.keep_record()

    def show_errors(self):
        try:
            while message := self.errors.poll():
                kind, text = message
                self.notifications.add("error" if kind in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR) else "info",
                                       text)
        except linuxcnc.error:
            pass            # tick() tells when the controller is gone
