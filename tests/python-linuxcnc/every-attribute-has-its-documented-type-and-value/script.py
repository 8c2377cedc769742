# SPDX-License-Identifier: GPL-2.0-or-later
# The tables of the manual: constants, attributes of stat with type and the value of a machine
# that was just started, methods of command.
import signal

from mill import *

NINE, SIXTEEN, SIXTYFOUR = (0.0,) * 9, (0,) * 16, (0,) * 64
OFF_JOINT = dict(jointType=1, units=1.0, backlash=0.0, min_position_limit=-400.0, max_position_limit=400.0,
                 max_ferror=1.0, min_ferror=0.2, ferror_current=0.0,
                 ferror_highmark=0.0, output=0.0, input=0.0, velocity=0.0, inpos=1, homing=0, homed=0, fault=0,
                 enabled=0, min_soft_limit=0, max_soft_limit=0, min_hard_limit=0, max_hard_limit=0, override_limits=0)
SPINDLE = dict(brake=1, direction=0, enabled=0, override_enabled=True, speed=0.0, override=1.0, homed=False,
               orient_state=0, orient_fault=0)
ANY = object()
at_start = dict(
    acceleration=ANY, active_queue=0, actual_position=NINE, adaptive_feed_enabled=False, ain=(0.0,) * 64,
    aout=(0.0,) * 64, angular_units=1.0, axis_mask=7,
    block_delete=True, call_level=0, command="", current_line=0, current_vel=0.0, cycle_time=0.001, debug=0,
    delay_left=0.0, din=SIXTYFOUR, dout=SIXTYFOUR, distance_to_go=0.0, dtg=NINE, echo_serial_number=ANY, enabled=False,
    estop=1, exec_state=EXEC_DONE, feed_hold_enabled=True, feed_override_enabled=True,
    feedrate=1.0, file="", flood=0, mist=0, g5x_index=1, g5x_offset=NINE, g92_offset=NINE, tool_offset=NINE,
    gcodes=(0, 800, -1, 170, 400, 210, 900, 940, 540, 490, 990, 640, -1, 970, 911, 80, -1), heartbeat=ANY,
    homed=SIXTEEN, ini_filename=ANY, inpos=True, input_timeout=False, interp_state=INTERP_IDLE, interpreter_errcode=0,
    joint_actual_position=(0.0,) * 16, joint_position=(0.0,) * 16, joints=3,
    kinematics_type=KINEMATICS_IDENTITY, limit=SIXTEEN, linear_units=1.0, max_acceleration=ANY, max_velocity=200.0,
    mcodes=(0, -1, 5, -1, 9, -1, 48, -1, 53, -1), misc_error=SIXTYFOUR, motion_id=0, motion_line=0,
    motion_mode=TRAJ_MODE_FREE, motion_type=0, num_extrajoints=0, optional_stop=True, paused=False,
    pocket_prepped=-1, position=NINE, probe_tripped=False, probing=False, probe_val=0, probed_position=NINE,
    program_units=2, queue=0, queue_full=False, queued_mdi_commands=0, rapidrate=1.0, read_line=0, rotation_xy=0.0,
    settings=ANY, single_stepping=False, spindles=1, state=RCS_DONE,
    task_mode=MODE_MANUAL, task_state=STATE_ESTOP, task_paused=0, taskbeat=ANY, tool_from_pocket=0,
    tool_in_spindle=0, velocity=ANY)
floats = "acceleration angular_units current_vel cycle_time delay_left distance_to_go feedrate linear_units max_acceleration max_velocity rapidrate rotation_xy velocity".split()
nine_floats = "actual_position dtg g5x_offset g92_offset tool_offset position probed_position".split()
bools = ("adaptive_feed_enabled block_delete enabled feed_hold_enabled feed_override_enabled inpos input_timeout "
         "optional_stop paused probe_tripped probing queue_full "
         "single_stepping").split()
