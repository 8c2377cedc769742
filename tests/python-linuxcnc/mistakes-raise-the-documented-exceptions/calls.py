# SPDX-License-Identifier: GPL-2.0-or-later
from pathlib import Path

import linuxcnc


def call(f, *args, **options):
    shown = ", ".join(repr(a) if len(repr(a)) < 40 else "..." for a in args)
    try:
        print(f"{f.__name__}({shown}): {f(*args, **options)!r}")
    except Exception as e:
        print(f"{f.__name__}({shown}): {type(e).__module__}.{type(e).__name__}: {str(e).splitlines()[0]}")


print(issubclass(linuxcnc.error, RuntimeError), linuxcnc.error.__name__)
stat, command, errors = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()
call(stat.poll)
call(errors.poll)
call(command.abort)
call(command.wait_complete, 0.1)
print(stat.axis[0], len(stat.axis), len(stat.joint), len(stat.spindle), stat.joint[0]["homed"], stat.tool_table,
      stat.gcodes[:3], stat.homed, repr(stat.file), stat.position, stat.estop, stat.enabled,
      stat.heartbeat, stat.settings)
call(stat.toolinfo, 3)
call(command.auto, 9)
call(command.auto, linuxcnc.AUTO_RUN)
call(command.auto)
call(command.brake, 3)
call(command.flood, 2)
call(command.mist, 2)
call(command.mode, 7)
call(command.state, 0)
call(command.jog, 0, 0)
call(command.jog, linuxcnc.JOG_STOP, 0, 0, 1)
call(command.jog, linuxcnc.JOG_CONTINUOUS, 0, 0)
call(command.jog, linuxcnc.JOG_INCREMENT, 0, 0, 1)
call(command.jog, 7, 0, 0)
call(command.mdi, 5)
call(command.mdi, "x" * 255)
call(command.mdi, "G0 X1\0 Y1")
call(command.mdi, b"G0 X1\0 Y1")
call(command.error_msg, "a\0b")
call(command.set_digital_output, 300, 1)
call(command.set_feed_hold, -1)
call(command.spindle, 7)
call(command.spindle, "a")


class MyStat(linuxcnc.stat):
    pass


print(MyStat().taskbeat)
try:
    stat.taskbeat = 3
except AttributeError:
    print("attributes are read-only")
linuxcnc.nmlfile = "/nonexistent"
call(linuxcnc.stat().poll)
for linuxcnc.nmlfile in (Path("/nonexistent"), b"/nonexistent"):
    call(linuxcnc.command().abort)
linuxcnc.nmlfile = 5
for kind in linuxcnc.stat, linuxcnc.command, linuxcnc.error_channel:
    call(kind)
linuxcnc.nmlfile = "/nonexistent"
ini = linuxcnc.ini("test.ini")
call(ini.find, "EMC", "MACHINE")
call(ini.find, "EMC", "NOPE")
call(ini.find, "EMC", "NOPE", fallback="dflt")
call(ini.find, "EMC", "MACHINE", 0)
call(ini.find, "EMC", "NOPE", "dflt")
call(ini.find, "HAL", "HALFILE", 2)
call(ini.findall, "HAL", "HALFILE")
call(ini.findall, "HAL")
call(ini.getint, "KINS", "JOINTS")
call(ini.getbool, "KINS", "JOINTS", fallback="no bool")
call(ini.getlinearunits, "TRAJ", "LINEAR_UNITS")
call(ini.getlinearunits, "KINS", "JOINTS", fallback=0)
call(ini.lineof, "HAL", "HALFILE", 2)
call(ini.lineof, "EMC", "NOPE")
call(ini.getsections)
call(ini.getvariables, "HAL")
call(ini.hassection, "HAL")
call(ini.hasvariable, "", "MACHINE")
call(ini.mapjointtype, "angular")
call(ini.mapangularunits, "deg")
call(linuxcnc.ini, "/nope.ini")
call(linuxcnc.ini, 5)
print([linuxcnc.ini(name).find("EMC", "MACHINE") for name in (b"test.ini", Path("test.ini"))])
call(linuxcnc.vertex9, "XYZ-A", (1, 2, 3, 180, 0, 0, 0, 0, 0))
call(linuxcnc.vertex9, "XYZ", (1, 2))
color = (1, 2, 3, 4)
logger = linuxcnc.positionlogger(linuxcnc.stat(), *[color] * 6, "XYZ")
print(logger.npts, logger.points(), logger.last(), logger.get_colors() == (color,) * 6)
for give in (command.text_msg, command.error_msg, command.display_msg, command.mdi):
    call(give, None)
    call(give, "\udc80")
call(command.auto, linuxcnc.AUTO_PAUSE, 2)
call(command.debug, -1)
