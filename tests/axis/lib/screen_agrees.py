# SPDX-License-Identifier: GPL-2.0-or-later
"""What the screen shows beside what the machine tells, by the rules of the GUI reference, written anew here."""

import math
import os

import linuxcnc

LETTERS = "XYZABCUVW"
SYSTEMS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")
GROUP = ("jogf.zerohome.home", "jogf.jog.jogplus", "jogf.jog.jogminus", "spindlef.cw", "spindlef.ccw", "spindlef.stop",
         "spindlef.brake", "flood", "mist")
MANUAL, MDI = ".pane.top.tabs.fmanual", ".pane.top.tabs.fmdi"


def all_of_it(op):
    """Texts about each place where the screen differs from the machine, which rests or goes on evenly."""
    op.root.update()
    op.app.tick()
    op.root.update()
    s = op.stat
    for part in (variables, widgets, reliefs, codes, readout, status_bar, program, pins):
        for text in part(op, s):
            yield text


def variables(op, s):
    v = op.app.vars
    pairs = {"task_state": s.task_state, "task_mode": s.task_mode, "interp_state": s.interp_state,
             "spindledir": s.spindle[0]["direction"], "flood": bool(s.flood), "mist": bool(s.mist),
             "brake": bool(s.spindle[0]["brake"]), "feedrate": round(100 * s.feedrate),
             "rapidrate": round(100 * s.rapidrate), "spindlerate": round(100 * s.spindle[0]["override"]),
             "task_paused": int(s.task_paused), "optional_stop": int(s.optional_stop),
             "block_delete": int(s.block_delete), "motion_mode": s.motion_mode,
             "teleop_mode": int(s.motion_mode == linuxcnc.TRAJ_MODE_TELEOP),
             "queued_mdi_commands": s.queued_mdi_commands, "on_any_limit": int(any(s.limit)),
             "override_limits": int(s.joint[0]["override_limits"])}
    for name, value in pairs.items():
        if getattr(v, name).get() != value:
            yield f"{name}: screen {getattr(v, name).get()!r}, machine {value!r}"
    top = op.app.settings.max_velocity
    shown = op.app.to_machine(v.maxvel_speed.get()) / 60
    if abs(shown - min(top, s.max_velocity)) > 2e-3 * top:
        yield f"highest velocity: screen {shown}, machine {s.max_velocity}"


def rules(op, s):
    """(place, wanted): buttons by path, entries of menus by (menu, label)."""
    on, idle, file = s.task_state == linuxcnc.STATE_ON, s.interp_state == linuxcnc.INTERP_IDLE, bool(s.file)
    ready, lim = on and idle, any(s.limit)
    identity = s.kinematics_type == linuxcnc.KINEMATICS_IDENTITY
    touch = ready and (s.motion_mode != linuxcnc.TRAJ_MODE_FREE or identity)
    mdi = on and s.queued_mdi_commands < op.app.vars.max_queued_mdi_commands.get()
    yield ".toolbar.machine_power", s.task_state != linuxcnc.STATE_ESTOP
    yield ("machine", "Toggle Machine Power"), s.task_state != linuxcnc.STATE_ESTOP
    for place in (".toolbar.reload", ("file", "Reload")):
        yield place, idle and file
    for place in (("file", "Save G-code as..."), ("file", "G-code properties...")):
        yield place, file
    for place in (".toolbar.file_open", ("file", "Open..."), ("file", "Quit"), ("file", "Recent Files"),
                  ".toolbar.program_blockdelete", ("machine", "Skip lines with '/'"), ("file", "Edit tool data...")):
        yield place, idle
    for place in (".toolbar.program_run", ("machine", "Run program"), ("file", "Reload tool data"),
                  ("machine", "Homing"), ("machine", "Unhoming"), ("machine", "Zero coordinate system"),
                  *(f"{MANUAL}.{w}" for w in GROUP), *(f"{MANUAL}.axes.axis{c.lower()}" for c in op.app.settings.axes)):
        yield place, ready
    for place in (".toolbar.program_step", ("machine", "Step")):
        yield place, on and file
    yield ("machine", "Pause"), on and s.interp_state in (linuxcnc.INTERP_READING, linuxcnc.INTERP_WAITING)
    yield ("machine", "Resume"), on and s.interp_state == linuxcnc.INTERP_PAUSED
    for place in (".toolbar.program_pause", ".toolbar.program_stop", ("machine", "Stop")):
        yield place, on and not idle
    yield ("machine", "Run from selected line"), ready and op.app.vars.highlight_line.get() > 0
    for place in (f"{MANUAL}.spindlef.spindleminus", f"{MANUAL}.spindlef.spindleplus"):
        yield place, ready and s.spindle[0]["direction"] != 0
    yield f"{MANUAL}.jogf.zerohome.zero", touch
    yield f"{MANUAL}.jogf.zerohome.tooltouch", touch and s.tool_in_spindle > 0
    yield f"{MANUAL}.jogf.override", lim
    for place in ("command", "go", "history"):
        yield f"{MDI}.{place}", mdi