texts = "command file ini_filename".split()
shapes = dict(ain=(64, float), aout=(64, float), din=(64, int), dout=(64, int), gcodes=(17, int), mcodes=(10, int),
              homed=(16, int), limit=(16, int), misc_error=(64, int),
              settings=(5, float), joint_position=(16, float), joint_actual_position=(16, float))


def different(name, value):
    got = getattr(s, name)
    if name in nine_floats:
        good = isinstance(got, tuple) and len(got) == 9 and all(type(v) is float for v in got)
    elif name in shapes:
        good = isinstance(got, tuple) and len(got) == shapes[name][0] and all(type(v) is shapes[name][1] for v in got)
    else:
        good = type(got) is (float if name in floats else bool if name in bools else str if name in texts else int)
    if not good:
        return f"{name}: type of {got!r}"
    if value is not ANY and got != value:
        return f"{name}: {got!r}, not {value!r}"


poll()
need(lambda s: s.heartbeat > 0 and s.state == RCS_DONE, "motion")
print("attributes:", [d for d in (different(n, v) for n, v in at_start.items()) if d])
dicts = {"joint": (16, OFF_JOINT), "axis": (9, dict(velocity=0.0, min_position_limit=-400.0, max_position_limit=400.0)),
         "spindle": (8, SPINDLE)}
for name, (count, first) in dicts.items():
    value = getattr(s, name)
    print(name, type(value).__name__, len(value) == count,
          {k: (v, value[0].get(k))
           for k, v in first.items() if value[0].get(k) != v or type(value[0][k]) is not type(v)},
          sorted(set(value[0]) ^ set(first)), all(set(v) == set(first) for v in value))
known = set(at_start) | set(dicts) | {"tool_table", "poll", "toolinfo"}
print("more than documented:", sorted(n for n in dir(s) if not n.startswith("_") and n not in known), "missing:",
      sorted(n for n in known if not hasattr(s, n)))
print("settings:", tuple(round(v, 4) for v in s.settings), "beats:", s.taskbeat > 0, s.heartbeat > 0,
      s.ini_filename.endswith("mill.ini"))
t = s.tool_table
print("tools:", type(t).__name__, len(t), type(t[0]).__name__, t[0].id, t[0].n_fields, t[0] == tuple(t[0]),
      [f for f in dir(t[0]) if f.endswith("offset")])
print("toolinfo:", s.toolinfo(1))
for number in (0, 77):
    try:
        s.toolinfo(number)
    except ValueError as mistake:
        print(repr(str(mistake)))
old = s.taskbeat
sleep(0.1)
print("a snapshot:", s.taskbeat == old, poll().taskbeat > old)

