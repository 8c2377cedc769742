# SPDX-License-Identifier: GPL-2.0-or-later
"""vfdb_vfd with a drive on a pty: pins, both directions, speed, faults of drive and line, a lost line, disabling, the
end, settings."""
import os

from drive_program import DriveProgram, ini_file, refusals, stands, starts, wait
from hal_outside import pins, until
from modbus_device import SerialDevice

COMMAND, FREQUENCY, LIMIT, ERROR, STATUS, OUT, RPM = 0x2000, 0x2001, 0x0100, 0x2100, 0x2101, 0x2103, 0x210C
STOP, RUN, BACK, JOG = 0x11, 0x12, 0x22, 0x13


def turns(drive):
    return drive.holding[COMMAND] & 2


serial = {"DEVICE": "line", "PARITY": "none", "RECONNECT_DELAY": 0.1, "TARGET": 9}
drive = SerialDevice(9, 0x2200, "line")
drive.holding[LIMIT], drive.holding[COMMAND] = 6000, RUN        # left running
told = []
drive.watch = lambda address, value: address == COMMAND and told.append(value)
for address, value in ((0, 11), (1, 75), (0x0102, 2300), (6, 42)):
    drive.holding[address] = value
vfd = DriveProgram("vfdb_vfd", "--report-device", "-n", "d", "-S", "SPINDLE", "-I",
                   ini_file("SPINDLE", MOTOR_HZ=400, MOTOR_RPM=24000, **serial), component="d")
print(pins("d.*"))
print(vfd.all("loop-time nameplate-HZ nameplate-RPM rpm-limit tolerance"))
until(lambda: told[:2] == [1, 0], "what a killed program left running stops")
vfd.set(loop_time=0.005, enable=1)
until(lambda: drive.holding[COMMAND] == STOP and vfd.get("frequency-limit") == "60", "enabled")
print(vfd.all("max-rpm is-stopped at-speed is-e-stopped modbus-ok error-code"))
print("== runs")
vfd.set(speed_command=6000)
starts(vfd, drive, turns, "forward")
for address, value in ((STATUS, 3), (OUT, 9900), (0x2104, 15), (0x2106, 2300), (0x210B, 42), (RPM, 5910)):
    drive.holding[address] = value
until(lambda: vfd.get("output-voltage") == "230" and vfd.get("motor-RPM") == "5910", "told")
print(drive.holding[COMMAND] == RUN, drive.holding[FREQUENCY],
      vfd.all("frequency-command frequency-out at-speed is-stopped status output-current inverter-load-percentage"),
      round(float(vfd.get("motor-RPS")), 2))
drive.holding[RPM] = 6000
until(lambda: vfd.is_true("at-speed"), "at speed")
vfd.set(speed_command=-6000)
until(lambda: drive.holding[COMMAND] == BACK and vfd.is_true("at-speed"), "reverse, at speed")
drive.holding[RPM] = 6600
until(lambda: not vfd.is_true("at-speed"), "not at speed: too fast")
for command, hundredths in ((-99999, 40000), ("nan", 0), ("inf", 0), (6000, 10000)):
    vfd.set(speed_command=command)
    until(lambda: drive.holding[FREQUENCY] == hundredths, f"{command}: {hundredths}")
vfd.set(jog_mode=1)
until(lambda: drive.holding[COMMAND] == JOG, "jogs")
vfd.set(spindle_on=0)
until(lambda: drive.holding[COMMAND] == STOP, "stops")
vfd.set(jog_mode=0)
print("== faults")
starts(vfd, drive, turns, "runs")
drive.holding[ERROR] = 7
until(lambda: vfd.get("error-code") == "7" and not turns(drive), "a fault: no command to run any more")
drive.holding[ERROR] = 0
until(lambda: vfd.get("error-code") == "0", "reset on the panel")
print("after it:", stands(drive, turns))
starts(vfd, drive, turns, "runs")
drive.holding[STATUS] = 0x21
until(lambda: vfd.is_true("is-e-stopped") and not turns(drive), "emergency stop")
drive.holding[STATUS] = 3
until(lambda: not vfd.is_true("is-e-stopped"), "it is over")
print("after it:", stands(drive, turns))
print("== the line")
starts(vfd, drive, turns, "runs")
drive.broken = True
until(lambda: int(vfd.get("error-count")) > 0 and not vfd.is_true("modbus-ok"), "wrong bytes")
drive.broken = False
until(lambda: vfd.is_true("modbus-ok"), "good again")
print("a disturbance does not stop it:", stands(drive, turns))
told.clear()
drive.silent = True
until(lambda: not vfd.is_true("modbus-ok") and not vfd.is_true("is-stopped"), "silence")
wait(2)
drive.silent = False
until(lambda: told and not told[0] & 2, "the first that it hears is the stop")
until(lambda: vfd.is_true("modbus-ok"), "answers")
print("after it:", stands(drive, turns))
starts(vfd, drive, turns, "runs")
told.clear()
drive.unplug()
until(lambda: not vfd.is_true("modbus-ok") and not vfd.is_true("at-speed"), "the adapter is gone")
drive.plug()
until(lambda: vfd.is_true("modbus-ok"), "and there again")
print("first told:", hex(told[0]), stands(drive, turns))
print("== disabled")
starts(vfd, drive, turns, "runs")
told.clear()
vfd.set(enable=0)
until(lambda: told[-2:] == [1, 0], "disabled: stops")
vfd.set(enable=1)
until(lambda: drive.holding[COMMAND] == STOP, "enabled")
print("still on:", stands(drive, turns))
starts(vfd, drive, turns, "runs")
drive.silent = True
vfd.set(enable=0)
wait(0.3)
drive.silent = False
until(lambda: drive.holding[COMMAND] == 0, "disabled while the line was dead")
vfd.set(enable=1, max_speed=1)
starts(vfd, drive, turns, "without a pause")
told.clear()
status, said = vfd.end()
print("ends with", status, told[-2:])
print(vfd.out.splitlines())
print("== settings")
refusals("vfdb_vfd", ["-h"], ["-I", "none.ini"])
for keys in ({"PARITY": "x"}, {"MOTOR_HZ": 0}, {"MOTOR_RPM": "x"}, {"POLLCYCLES": 0}, {"RECONNECT_DELAY": "x"},
             {"DEVICE": "/nothing"}):
    refusals("vfdb_vfd", ["-I", ini_file("VFD-B", **keys)])
os.unlink("drive.ini")
os.unlink("line")
