# SPDX-License-Identifier: GPL-2.0-or-later
"""vfs11_vfd with a drive on a pty and on TCP: pins, both directions, speed, faults of drive and line, a lost
connection, disabling, emergency stop, the end, settings."""
import os
import signal

from drive_program import DriveProgram, ini_file, refusals, stands, starts, wait
from hal_outside import halcmd, pins, until
from modbus_device import SerialDevice, TcpDevice

COMMAND, FREQUENCY, LIMIT, OUT, STATUS, TRIP, ALARM = 0xFA00, 0xFA01, 0x0012, 0xFD00, 0xFD01, 0xFC90, 0xFC91
STOP, RUN, REVERSE, JOG = 0xC000, 0xC400, 0xC600, 0xC100


def ini(**keys):
    return ini_file("VFS11", **keys)


def turns(drive):
    return drive.holding[COMMAND] & 0x500


def run(program, drive, what):
    starts(program, drive, turns, what)


def holds_still(drive):
    return stands(drive, turns)


serial = {"TYPE": "rtu", "DEVICE": "line", "PARITY": "none", "RESPONSE_TIMEOUT": 0.2, "RECONNECT_DELAY": 0.1}
drive = SerialDevice(3, 0x10000, "line")
drive.holding[LIMIT], drive.holding[COMMAND] = 8000, RUN        # left running
for address, value in ((0xFE70, 123), (0xFE71, 2300), (0xFB05, 5), (0xFE08, 110), (0xFE73, 120), (0xFE09, 7)):
    drive.holding[address] = value
told = []
drive.watch = lambda address, value: address == COMMAND and told.append(value)
vfd = DriveProgram("vfs11_vfd", "-r", "-n", "d", "-I", ini(TARGET=3, **serial), component="d")
print(pins("d.*"))
print({name: vfd.get(name) for name in ("loop-time", "nameplate-HZ", "nameplate-RPM", "rpm-limit", "tolerance",
                                        "spindle-fwd")})
until(lambda: told[:2] == [STOP, 0], "what a killed program left running stops, the panel rules")
vfd.set(loop_time=0.005, enable=1)
until(lambda: drive.holding[COMMAND] == STOP and vfd.get("frequency-limit") == "80", "enabled")
print(vfd.all("max-rpm is-stopped at-speed is-e-stopped modbus-ok"))
print("== runs")
vfd.set(speed_command=-705)
run(vfd, drive, "forward")
for address, value in ((OUT, 2450), (STATUS, 0x0400), (0xFE16, 2500), (0xFE27, 42), (0xFE03, 456), (0xFE05, 789)):
    drive.holding[address] = value
until(lambda: vfd.get("frequency-out") == "24.5" and vfd.get("output-voltage-percentage") == "7.89", "told")
print(drive.holding[FREQUENCY], vfd.all("frequency-command at-speed is-stopped status motor-RPM alarm-code trip-code "
                                        "current-load-percentage inverter-load-percentage output-current-percentage"))
drive.holding[OUT] = 2500
until(lambda: vfd.is_true("at-speed"), "at speed")
drive.holding[OUT] = 7000
until(lambda: not vfd.is_true("at-speed"), "not at speed: too fast")
vfd.set(spindle_fwd=0)
until(lambda: drive.holding[COMMAND] == REVERSE and vfd.is_true("spindle-rev"), "reverse")
vfd.set(spindle_fwd=1, acceleration_pattern=1)
until(lambda: drive.holding[COMMAND] == RUN | 0x40, "the second pattern")
vfd.set(acceleration_pattern=0, jog_mode=1)
until(lambda: drive.holding[COMMAND] == JOG, "jogs")
vfd.set(spindle_on=0)
until(lambda: drive.holding[COMMAND] == STOP, "stops")
vfd.set(jog_mode=0, spindle_on=1)
for command, hundredths in ((99999, 7092), ("nan", 0), ("inf", 0), (705, 2500)):
    vfd.set(speed_command=command)
    until(lambda: drive.holding[FREQUENCY] == hundredths, f"{command}: {hundredths}")