constants = dict(
    OPERATOR_ERROR=11, NML_ERROR=1, OPERATOR_TEXT=12, NML_TEXT=2, OPERATOR_DISPLAY=13, NML_DISPLAY=3, LINEAR=1,
    ANGULAR=2, INTERP_IDLE=1, INTERP_READING=2, INTERP_PAUSED=3,
    INTERP_WAITING=4, MODE_MANUAL=1, MODE_AUTO=2, MODE_MDI=3, STATE_ESTOP=1, STATE_ESTOP_RESET=2, STATE_OFF=3,
    STATE_ON=4, SPINDLE_FORWARD=1, SPINDLE_REVERSE=-1, SPINDLE_OFF=0,
    SPINDLE_INCREASE=10, SPINDLE_DECREASE=11, SPINDLE_CONSTANT=12, MIST_ON=1, MIST_OFF=0, FLOOD_ON=1, FLOOD_OFF=0,
    BRAKE_ENGAGE=1, BRAKE_RELEASE=0, JOG_STOP=0, JOG_CONTINUOUS=1,
    JOG_INCREMENT=2, AUTO_RUN=0, AUTO_PAUSE=1, AUTO_RESUME=2, AUTO_STEP=3, AUTO_REVERSE=4, AUTO_FORWARD=5,
    TRAJ_MODE_FREE=1, TRAJ_MODE_COORD=2, TRAJ_MODE_TELEOP=3,
    MOTION_TYPE_TRAVERSE=1, MOTION_TYPE_FEED=2, MOTION_TYPE_ARC=3, MOTION_TYPE_TOOLCHANGE=4, MOTION_TYPE_PROBING=5,
    MOTION_TYPE_INDEXROTARY=6, KINEMATICS_IDENTITY=1,
    KINEMATICS_FORWARD_ONLY=2, KINEMATICS_INVERSE_ONLY=3, KINEMATICS_BOTH=4, DEBUG_CONFIG=0x2, DEBUG_VERSIONS=0x8,
    DEBUG_TASK_ISSUE=0x10, DEBUG_NML=0x40, DEBUG_MOTION_TIME=0x80,
    DEBUG_INTERP=0x100, DEBUG_RCS=0x200, DEBUG_INTERP_LIST=0x800, DEBUG_OWORD=0x2000, DEBUG_REMAP=0x4000,
    DEBUG_PYTHON=0x8000, DEBUG_STATE_TAGS=0x80000, EXEC_ERROR=1, EXEC_DONE=2,
    EXEC_WAITING_FOR_MOTION=3, EXEC_WAITING_FOR_MOTION_QUEUE=4, EXEC_WAITING_FOR_IO=5, EXEC_WAITING_FOR_MOTION_AND_IO=7,
    EXEC_WAITING_FOR_DELAY=8, EXEC_WAITING_FOR_SYSTEM_CMD=9,
    EXEC_WAITING_FOR_SPINDLE_ORIENTED=10, MAX_JOINTS=16, MAX_AXIS=9, RCS_DONE=1, RCS_EXEC=2, RCS_ERROR=3)
import linuxcnc as module
print("constants:", {n: v for n, v in constants.items() if getattr(module, n, None) != v},
      sorted(n for n in dir(module) if n.isupper() and n not in constants and n not in ("PREFIX", "SHARE")))
print("strings:", all(isinstance(getattr(module, n), str) for n in ("PREFIX", "SHARE", "nmlfile", "version")),
      module.SHARE == module.PREFIX + "/share", issubclass(module.error, RuntimeError))

methods = ("abort auto brake debug display_msg error_msg feedrate flood home jog load_tool_table maxvel mdi mist mode "
           "override_limits program_open rapidrate reset_interpreter "
           "set_adaptive_feed set_analog_output set_block_delete set_digital_output set_feed_hold set_feed_override "
           "set_max_limit set_min_limit set_optional_stop "
           "set_spindle_override spindle spindleoverride state task_plan_synch teleop_enable text_msg tool_offset "
           "traj_mode unhome wait_complete").split()
print("methods:", [m for m in methods if not callable(getattr(c, m, None))])

print("== methods and what they bring about")
on()


def effect(what, call, look, within=2.0):
    """After the call returns None, look(stat) becomes true."""
    result = call()
    print(what, "" if result is None else f"returned {result!r}", "yes" if until(look, within) else "no",
          messages() or "")


mode(MODE_MANUAL)
effect("debug", lambda: c.debug(16), lambda s: s.debug == 16)
c.debug(0)
effect("feedrate", lambda: c.feedrate(0.5), lambda s: s.feedrate == 0.5)
effect("feedrate above the INI's limit", lambda: c.feedrate(3), lambda s: s.feedrate == 3)
effect("rapidrate", lambda: c.rapidrate(5.0), lambda s: s.rapidrate == 5)
c.feedrate(1)
c.rapidrate(1)
effect("maxvel", lambda: c.maxvel(1000), lambda s: s.max_velocity == 1000)
effect("maxvel negative", lambda: c.maxvel(-5), lambda s: s.max_velocity == 0)
c.maxvel(200)
effect("spindleoverride", lambda: c.spindleoverride(0.8), lambda s: s.spindle[0]["override"] == 0.8)
effect("spindleoverride 2", lambda: c.spindleoverride(1.0, 0), lambda s: s.spindle[0]["override"] == 1)
effect("flood", lambda: c.flood(FLOOD_ON), lambda s: s.flood == 1)
effect("flood off", lambda: c.flood(FLOOD_OFF), lambda s: s.flood == 0)
effect("mist", lambda: c.mist(MIST_ON), lambda s: s.mist == 1)
effect("mist off", lambda: c.mist(MIST_OFF), lambda s: s.mist == 0)
effect("brake off", lambda: c.brake(BRAKE_RELEASE), lambda s: s.spindle[0]["brake"] == 0)
effect("brake on", lambda: c.brake(BRAKE_ENGAGE, 0), lambda s: s.spindle[0]["brake"] == 1)
effect("spindle forward", lambda: c.spindle(SPINDLE_FORWARD, 500),
       lambda s: s.spindle[0]["speed"] == 500 and s.spindle[0]["direction"] == 1 and s.spindle[0]["enabled"] == 1)