def entry_state(op, menu, label):
    """State of a menu's entry, or "not there"."""
    tcl, path = op.root.tk, f".menu.{menu}"
    for i in range(int(tcl.call(path, "index", "end")) + 1):
        if tcl.call(path, "type", i) in ("separator", "tearoff"):
            continue
        if str(tcl.call(path, "entrycget", i, "-label")) == label:
            return str(tcl.call(path, "entrycget", i, "-state"))
    return "not there"


def widgets(op, s):
    tcl = op.root.tk
    for place, wanted in rules(op, s):
        state = entry_state(op, *place) if isinstance(place, tuple) else str(tcl.call(place, "cget", "-state"))
        if state == "not there" or (state != "disabled") != wanted:
            yield f"{place}: {state}, should be {'normal' if wanted else 'disabled'}"
    joints = s.motion_mode == linuxcnc.TRAJ_MODE_FREE and s.kinematics_type != linuxcnc.KINEMATICS_IDENTITY
    for frame, wanted in (("axes", not joints), ("joints", joints)):
        if bool(str(tcl.call("winfo", "manager", f"{MANUAL}.{frame}"))) != wanted:
            yield f"{frame} are {'not ' if wanted else ''}shown"
    if op.app.vars.ja_rbutton.get().isdigit() != joints:
        yield f"selected {op.app.vars.ja_rbutton.get()}, joints {joints}"


def reliefs(op, s):
    idle = s.interp_state == linuxcnc.INTERP_IDLE
    for name, pressed in (("machine_estop", s.task_state == linuxcnc.STATE_ESTOP),
                          ("machine_power", s.task_state == linuxcnc.STATE_ON), ("program_run", not idle),
                          ("program_stop", idle), ("program_pause", s.task_paused),
                          ("program_blockdelete", s.block_delete), ("program_optpause", s.optional_stop)):
        relief = str(op.root.tk.call(f".toolbar.{name}", "cget", "-relief"))
        if (relief == "sunken") != bool(pressed):
            yield f"{name}: {relief}, pressed should be {bool(pressed)}"


def codes(op, s):
    words = [f"G{g // 10}" + (f".{g % 10}" if g % 10 else "") for g in s.gcodes[1:] if g != -1]
    words += [f"M{m}" for m in s.mcodes[1:] if m != -1]
    feed = f"F{s.settings[1]:.1f}"
    wanted = " ".join([*words, feed[:-2] if feed.endswith(".0") else feed, f"S{s.settings[2]:.0f}"])
    shown = op.app.widgets.code_text.get("1.0", "end").strip()
    if shown != wanted:
        yield f"active codes: {shown!r}, machine {wanted!r}"


def readout(op, s):
    """Positions of the display, where nothing moves."""
    app, v = op.app, op.app.vars
    if any(abs(j["velocity"]) > 0 for j in s.joint[:s.joints]):
        return
    lines = app.widgets.numbers_text.get("1.0", "end").splitlines()
    if app.joints_shown:
        wanted = {str(n): s.joint_actual_position[n] for n in range(s.joints)}
    else:
        p = list(s.position if v.display_type.get() else s.actual_position)
        if v.coord_type.get():
            p = [a - t - g for a, t, g in zip(p, s.tool_offset, s.g5x_offset)]
            t = math.radians(-s.rotation_xy)
            p[0], p[1] = p[0] * math.cos(t) - p[1] * math.sin(t), p[0] * math.sin(t) + p[1] * math.cos(t)
            p = [a - g for a, g in zip(p, s.g92_offset)]
        scale = (1 if v.metric.get() else 1 / 25.4) / s.linear_units
        wanted = {c: p[i] * (1 if c in "ABC" else scale) for i, c in enumerate(LETTERS) if s.axis_mask & 1 << i}
        if app.settings.lathe:
            wanted = {"Rad" if c == "X" else c: x for c, x in wanted.items()} | {"Dia": 2 * wanted["X"]}
    shown = {}
    for line in lines:
        name, colon, rest = line.partition(":")
        if colon and rest.split():
            shown[name.strip()] = float(rest.split()[0])
    for name, value in wanted.items():
        if name not in shown or abs(shown[name] - value) > 1.1e-3:
            yield f"position {name}: {shown.get(name)}, machine {value}"
    system = SYSTEMS[s.g5x_index - 1]
    offsets = v.show_offsets.get() and not app.joints_shown
    if offsets and not any(line.strip().startswith(system + " ") for line in lines):
        yield f"{system} is not shown: {lines}"


