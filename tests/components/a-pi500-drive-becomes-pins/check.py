# SPDX-License-Identifier: GPL-2.0-or-later
"""pi500_vfd with a drive on a pty: pins, speed, faults of drive and line, disabling, the end."""
import os

from drive_program import DriveProgram, stands, starts, wait
from hal_outside import pins, until
from modbus_device import SerialDevice

SET, DIGITS, COMMAND, STATE, FREQUENCY, CURRENT, FAULT = 0xF001, 0xF002, 0x2000, 0x3000, 0x1001, 0x1004, 0x8000
drive = SerialDevice(7, 0xF100, "line")
drive.holding[DIGITS], drive.holding[STATE], drive.holding[CURRENT] = 2, 1, 250     # left running
told = []


def simulate(address, value):
    """Does at once what it is told."""
    if address == COMMAND:
        told.append(value)
        if value == 7:
            drive.holding[FAULT] = 0
        drive.holding[STATE] = 1 if value == 1 and not drive.holding[FAULT] else 3
    if address == SET:
        drive.holding[FREQUENCY] = value


def turns(drive):
    return drive.holding[STATE] == 1


def run(what):
    starts(vfd, drive, turns, what, on="run", ok="is-ready")
    until(lambda: vfd.is_true("is-at-speed"), "at speed")


drive.watch = simulate
vfd = DriveProgram("pi500_vfd", "names=spindle", "--device", "line", prefix="spindle")
print(pins("spindle.*"))
print("asked:", drive.asked)
vfd.set(mbslaveaddr=7)
until(lambda: told == [6] and vfd.is_true("is-ready"), "what a killed program left running stops")
vfd.set(commanded_frequency=100, enable=1)
run("runs")
print(drive.holding[SET], vfd.all("motor-current heatsink-temp is-ready is-alarm"))
before = vfd.get("watchdog-out")
until(lambda: vfd.get("watchdog-out") != before, "the watchdog toggles")
drive.holding[FREQUENCY] = 9000
until(lambda: not vfd.is_true("is-at-speed"), "not at speed")
for command, hundredths in ((-5, 0), ("nan", 0), (1e9, 65535), (50, 5000)):
    vfd.set(commanded_frequency=command)
    until(lambda: drive.holding[SET] == hundredths, f"{command}: {hundredths}")
drive.holding[DIGITS] = 1
until(lambda: drive.holding[SET] == 500 and vfd.is_true("is-at-speed"), "tenths of Hz")
vfd.set(run=0)
until(lambda: told[-1] == 6 and not vfd.is_true("is-at-speed"), "stops")
print("== faults")
run("runs")
drive.holding[FAULT] = 5
until(lambda: vfd.is_true("is-alarm") and told[-1] == 6, "a fault: no command to run any more")
told.clear()
print(stands(drive, turns), told)
vfd.set(enable=0)
wait(0.3)
vfd.set(enable=1)
until(lambda: told == [7] and not vfd.is_true("is-alarm"), "disabled and enabled: reset")
print("after it:", stands(drive, turns))
run("runs")
vfd.set(enable=0)
until(lambda: told[-1] == 6, "disabled: stops")
vfd.set(enable=1)
print("still on:", stands(drive, turns))
print("== the line")
run("runs")
drive.broken = True
until(lambda: not vfd.is_true("is-at-speed"), "wrong bytes")
drive.broken = False
until(lambda: vfd.is_true("is-at-speed"), "good again")
print("a disturbance does not stop it:", stands(drive, turns))
told.clear()
drive.silent = True
until(lambda: not vfd.is_true("is-ready") and not vfd.is_true("is-at-speed"), "silence")
wait(2)
drive.silent = False
until(lambda: vfd.is_true("is-ready"), "answers")
print("told:", told, stands(drive, turns))
run("runs")
told.clear()
drive.unplug()
until(lambda: not vfd.is_true("is-at-speed"), "the adapter is gone")
drive.plug()
until(lambda: vfd.is_true("is-ready"), "and there again")
print("told:", told, stands(drive, turns))
run("runs")
status, said = vfd.end()
print("ends with", status, told[-1])
vfd = DriveProgram("pi500_vfd", "--device", "line", prefix="pi500-vfd.0")
vfd.set(mbslaveaddr=7)
until(lambda: vfd.is_true("is-ready"), "ready")
drive.silent = True
print("an end in silence:", vfd.end()[1][-1])
os.unlink("line")