effect("spindle increase", lambda: c.spindle(SPINDLE_INCREASE), lambda s: s.spindle[0]["speed"] == 600)
effect("spindle decrease", lambda: c.spindle(SPINDLE_DECREASE, 0), lambda s: s.spindle[0]["speed"] == 500)
effect("spindle reverse", lambda: c.spindle(SPINDLE_REVERSE, 300, 0, 0),
       lambda s: s.spindle[0]["speed"] == -300 and s.spindle[0]["direction"] == -1)
effect("spindle off", lambda: c.spindle(SPINDLE_OFF),
       lambda s: s.spindle[0]["speed"] == 0 and s.spindle[0]["brake"] == 1)
effect("set_digital_output", lambda: c.set_digital_output(3, 1), lambda s: s.dout[3] == 1)
effect("set_analog_output", lambda: c.set_analog_output(2, 1.5), lambda s: s.aout[2] == 1.5)
effect("set_adaptive_feed", lambda: c.set_adaptive_feed(1), lambda s: s.adaptive_feed_enabled)
c.set_adaptive_feed(0)
effect("set_feed_hold", lambda: c.set_feed_hold(0), lambda s: not s.feed_hold_enabled)
c.set_feed_hold(1)
effect("set_feed_override", lambda: c.set_feed_override(0), lambda s: not s.feed_override_enabled)
c.set_feed_override(1)
effect("set_spindle_override", lambda: c.set_spindle_override(0, 0), lambda s: not s.spindle[0]["override_enabled"])
c.set_spindle_override(1)
effect("set_block_delete", lambda: c.set_block_delete(0), lambda s: s.block_delete is False)
effect("set_optional_stop", lambda: c.set_optional_stop(0), lambda s: s.optional_stop is False)
effect("set_min_limit", lambda: c.set_min_limit(0, -50), lambda s: s.joint[0]["min_position_limit"] == -50)
effect("set_max_limit", lambda: c.set_max_limit(0, 50), lambda s: s.joint[0]["max_position_limit"] == 50)
print("axis limits stay:", s.axis[0]["max_position_limit"])
effect("teleop_enable", lambda: c.teleop_enable(1), lambda s: s.motion_mode == TRAJ_MODE_TELEOP)
effect("unhome in teleop", lambda: c.unhome(0), lambda s: s.homed[0] == 0, 0.1)
effect("jog increment", lambda: c.jog(JOG_INCREMENT, 0, 0, 20, 2), lambda s: abs(s.position[0] - 2) < 1e-6)
effect("teleop_enable 0", lambda: c.teleop_enable(0), lambda s: s.motion_mode == TRAJ_MODE_FREE)
effect("jog", lambda: c.jog(JOG_CONTINUOUS, 1, 1, -20), lambda s: s.joint[1]["velocity"] < -19)
effect("jog stop", lambda: c.jog(JOG_STOP, 1, 1), lambda s: s.joint[1]["velocity"] == 0)
effect("unhome", lambda: c.unhome(1), lambda s: s.homed[:3] == (1, 0, 1))
effect("home", lambda: c.home(1), lambda s: s.homed[1] == 1)
effect("override_limits", lambda: c.override_limits(), lambda s: s.state == RCS_DONE)
effect("traj_mode is refused", lambda: c.traj_mode(TRAJ_MODE_COORD), lambda s: s.state == RCS_ERROR)
effect("display_msg", lambda: c.display_msg("one"), lambda s: True)
effect("error_msg", lambda: c.error_msg("ä" * 200), lambda s: True)
c.text_msg("three")
until(lambda s: False, 0.01)
print(e.poll(), e.poll())
effect("mode", lambda: c.mode(MODE_MDI), lambda s: s.task_mode == MODE_MDI)
effect("mdi", lambda: c.mdi(b"G0 X5"), lambda s: abs(s.position[0] - 5) < 1e-6)
effect("mdi empty", lambda: c.mdi(""), lambda s: s.state == RCS_DONE)
effect("task_plan_synch", lambda: c.task_plan_synch(), lambda s: s.state == RCS_DONE)
effect("load_tool_table", lambda: c.load_tool_table(), lambda s: s.state == RCS_DONE)
effect("tool_offset", lambda: c.tool_offset(1, 33.0, 2.0, 8.0, 10.0, 20.0, 3),
       lambda s: (s.tool_table[0].zoffset, s.tool_table[0].xoffset, s.tool_table[0].diameter) == (33, 2, 8))
