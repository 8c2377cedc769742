# SPDX-License-Identifier: GPL-2.0-or-later
"""wj200_vfd with two drives on a pty: pins, both directions, speed, trip and reset, faults of drive and line, a lost
line, the end, command line."""
import os

from drive_program import DriveProgram, refusals, stands, starts, wait
from hal_outside import halcmd, pins, until
from modbus_device import Device, SerialDevice

RUN, DIRECTION, TRIP, RESET, ALARM, STOPPED = 0, 1, 2, 3, 0x0E + 9, 0x27


def simulate(drive):
    """Does at once what it is told; `told` has the coils that were written."""
    drive.told, drive.coils[STOPPED], drive.coils[0x0E + 2] = [], True, True

    def watch(at, value):
        if at == 1 and value not in (0, 0xFF00):
            return                                              # the frequency
        on = value == 0xFF00
        drive.told.append((at, on))
        if at == TRIP and on:
            drive.coils[ALARM] = True
        if at == RESET and on:
            drive.coils[ALARM] = False
        if at == DIRECTION:
            drive.coils[0x0F], drive.holding[0x1003] = on, 2 if on else 1
        if at == RUN or at == TRIP:
            running = on and at == RUN and not drive.coils[ALARM]
            drive.coils[0x0E], drive.coils[STOPPED], drive.coils[0x0E + 5] = running, not running, running

    drive.watch = watch
    return drive


def turns(drive):
    return drive.coils[0x0E]


def run(what, one=None):
    starts(one or vfd, drive, turns, what, on="run", ok="is-ready")


line = simulate(SerialDevice(1, 0x1100, "line"))
second = line.others[2] = simulate(Device(0x1100))
drive = line
drive.coils[0x0E] = True                                        # left running
options = ["--device", "line", "--baud", "19200", "--parity", "n", "--databits", "8", "--stopbits", "1"]
vfd = DriveProgram("wj200_vfd", "count=2", *options, "more", prefix="wj200-vfd.0")
print(pins("wj200-vfd.*"))
print(vfd.all("mbslaveaddr frequency-scale"), "asked:", line.asked)
vfd.set(mbslaveaddr=1)
until(lambda: not turns(drive) and vfd.is_true("is-alarm"), "what a killed program left running stops; disabled: trips")
print(drive.told[:2])
vfd.set(enable=1)
until(lambda: not vfd.is_true("is-alarm") and (RESET, True) in drive.told, "enabled: reset")
print("== runs")
vfd.set(commanded_frequency=60, frequency_scale=2)
drive.holding[0x1002], drive.holding[0x1018], drive.holding[0x1001], drive.holding[0x1003] = 250, 351, 3000, 1
run("forward")
until(lambda: vfd.is_true("is-at-speed") and vfd.is_true("is-running"), "at speed")
print(drive.holding[1], vfd.all("motor-current heatsink-temp motor-frequency motor-reverse is-stopped is-ready"))
before = vfd.get("watchdog-out")
until(lambda: vfd.get("watchdog-out") != before, "the watchdog toggles")
vfd.set(reverse=1)
until(lambda: vfd.is_true("motor-reverse") and vfd.is_true("is-at-speed"), "reverse")
vfd.set(frequency_scale=1)
for command, hundredths in ((-99999, 65535), ("nan", 0), ("inf", 0), (100, 10000)):
    vfd.set(commanded_frequency=command)
    until(lambda: drive.holding[1] == hundredths, f"{command}: {hundredths}")
drive.size = 1                                                  # refuses the frequency
vfd.set(commanded_frequency=50)
until(lambda: not vfd.is_true("is-at-speed"), "not at speed: another is set")
drive.size = 0x1100
until(lambda: vfd.is_true("is-at-speed"), "at speed")
vfd.set(run=0)
until(lambda: vfd.is_true("is-stopped") and not vfd.is_true("is-at-speed"), "stops")
print("== faults")
run("runs")
drive.coils[ALARM] = True
until(lambda: vfd.is_true("is-alarm") and drive.told[-1] == (RUN, False), "a fault: no command to run any more")
drive.told.clear()
print(stands(drive, turns), drive.told)
vfd.set(enable=0)
wait(0.3)
vfd.set(enable=1)
until(lambda: not vfd.is_true("is-alarm"), "disabled and enabled: reset")
print("after it:", stands(drive, turns))
run("runs")
vfd.set(enable=0)
until(lambda: not turns(drive) and vfd.is_true("is-alarm"), "disabled: stops and trips")
print(drive.told[-2:])
vfd.set(enable=1)
until(lambda: not vfd.is_true("is-alarm"), "enabled: reset")
print("still on:", stands(drive, turns))
print("== the line")
other = DriveProgram.__new__(DriveProgram)
other.prefix = "wj200-vfd.1."
other.set(mbslaveaddr=2, enable=1)
until(lambda: other.is_true("is-ready"), "the second drive")
run("runs")
drive.broken = True
until(lambda: vfd.get("is-at-speed") == "FALSE", "wrong bytes")
drive.broken = False
until(lambda: vfd.is_true("is-at-speed"), "good again")
print("a disturbance does not stop it:", stands(drive, turns))
drive.told.clear()
line.silent = True
until(lambda: not vfd.is_true("is-at-speed"), "silence")
before = len(second.asked)
until(lambda: not vfd.is_true("is-ready"), "lost")
until(lambda: len(second.asked) > before + 30 and other.is_true("is-ready"), "the second drive is asked all the time")
line.silent = False
until(lambda: vfd.is_true("is-ready"), "answers")
print("first told:", drive.told[0], stands(drive, turns))
run("runs")
drive.told.clear()
line.unplug()
until(lambda: not vfd.is_true("is-ready") and not other.is_true("is-ready"), "the adapter is gone")
line.plug()
until(lambda: vfd.is_true("is-ready") and other.is_true("is-ready"), "and there again")
print("first told:", drive.told[0], stands(drive, turns))
run("runs")
vfd.set(mbslaveaddr=0)
until(lambda: not turns(drive), "given another number: the one before stops")
vfd.set(run=0, mbslaveaddr=1)
run("runs")
status, said = vfd.end()
print("ends with", status, drive.told[-1])
print(said[:1], "a few lines:", len(said) < 40, sum(1 for text in said if "0x" in text and "of slave 1: " in text) > 0)
print("== command line")
vfd = DriveProgram("wj200_vfd", "names=a,b", *options, prefix="a")
print(halcmd("list", "param", "*.mbslaveaddr"))
vfd.end()
refusals("wj200_vfd", ["count=2", "names=a,b"], ["--baud", "x"], ["--parity", "x"], ["--databits", "9"], ["--slave"],
         ["--device", "/nothing"])
os.unlink("line")