vfd.set(rpm_limit=141)
until(lambda: drive.holding[FREQUENCY] == 500, "limited")
vfd.set(rpm_limit=2000, nameplate_HZ=1, nameplate_RPM=10)
for name in ("nameplate-HZ", "nameplate-RPM"):
    halcmd("setp", "d." + name, "1")
until(lambda: (vfd.get("nameplate-HZ"), vfd.get("nameplate-RPM")) == ("50", "1410"), "nameplate")
print("== brake, emergency stop, faults")
vfd.set(dc_brake=1)
until(lambda: drive.holding[COMMAND] == STOP | 0x80 and not vfd.is_true("spindle-on"), "brakes")
halcmd("net", "on", "d.spindle-on")                             # a signal that goes on saying run
halcmd("sets", "on", "1")
vfd.set(dc_brake=0)
until(lambda: drive.holding[COMMAND] == STOP, "the brake is off")
halcmd("sets", "on", "1")
halcmd("unlinkp", "d.spindle-on")
run(vfd, drive, "runs again")
told.clear()
vfd.set(estop=1)
until(lambda: not vfd.is_true("estop") and not vfd.is_true("spindle-on"), "emergency stop")
drive.holding[STATUS] = 0x1000
until(lambda: vfd.is_true("is-e-stopped"), "the drive tells")
stop = next((at for at, word in enumerate(told) if word & 0x1000), None)
print(stop is not None, not any(word & 0x400 for word in told[stop:]))
vfd.set(spindle_on=1)
print("emergency stop:", holds_still(drive))
told.clear()
vfd.set(err_reset=1)
until(lambda: not vfd.is_true("err-reset"), "reset")
print("told once:", sum(1 for word in told if word & 0x2000))
drive.holding[STATUS] = 0
until(lambda: not vfd.is_true("is-e-stopped"), "it is over")
print("after it:", holds_still(drive))
run(vfd, drive, "runs again")
drive.holding[STATUS], drive.holding[TRIP], drive.holding[ALARM] = 0x0406, 17, 5
until(lambda: (vfd.get("trip-code"), vfd.get("alarm-code")) == ("17", "5"), "a trip and an alarm")
until(lambda: not drive.holding[COMMAND] & 0x400, "no command to run any more")
drive.holding[STATUS] = 0
until(lambda: (vfd.get("trip-code"), vfd.get("alarm-code")) == ("0", "0"), "reset on the panel")
print("after it:", holds_still(drive))
print("== the line")
run(vfd, drive, "runs")
drive.broken = True
until(lambda: int(vfd.get("error-count")) > 0 and not vfd.is_true("modbus-ok"), "wrong bytes")
drive.broken = False
until(lambda: vfd.is_true("modbus-ok"), "good again")
print("a disturbance does not stop it:", holds_still(drive))
told.clear()
drive.silent = True
until(lambda: not vfd.is_true("modbus-ok") and not vfd.is_true("is-stopped"), "silence")
wait(1.3)
drive.silent = False
until(lambda: told and not told[0] & 0x500, "the first that it hears is the stop")
until(lambda: vfd.is_true("modbus-ok"), "answers")
print("after it:", holds_still(drive))
run(vfd, drive, "runs")
told.clear()
drive.unplug()
until(lambda: not vfd.is_true("modbus-ok") and not vfd.is_true("at-speed"), "the adapter is gone")
vfd.set(spindle_on=0)
vfd.set(spindle_on=1)
drive.plug()
until(lambda: vfd.is_true("modbus-ok"), "and there again")
print("first told:", hex(told[0]), holds_still(drive))
print("== disabled")
run(vfd, drive, "runs")
told.clear()
vfd.set(enable=0)
until(lambda: told[-2:] == [STOP, 0], "disabled: stops, the panel rules")
vfd.set(enable=1)
until(lambda: drive.holding[COMMAND] == STOP, "enabled")
print("still on:", holds_still(drive))
run(vfd, drive, "runs")
drive.silent = True
vfd.set(enable=0)
wait(0.3)
drive.silent = False
until(lambda: drive.holding[COMMAND] == 0, "disabled while the line was dead")
vfd.set(enable=1, max_speed=1)
run(vfd, drive, "without a pause")
for number in (signal.SIGUSR1, signal.SIGUSR2):
    vfd.process.send_signal(number)