Path("a.ngc").write_text("G0 X1\nG4 P1\nM2\n")
effect("program_open", lambda: c.program_open("a.ngc"), lambda s: s.file.endswith("a.ngc"))
Path("b.ngc").write_text("M2\n")
effect("program_open of bytes", lambda: c.program_open(b"b.ngc"), lambda s: s.file.endswith("b.ngc"))
effect("program_open of a Path", lambda: c.program_open(Path("a.ngc")), lambda s: s.file.endswith("a.ngc"))
file = s.file
c.program_open("nothing.ngc")
print("a missing file:", c.wait_complete(), poll().file == file, messages())
effect("reset_interpreter", lambda: c.reset_interpreter(), lambda s: s.state == RCS_DONE)
mode(MODE_AUTO)
effect("auto step", lambda: c.auto(AUTO_STEP), lambda s: s.interp_state == INTERP_PAUSED and s.task_paused == 1)
effect("auto resume", lambda: c.auto(AUTO_RESUME), lambda s: s.interp_state == INTERP_IDLE and s.task_paused == 0)
effect("auto run", lambda: c.auto(AUTO_RUN, 0), lambda s: s.interp_state != INTERP_IDLE)
effect("auto pause", lambda: c.auto(AUTO_PAUSE), lambda s: s.task_paused == 1)
effect("abort", lambda: c.abort(), lambda s: s.interp_state == INTERP_IDLE and s.task_paused == 0)
effect("state", lambda: c.state(STATE_OFF), lambda s: s.task_state == STATE_ESTOP_RESET)
effect("estop", lambda: c.state(STATE_ESTOP), lambda s: s.task_state == STATE_ESTOP and s.estop == 1)

print("== waiting (FP-121)")
on(home=False)
print("done", mdi("G4 P0.1", 5), "failed", mdi("G1 F0 X1", 5), messages())
c.mdi("G4 P20")
begin = clock.now()
print("timed out", c.wait_complete(1.5), round(clock.now() - begin, 2), "default", c.wait_complete(),
      round(clock.now() - begin, 1))
c.mdi("G0 X0")
print("of a later one", c.wait_complete(60), round(clock.now() - begin), c.serial == poll().echo_serial_number, "zero",
      c.wait_complete(0))
c.mdi("G4 P1000000")
print("times that are none:", [c.wait_complete(t) for t in (-1, float("nan"), -1e300, 0)])


class Interrupted(Exception):
    pass


def interrupt(*_):
    raise Interrupted


signal.signal(signal.SIGALRM, interrupt)
signal.setitimer(signal.ITIMER_REAL, 0.2)
try:
    print("not interrupted:", c.wait_complete(1e300))
except Interrupted:
    print("a signal ends a long wait:", poll().interp_state != INTERP_IDLE)
c.abort()
