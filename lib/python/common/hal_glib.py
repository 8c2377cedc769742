# SPDX-License-Identifier: GPL-2.0-or-later
"""HAL pins and the controller's status for programs with a GLib main loop.

GPin, GComponent: HAL pins that emit `value-changed`. GStat: one object per process that
looks at the status every [DISPLAY]CYCLE_TIME and emits a signal for each change; widgets
also use it as a message board. Call from the main loop's thread only.
Source: Python sheet, section 9.
"""

import json
import math
import os

import gi
gi.require_version("GLib", "2.0")
from gi.repository import GLib, GObject  # noqa: E402

import hal  # noqa: E402
import linuxcnc  # noqa: E402
from kerf import instance  # noqa: E402

__all__ = ["GPin", "GComponent", "GStat"]

AXES = "XYZABCUVW"


class GPin(GObject.Object, hal.Pin):
    """A HAL pin; `value-changed` when its value is another one than at the last look."""

    __gtype_name__ = "GPin"
    __gsignals__ = {"value-changed": (GObject.SignalFlags.RUN_FIRST, GObject.TYPE_NONE, ())}

    REGISTRY = []
    UPDATE = False

    def __init__(self, pin):
        """pin: a hal.Pin (or what one is made of)."""
        GObject.Object.__init__(self)
        hal.Pin.__init__(self, getattr(pin, "_item", pin))
        self._prev = None
        self.REGISTRY.append(self)
        self.update_start()

    def update(self):
        value = self.get()
        if value != self._prev:
            self.emit("value-changed")
        self._prev = value

    @classmethod
    def update_all(cls):
        if not cls.UPDATE:
            return False
        broken = []
        for pin in cls.REGISTRY:
            try:
                pin.update()
            except Exception:
                broken.append(pin)
                print("Error updating pin %s; Removing" % pin)
        for pin in broken:
            cls.REGISTRY.remove(pin)
        return cls.UPDATE

    @classmethod
    def update_start(cls, timeout=100):
        if GPin.UPDATE:
            return
        GPin.UPDATE = True
        GLib.timeout_add(timeout, cls.update_all)

    @classmethod
    def update_stop(cls):
        GPin.UPDATE = False


class GComponent:
    """A HAL component whose pins are GPins."""

    def __init__(self, comp):
        if isinstance(comp, GComponent):
            comp = comp.comp
        self.comp = comp

    def newpin(self, *args, **kwargs):
        return GPin(self.comp.newpin(*args, **kwargs))

    def getpin(self, *args, **kwargs):
        return GPin(self.comp.getpin(*args, **kwargs))

    def exit(self, *args, **kwargs):
        return self.comp.exit(*args, **kwargs)

    def __getitem__(self, name):
        return self.comp[name]

    def __setitem__(self, name, value):
        self.comp[name] = value


_NONE, _STR, _INT, _FLOAT, _BOOL, _OBJ = (), (str,), (int,), (float,), (bool,), (object,)