vfd.set(spindle_on=0)
until(lambda: drive.holding[COMMAND] == STOP, "off")
vfd.process.send_signal(signal.SIGUSR2)
vfd.set(spindle_on=1)
until(lambda: drive.holding[COMMAND] == RUN, "on")
told.clear()
status, said = vfd.end()
print("ends with", status, told[-2:] == [STOP, 0], "shows:", "d: runs, 25 Hz" in said, "<03><06>" in "".join(
    line for line in vfd.out.splitlines() if line.startswith("<03><06>")))
print([line for line in vfd.out.splitlines() if line.startswith("d:")])
errors = [line for line in said if "ERROR" in line]
print(all("0x" in line and "of slave 3: " in line or ": line: No such file" in line for line in errors),
      "a few lines:", len(errors) < 30)
print("== an end in silence")
vfd = DriveProgram("vfs11_vfd", "-I", ini(TARGET=3, **serial))
drive.silent = True
status, said = vfd.end(signal.SIGHUP)
print(status, said[-1:])
print("== TCP")
drive = TcpDevice(size=0x10000)
drive.holding[LIMIT] = 5000
vfd = DriveProgram("vfs11_vfd", "-I", ini(TYPE="tcpclient", PORT=drive.port, RESPONSE_TIMEOUT=0.2, RECONNECT_DELAY=0.1))
vfd.set(loop_time=0.005, enable=1, speed_command=705)
run(vfd, drive, "runs")
port = drive.port
drive.stop()
until(lambda: not vfd.is_true("modbus-ok"), "the connection is gone")
drive.start(port)
until(lambda: vfd.is_true("modbus-ok") and drive.holding[COMMAND] == STOP, "and there again")
print("first:", holds_still(drive))
run(vfd, drive, "runs")
drive.broken = True
until(lambda: not vfd.is_true("modbus-ok"), "answers to something else")
drive.broken = False
until(lambda: vfd.is_true("modbus-ok"), "good again")
print("ends with", vfd.end()[0], drive.holding[COMMAND])
drive.stop()
print("== the drive's gateway calls")
vfd = DriveProgram("vfs11_vfd", "-I", ini(TYPE="tcpserver", PORT=port, RECONNECT_DELAY=0.1))
drive.call(port)
vfd.set(loop_time=0.005, enable=1)
run(vfd, drive, "runs")
drive.hang_up()
until(lambda: not vfd.is_true("modbus-ok"), "hangs up")
drive.call(port)
until(lambda: vfd.is_true("modbus-ok") and drive.holding[COMMAND] == STOP, "calls again")
print("first:", holds_still(drive))
print("ends with", vfd.end()[0], drive.holding[COMMAND])
print("== settings")
environment = os.environ.pop("INI_FILE_NAME", None)
refusals("vfs11_vfd", [], ["-h"], ["-q"], ["x"], ["-n", "x" * 28], ["-I", "none.ini"])
for keys in ({}, {"TYPE": "usb"}, {"TYPE": "rtu", "PARITY": "x"}, {"TYPE": "rtu", "BITS": 9},
             {"TYPE": "rtu", "TARGET": 0}, {"TYPE": "rtu", "STOPBITS": "x"}, {"TYPE": "rtu", "SERIAL_MODE": "rs422"},
             {"TYPE": "rtu", "RTS_MODE": "x"}, {"TYPE": "rtu", "RESPONSE_TIMEOUT": 0}, {"TYPE": "tcpclient", "PORT": 0},
             {"TYPE": "rtu", "DEBUG": "x"}, {"TYPE": "rtu", "DEVICE": "/nothing"}):
    refusals("vfs11_vfd", ["-I", ini(**keys)])
refusals("vfs11_vfd", ["-S", "OTHER", "-I", "drive.ini"])
os.unlink("drive.ini")
os.unlink("line")