def status_bar(op, s):
    v = op.app.vars
    state = {linuxcnc.STATE_ESTOP: "ESTOP", linuxcnc.STATE_ON: "ON"}.get(s.task_state, "OFF")
    if v.task_state_string.get() != state:
        yield f"state: {v.task_state_string.get()!r}, machine {state}"
    tool, shown = s.tool_in_spindle, v.tool.get()
    if shown != "No tool" if tool <= 0 else not shown.startswith((f"Tool {tool},", f"Unknown tool {tool}")):
        yield f"tool: {shown!r}, machine {tool}"
    if tool > 0 and s.tool_table[0].id == tool and shown.startswith("Tool"):
        entry = s.tool_table[0]
        long = op.app.settings.lathe or entry.xoffset
        wanted = \
            f"Tool {tool}, zo {entry.zoffset:g}, xo {entry.xoffset:g}, dia {entry.diameter:g}" if long else \
            f"Tool {tool}, offset {entry.zoffset:g}, diameter {entry.diameter:g}"
        if shown != wanted:
            yield f"tool: {shown!r}, machine {wanted!r}"
    wanted = ("Relative" if v.coord_type.get() else "Machine") + (" Commanded" if v.display_type.get() else " Actual")
    wanted = f"Position: {'Joint' if op.app.joints_shown else wanted}"
    if not v.position.get().startswith(wanted):
        yield f"position cell: {v.position.get()!r}, should be {wanted!r}"


def program(op, s):
    app = op.app
    same = bool(app.shown_file) and os.path.realpath(s.file) == os.path.realpath(app.shown_file)
    if s.interp_state == linuxcnc.INTERP_IDLE and s.file and app.loaded_file:
        if not same:
            yield f"program: task has {s.file}, screen shows {app.shown_file}"
        if not op.root.title().startswith(os.path.basename(app.loaded_file) + " - AXIS "):
            yield f"title: {op.root.title()}"
        with open(app.kept, errors="replace") as f:
            first = f.readline().rstrip("\n").replace("\r", "").expandtabs()
        if app.text.get("1.0", "1.end").partition(": ")[2] != first and app.code.base == 0:
            yield f"text: {app.text.get('1.0', '1.end')!r}, file {first!r}"
    marked = [str(i) for i in app.text.tag_ranges("executing")]
    if s.interp_state == linuxcnc.INTERP_IDLE and marked:
        yield f"a line is marked although nothing runs: {marked}"
    if s.paused and s.task_mode == linuxcnc.MODE_AUTO and s.motion_line > 0 and same and \
            app.vars.running_line.get() != s.motion_line:
        yield f"marked line {app.vars.running_line.get()}, machine {s.motion_line}"


def pins(op, s):
    app = op.app
    chosen = [c for c in LETTERS.lower() if app.comp[f"jog.{c}"]]
    wanted = [] if app.vars.ja_rbutton.get().isdigit() else [app.vars.ja_rbutton.get()]
    if chosen != wanted:
        yield f"axisui.jog: {chosen}, selected {wanted}"
    if bool(app.comp["error"]) != any(kind == "error" for kind, *_ in app.notifications.shown):
        yield f"axisui.error {bool(app.comp['error'])}, shown {[kind for kind, *_ in app.notifications.shown]}"
    if abs(app.comp["jog.increment"] - app.jogger.distance()) > 1e-9:
        yield f"axisui.jog.increment {app.comp['jog.increment']}, chosen {app.vars.jogincrement.get()}"