# Signals of the poller and of the message board, with the types of their arguments.
_SIGNALS = {
    "periodic": _NONE, "state-estop": _NONE, "state-estop-reset": _NONE, "state-on": _NONE, "state-off": _NONE,
    "homed": _STR, "unhomed": _STR, "all-homed": _NONE, "not-all-homed": _STR,
    "override-limits-changed": (bool, object), "hard-limits-tripped": (bool, object),
    "mode-manual": _NONE, "mode-auto": _NONE, "mode-mdi": _NONE, "command-running": _NONE, "command-stopped": _NONE,
    "command-error": _NONE, "interp-run": _NONE, "interp-idle": _NONE, "interp-paused": _NONE, "interp-reading": _NONE,
    "interp-waiting": _NONE, "jograte-changed": _FLOAT, "jograte-angular-changed": _FLOAT,
    "jogincrement-changed": (float, str), "jogincrement-angular-changed": (float, str),
    "joint-selection-changed": _INT, "axis-selection-changed": _STR, "program-pause-changed": _BOOL,
    "optional-stop-changed": _BOOL, "block-delete-changed": _BOOL, "feed-hold-enabled-changed": _BOOL,
    "file-loaded": _STR, "reload-display": _NONE, "line-changed": _INT,
    "runstop-line-changed": _INT, "tool-in-spindle-changed": _INT, "tool-prep-changed": _INT, "tool-info-changed": _OBJ,
    "current-tool-offset": _OBJ, "motion-mode-changed": _INT, "motion-type-changed": _INT,
    "spindle-control-changed": (int, bool, int, bool), "current-feed-rate": _FLOAT,
    "current-x-rel-position": _FLOAT, "current-position": (object, object, object, object), "following-error": _OBJ,
    "current-z-rotation": _FLOAT, "current-command": _STR, "requested-spindle-speed-changed": _FLOAT,
    "actual-spindle-speed-changed": _FLOAT, "spindle-override-changed": _FLOAT,
    "feed-override-changed": _FLOAT, "rapid-override-changed": _FLOAT, "max-velocity-override-changed": _FLOAT,
    "g90-mode": _BOOL, "g91-mode": _BOOL, "itime-mode": _BOOL, "fpm-mode": _BOOL, "fpr-mode": _BOOL, "css-mode": _BOOL,
    "rpm-mode": _BOOL, "radius-mode": _BOOL, "diameter-mode": _BOOL,
    "flood-changed": _BOOL, "mist-changed": _BOOL, "m-code-changed": _STR, "g-code-changed": _STR,
    "f-code-changed": _FLOAT, "s-code-changed": _FLOAT,
    "blend-code-changed": (float, float), "metric-mode-changed": _BOOL, "user-system-changed": _STR,
    "error": (int, str), "mdi-line-selected": (str, str), "gcode-line-selected": _INT, "graphics-line-selected": _INT,
    "graphics-loading-progress": _INT, "graphics-gcode-error": _STR, "graphics-gcode-properties": _OBJ,
    "graphics-view-changed": (str, object), "mdi-history-changed": _NONE,
    "machine-log-changed": _NONE, "update-machine-log": (str, str), "move-text-lineup": _NONE,
    "move-text-linedown": _NONE, "dialog-request": _OBJ,
    "dialog-update": _OBJ, "focus-overlay-changed": (bool, str, object), "play-sound": _STR, "virtual-keyboard": _STR,
    "dro-reference-change-request": _INT, "system_notify_button_pressed": (str, bool), "show-preference": _NONE,
    "shutdown": _NONE, "shutdown-request": _NONE, "status-message": (object, object), "general": _OBJ,
    "forced-update": _NONE, "progress": (int, object),
    "ok-request": _BOOL, "cancel-request": _BOOL, "cycle-start-request": _BOOL, "cycle-pause-request": _BOOL,
    "macro-call-request": _STR, }
_SIGNALS.update({f"gcode-group{n}-changed": _STR for n in (0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 13, 14, 15)})

# Slot of stat.gcodes that shows each modal group.
_GROUP_SLOT = {0: 2, 1: 1, 2: 3, 3: 6, 4: 14, 5: 7, 6: 5, 7: 4, 8: 9, 10: 10, 12: 8, 13: 11, 14: 13, 15: 15}

_SYSTEMS = {540: "54", 550: "55", 560: "56", 570: "57", 580: "58", 590: "59", 591: "59.1", 592: "59.2", 593: "59.3"}


def _code(c):
    return f"G{c // 10}" if c % 10 == 0 else f"G{c // 10}.{c % 10}"


class GStat(GObject.GObject):
    """GStat() is always the same object; so is that of a class derived from it, which may
    bring its own signals and methods."""

    __gtype_name__ = "GStat"
    __gsignals__ = {name: (GObject.SignalFlags.RUN_FIRST, GObject.TYPE_NONE, types) for name, types in _SIGNALS.items()}

    DEFAULT, WARNING, CRITICAL, TEMPORARY_MESSAGE = 0, 1, 2, 255
    TEMPARARY_MESSAGE = TEMPORARY_MESSAGE
    OPERATOR_ERROR, OPERATOR_TEXT = linuxcnc.OPERATOR_ERROR, linuxcnc.OPERATOR_TEXT
    NML_ERROR, NML_TEXT = linuxcnc.NML_ERROR, linuxcnc.NML_TEXT
    MANUAL, AUTO, MDI = linuxcnc.MODE_MANUAL, linuxcnc.MODE_AUTO, linuxcnc.MODE_MDI
    STATE_ESTOP, STATE_RESET = linuxcnc.STATE_ESTOP, linuxcnc.STATE_ESTOP_RESET
    STATE_ON, STATE_OFF = linuxcnc.STATE_ON, linuxcnc.STATE_OFF
    JOGJOINT, JOGTELEOP = 1, 0

    STATES = {linuxcnc.STATE_ESTOP: "state-estop", linuxcnc.STATE_ESTOP_RESET: "state-estop-reset",
              linuxcnc.STATE_ON: "state-on", linuxcnc.STATE_OFF: "state-off"}
    MODES = {linuxcnc.MODE_MANUAL: "mode-manual", linuxcnc.MODE_AUTO: "mode-auto", linuxcnc.MODE_MDI: "mode-mdi"}
    INTERP = {linuxcnc.INTERP_WAITING: "interp-waiting", linuxcnc.INTERP_READING: "interp-reading",
              linuxcnc.INTERP_PAUSED: "interp-paused", linuxcnc.INTERP_IDLE: "interp-idle"}

    def __new__(cls, *args, **kwargs):
        if "_the_object" not in cls.__dict__:
            cls._the_object = super().__new__(cls)
            cls._the_object._start(*args, **kwargs)
        return cls._the_object

    def __init__(self, *args, **kwargs):
        pass  # Python comes here each time that the object is asked for

    def _start(self, stat=None):
        GObject.Object.__init__(self)
        self.stat = stat or linuxcnc.stat()
        self.cmd = linuxcnc.command()
        self.errors = linuxcnc.error_channel()
        self._status_active = False
        self.old = {"state": 0, "mode": 0, "interp": 0, "file": ""}
        self.previous_mode = self.old["mode"]
        self._file_pending = False
        self.current_jog_rate, self.angular_jog_velocity = 15.0, 360.0
        self.current_jog_distance, self.current_jog_distance_text = 0.0, ""
        self.current_jog_distance_angular, self.current_jog_distance_angular_text = 0.0, ""
        self.selected_joint, self.selected_axis = -1, ""
        self._hal_ok = True
        self._ini()
        self._zmq()
        self.set_timer()

    def _ini(self):
        self.cycle_time_ms, self.is_metric_machine, self._coordinates, self._identity_words = 100, True, "XYZ", ""
        name = os.environ.get("INI_FILE_NAME")
        if not name:
            return
        try:
            ini = linuxcnc.ini(name)
        except linuxcnc.error:
            return
        cycle = ini.getreal("DISPLAY", "CYCLE_TIME", fallback=100.0)
        self.cycle_time_ms = int(cycle * 1000 if 0 < cycle < 1 else cycle) or 100
        self.is_metric_machine = ini.getlinearunits("TRAJ", "LINEAR_UNITS", fallback=1.0) == 1.0
        self._coordinates = (ini.find("TRAJ", "COORDINATES") or "XYZ").replace(" ", "").upper()

    def set_timer(self):
        GLib.timeout_add(self.cycle_time_ms, self.update)

    # ---- the look at the status ----

    def _hal_value(self, name):
        if not self._hal_ok:
            return None
        try:
            return hal.get_value(name)
        except Exception:
            return None

    def merge(self):
        """Reads the status into the cache `old`."""
        s, old = self.stat, self.old
        s.poll()
        old.update(
            state=s.task_state, mode=s.task_mode, interp=s.interp_state, command_state=s.state, joints=s.joints,
            rpm=s.spindle[0]["speed"], homed=s.homed[:s.joints],
            override_limits=tuple(s.joint[n]["override_limits"] for n in range(s.joints)),
            hard_limits=tuple((s.limit[n] & 1, (s.limit[n] & 2) >> 1) for n in range(s.joints)), line=s.motion_line,
            paused=s.task_paused, optional_stop=s.optional_stop, block_delete=s.block_delete,
            feed_hold_enabled=s.feed_hold_enabled, tool=s.tool_in_spindle,
            tool_offset=s.tool_offset, motion_mode=s.motion_mode, motion_type=s.motion_type, rotation=s.rotation_xy,
            command=s.command, spindle_or=s.spindle[0]["override"], feed_or=s.feedrate, rapid_or=s.rapidrate,
            max_velocity=s.max_velocity, flood=s.flood, mist=s.mist,
            g_codes=s.gcodes, m_codes=s.mcodes, settings=s.settings, call_level=s.call_level, file_name=s.file,
            program_units=s.program_units,
            spindle_enabled=tuple((sp["enabled"], sp["direction"]) for sp in s.spindle[:max(1, s.spindles)]))
        old["tool_info"] = s.tool_table[0] if s.tool_table else None
        old["m_codes_text"] = " ".join(f"M{c}" for c in sorted(s.mcodes[1:]) if c != -1)
        speed = self._hal_value("spindle.0.speed-in")
        old["actual_speed"] = None if speed is None else speed * 60.0
        old["at_speed"] = tuple(bool(self._hal_value(f"spindle.{n}.at-speed")) for n in range(max(1, s.spindles)))
        prep = self._hal_value("iocontrol.0.tool-prep-number")
        old["tool_prep"] = prep

    def update(self):
        """One look: emits what changed. Keeps the timer running."""
        before = dict(self.old)
        try:
            self.merge()
        except linuxcnc.error:
            self._status_active = False
            return True
        except Exception as e:
            self._status_active = False
            print("GStat:", e)
            return True
        self._status_active = True
        self._emit_changes(before)
        self._emit_errors()
        self.emit("periodic")
        return True

    def _emit_errors(self):
        try:
            while message := self.errors.poll():
                self.emit("error", *message)
        except linuxcnc.error:
            pass

    def _emit_changes(self, before):
        new = self.old

        def changed(key):
            return before.get(key) != new.get(key)

        if changed("state"):
            name = self.STATES.get(new["state"])
            if before.get("state", 0) == 0 and new["state"] > linuxcnc.STATE_ESTOP:
                self.emit("state-estop-reset")
            if name:
                self.emit(name)
        if changed("mode"):
            self.previous_mode = before.get("mode", 0)
            self.emit(self.MODES[new["mode"]])
        if changed("command_state"):
            self.emit({linuxcnc.RCS_EXEC: "command-running",
                       linuxcnc.RCS_DONE: "command-stopped"}.get(new["command_state"], "command-error"))
        if changed("interp"):
            if before.get("interp") in (0, linuxcnc.INTERP_IDLE, None) and new["interp"] != linuxcnc.INTERP_IDLE:
                self.emit("interp-run")
            if new["interp"] in self.INTERP:
                self.emit(self.INTERP[new["interp"]])
        if changed("file_name") and new["file_name"]:
            self._file_pending = True
        if self._file_pending and (new["interp"] == linuxcnc.INTERP_IDLE or new["call_level"] == 0):
            self._file_pending = False
            self.old["file"] = new["file_name"]
            self.emit("file-loaded", new["file_name"])
        if changed("line"):
            self.emit("line-changed", new["line"])
        if changed("interp") and new["interp"] == linuxcnc.INTERP_IDLE and new["mode"] == linuxcnc.MODE_AUTO:
            self.emit("runstop-line-changed", before.get("line") or 0)
        if changed("homed"):
            old_homed = before.get("homed") or ()
            for n, homed in enumerate(new["homed"]):
                if n >= len(old_homed) or old_homed[n] != homed:
                    self.emit("homed" if homed else "unhomed", str(n))
            missing = "".join(str(n) for n, homed in enumerate(new["homed"]) if not homed)
            if missing:
                self.emit("not-all-homed", missing)
            else:
                self.emit("all-homed")
        if changed("override_limits"):
            self.emit("override-limits-changed", any(new["override_limits"]), list(new["override_limits"]))
        if changed("hard_limits"):
            self.emit("hard-limits-tripped", any(a or b for a, b in new["hard_limits"]),
                      [list(p) for p in new["hard_limits"]])
        for key, signal in (("paused", "program-pause-changed"), ("optional_stop", "optional-stop-changed"),
                            ("block_delete", "block-delete-changed"),
                            ("feed_hold_enabled", "feed-hold-enabled-changed"), ("flood", "flood-changed"),
                            ("mist", "mist-changed")):
            if changed(key):
                self.emit(signal, bool(new[key]))
        for key, signal in (("tool", "tool-in-spindle-changed"), ("motion_mode", "motion-mode-changed"),
                            ("motion_type", "motion-type-changed")):
            if changed(key):
                self.emit(signal, new[key])
        if changed("tool_prep") and new["tool_prep"] is not None:
            self.emit("tool-prep-changed", int(new["tool_prep"]))
        if changed("tool_info"):
            self.emit("tool-info-changed", new["tool_info"])
        if changed("tool_offset"):
            self.emit("current-tool-offset", new["tool_offset"])
        if changed("rotation"):
            self.emit("current-z-rotation", new["rotation"])
        if changed("command"):
            self.emit("current-command", new["command"])
        if changed("rpm"):
            self.emit("requested-spindle-speed-changed", new["rpm"])
        if changed("actual_speed") and new["actual_speed"] is not None:
            self.emit("actual-spindle-speed-changed", new["actual_speed"])
        for key, signal in (("spindle_or", "spindle-override-changed"), ("feed_or", "feed-override-changed"),
                            ("rapid_or", "rapid-override-changed")):
            if changed(key):
                self.emit(signal, new[key] * 100.0)
        if changed("max_velocity") and new["max_velocity"] < 1e99:
            self.emit("max-velocity-override-changed", new["max_velocity"] * 60.0)
        if changed("spindle_enabled") or changed("at_speed"):
            for n, (enabled, direction) in enumerate(new["spindle_enabled"]):
                self.emit("spindle-control-changed", n, bool(enabled), direction, new["at_speed"][n])
        if changed("g_codes"):
            self._emit_codes(before.get("g_codes"))
        if changed("m_codes_text"):
            self.emit("m-code-changed", new["m_codes_text"])
        settings, was = new["settings"], before.get("settings") or (None,) * 5
        if settings[1] != was[1]:
            self.emit("f-code-changed", settings[1])
        if settings[2] != was[2]:
            self.emit("s-code-changed", settings[2])
        if [round(v, 6) for v in settings[3:5]] != [v and round(v, 6) for v in was[3:5]]:
            self.emit("blend-code-changed", settings[3], settings[4])
        self._emit_positions()

    def _emit_codes(self, was):
        codes = self.old["g_codes"]
        active = {c for c in codes[1:] if c != -1}
        text = " ".join(_code(c) for c in sorted(active))
        self.emit("g-code-changed", text)
        for group, slot in _GROUP_SLOT.items():
            if not was or was[slot] != codes[slot]:
                self.emit(f"gcode-group{group}-changed", _code(codes[slot]) if codes[slot] != -1 else "")
        for signal, code in (("g90-mode", 900), ("g91-mode", 910), ("itime-mode", 930), ("fpm-mode", 940),
                             ("fpr-mode", 950), ("css-mode", 960), ("rpm-mode", 970), ("radius-mode", 80),
                             ("diameter-mode", 70)):
            if not was or (code in was) != (code in active):
                self.emit(signal, code in active)
        if not was or (210 in was) != (210 in active):
            self.emit("metric-mode-changed", 210 in active)
        if not was or was[8] != codes[8]:
            self.emit("user-system-changed", _SYSTEMS.get(codes[8], str(codes[8] / 10)))

    def _emit_positions(self):
        s = self.stat
        self.emit("current-feed-rate", s.current_vel * 60.0)
        position, relative, dtg = self.get_position()
        self.emit("current-x-rel-position", relative[0])
        self.emit("current-position", position, tuple(relative), dtg, s.joint_actual_position)
        self.emit("following-error", [s.joint[n]["ferror_current"] for n in range(s.joints)])

    def forced_update(self):
        """Everything again, from the safe state on: for a widget that was just made."""
        try:
            self.merge()
        except linuxcnc.error:
            self.emit("state-off")
            self.emit("interp-idle")
            return
        self.emit("state-off")
        self.emit("interp-idle")
        self._status_active = True
        self._emit_changes({})
        self.emit("jograte-changed", self.current_jog_rate)
        self.emit("jograte-angular-changed", self.angular_jog_velocity)
        self.emit("forced-update")

    # ---- questions ----

    def get_position(self):
        """(actual, relative, distance to go), nine numbers each, machine units."""
        s = self.stat
        actual = s.actual_position
        rel = [a - g - t for a, g, t in zip(actual, s.g5x_offset, s.tool_offset)]
        angle = math.radians(-s.rotation_xy)
        x, y = rel[0], rel[1]
        rel[0] = x * math.cos(angle) - y * math.sin(angle)
        rel[1] = x * math.sin(angle) + y * math.cos(angle)
        rel = [r - g for r, g in zip(rel, s.g92_offset)]
        return actual, rel, s.dtg

    def check_for_modes(self, *modes):
        self.stat.poll()
        mode = self.stat.task_mode
        premode = None
        if not modes:
            return (premode, mode)
        if mode == modes[0] or (isinstance(modes[0], (list, tuple)) and mode in modes[0]):
            return (True, mode)
        if mode == self.AUTO and self.stat.interp_state != linuxcnc.INTERP_IDLE:
            return (None, mode)
        return (False, mode)

    def get_current_mode(self):
        return self.old["mode"]

    def get_previous_mode(self):
        return self.previous_mode

    def get_jograte(self):
        return self.current_jog_rate

    def set_jograte(self, rate):
        self.current_jog_rate = rate
        self.emit("jograte-changed", rate)
        self._send("jograte-changed", rate)

    def get_jograte_angular(self):
        return self.angular_jog_velocity

    def set_jograte_angular(self, rate):
        self.angular_jog_velocity = rate
        self.emit("jograte-angular-changed", rate)
        self._send("jograte-angular-changed", rate)

    def get_jog_increment(self):
        return self.current_jog_distance

    def set_jog_increments(self, distance, text):
        try:
            isinstance(float(distance), float)
        except (TypeError, ValueError):
            print("error converting jog increment to a number - set to 0")
            distance = 0
        self.current_jog_distance, self.current_jog_distance_text = float(distance), text
        self.emit("jogincrement-changed", float(distance), text)
        self._send("jogincrements-changed", [float(distance), text])

    def get_jog_increment_angular(self):
        return self.current_jog_distance_angular

    def set_jog_increment_angular(self, distance, text):
        self.current_jog_distance_angular, self.current_jog_distance_angular_text = float(distance), text
        self.emit("jogincrement-angular-changed", float(distance), text)
        self._send("jogincrements-angular-changed", [float(distance), text])

    def get_max_velocity(self):
        return self.stat.max_velocity * 60.0

    def set_selected_joint(self, joint):
        if isinstance(joint, int):
            self.selected_joint = joint
            self.emit("joint-selection-changed", joint)
            self._send("joint-selection-changed", joint)
        else:
            print("Selected joint must be an integer: %s" % joint)

    def get_selected_joint(self):
        return self.selected_joint

    def set_selected_axis(self, axis):
        if isinstance(axis, str):
            self.selected_axis = axis.upper()
            self.emit("axis-selection-changed", self.selected_axis)
            self._send("axis-selection-changed", self.selected_axis)
        else:
            print("Selected axis must be a string: %s" % axis)

    def get_selected_axis(self):
        return self.selected_axis

    def _fresh(self):
        self.stat.poll()
        return self.stat

    def is_joint_homed(self, joint):
        return bool(self._fresh().homed[joint])

    def is_all_homed(self):
        s = self._fresh()
        return all(s.homed[:s.joints])

    def is_homing(self):
        s = self._fresh()
        return any(s.joint[n]["homing"] for n in range(s.joints))

    def machine_is_on(self):
        return self.old["state"] > linuxcnc.STATE_ESTOP_RESET

    def estop_is_clear(self):
        return self._fresh().task_state > linuxcnc.STATE_ESTOP

    def is_man_mode(self):
        return self._fresh().task_mode == linuxcnc.MODE_MANUAL

    def is_mdi_mode(self):
        return self._fresh().task_mode == linuxcnc.MODE_MDI

    def is_auto_mode(self):
        return self._fresh().task_mode == linuxcnc.MODE_AUTO

    def is_on_and_idle(self):
        s = self._fresh()
        return s.task_state > linuxcnc.STATE_OFF and s.interp_state == linuxcnc.INTERP_IDLE

    def is_auto_running(self):
        s = self._fresh()
        return s.task_mode == linuxcnc.MODE_AUTO and s.interp_state != linuxcnc.INTERP_IDLE

    def is_auto_paused(self):
        return bool(self.old.get("paused"))

    def is_interp_running(self):
        return self._fresh().interp_state != linuxcnc.INTERP_IDLE

    def is_interp_paused(self):
        return self._fresh().interp_state == linuxcnc.INTERP_PAUSED

    def is_interp_reading(self):
        return self._fresh().interp_state == linuxcnc.INTERP_READING

    def is_interp_waiting(self):
        return self._fresh().interp_state == linuxcnc.INTERP_WAITING

    def is_interp_idle(self):
        return self._fresh().interp_state == linuxcnc.INTERP_IDLE

    def is_file_loaded(self):
        return bool(self._fresh().file)

    def is_metric_mode(self):
        return 210 in (self.old.get("g_codes") or ())

    def is_spindle_on(self, num=0):
        return bool(self._fresh().spindle[num]["enabled"])

    def get_spindle_speed(self, num=0):
        return self._fresh().spindle[num]["speed"]

    def is_joint_mode(self):
        return self._fresh().motion_mode == linuxcnc.TRAJ_MODE_FREE

    def is_world_mode(self):
        return self._fresh().motion_mode == linuxcnc.TRAJ_MODE_TELEOP

    def is_status_valid(self):
        return self._status_active

    def is_limits_override_set(self):
        return any(self.old.get("override_limits") or ())

    def is_hard_limits_tripped(self):
        return any(a or b for a, b in self.old.get("hard_limits") or ())

    def get_current_tool(self):
        return self._fresh().tool_in_spindle

    def get_linuxcnc_version(self):
        return linuxcnc.version

    def get_current_command(self):
        return self._fresh().command

    def get_probed_position(self):
        return self._fresh().probed_position

    def get_probed_position_with_offsets(self):
        s = self._fresh()
        p = [v - g - w - t for v, g, w, t in zip(s.probed_position, s.g5x_offset, s.g92_offset, s.tool_offset)]
        return p

    def get_jjogmode(self):
        return self.JOGJOINT if self._fresh().motion_mode == linuxcnc.TRAJ_MODE_FREE else self.JOGTELEOP

    def jnum_for_axisnum(self, axisnum):
        if self._fresh().kinematics_type != linuxcnc.KINEMATICS_IDENTITY or not 0 <= axisnum < len(AXES):
            print("no joint for axis number %s with these kinematics" % axisnum)
            return -1
        return self._coordinates.find(AXES[axisnum])

    def get_jog_info(self, axisnum):
        mode = self.get_jjogmode()
        return mode, self.jnum_for_axisnum(axisnum) if mode == self.JOGJOINT else axisnum

    # ---- actions ----

    def _mdi(self, *lines):
        mode = self._fresh().task_mode
        if mode != linuxcnc.MODE_MDI:
            self.cmd.mode(linuxcnc.MODE_MDI)
            self.cmd.wait_complete()
        for line in lines:
            self.cmd.mdi(line)
            self.cmd.wait_complete()
        if mode != linuxcnc.MODE_MDI:
            self.cmd.mode(mode)
            self.cmd.wait_complete()

    def set_tool_touchoff(self, tool, axis, value):
        self._mdi("G10 L10 P%s %s%f" % (tool, axis, value), "g43")

    def set_axis_origin(self, axis, value):
        self._mdi("G10 L20 P0 %s%f" % (axis, value))
        self.emit("reload-display")

    def do_jog(self, axisnum, direction, distance=0):
        mode, number = self.get_jog_info(axisnum)
        if mode == self.JOGJOINT and number < 0:
            return
        if direction == 0:
            self.cmd.jog(linuxcnc.JOG_STOP, mode, number)
            return
        rate = self.angular_jog_velocity if axisnum in (3, 4, 5) else self.current_jog_rate / 60
        if distance == 0:
            self.cmd.jog(linuxcnc.JOG_CONTINUOUS, mode, number, direction * rate)
        else:
            self.cmd.jog(linuxcnc.JOG_INCREMENT, mode, number, direction * rate, distance)

    def shutdown(self):
        self.emit("shutdown")

    def request_cycle_start(self, data):
        self.emit("cycle-start-request", data)

    def request_cycle_pause(self, data):
        self.emit("cycle-pause-request", data)

    def request_macro_call(self, data):
        self.emit("macro-call-request", data)

    def request_reload_display(self, data=None):
        self.emit("reload-display")

    def request_shutdown(self):
        self.emit("shutdown-request")

    def request_ok(self, data):
        self.emit("ok-request", data)

    def request_cancel(self, data):
        self.emit("cancel-request", data)

    # ---- the bridge to other programs (only with the Python module zmq) ----

    def _zmq(self):
        self._out = self._in = None
        try:
            import zmq
        except ImportError:
            return
        context = zmq.Context.instance()
        try:
            self._out = context.socket(zmq.PUB)
            self._out.bind(f"tcp://127.0.0.1:{instance.port(5690)}")
        except zmq.ZMQError:
            self._out = None
        self._in = context.socket(zmq.SUB)
        self._in.connect(f"tcp://127.0.0.1:{instance.port(5691)}")
        self._in.setsockopt_string(zmq.SUBSCRIBE, "STATUSREQUEST")
        GLib.io_add_watch(self._in.getsockopt(zmq.FD), GLib.IO_IN | GLib.IO_ERR | GLib.IO_HUP, self._requested)

    def _requested(self, *_):
        import zmq
        while self._in.getsockopt(zmq.EVENTS) & zmq.POLLIN:
            try:
                _topic, data = self._in.recv_multipart()
                request = json.loads(data)
                function = getattr(self, request["FUNCTION"])
                if request["ARGS"] == "":
                    function()
                else:
                    function(request["ARGS"])
            except Exception:
                pass
        return True

    def _send(self, message, data):
        if self._out:
            self._out.send_multipart([b"STATUS", json.dumps({"MESSAGE": message, "ARGS": [data]}).encode()])
