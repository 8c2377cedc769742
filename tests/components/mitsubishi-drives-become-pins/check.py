# SPDX-License-Identifier: GPL-2.0-or-later
"""mitsub_vfd with two drives of its protocol on a pty: pins, both directions, speed, monitoring, emergency stop, faults
of drive and line, a lost line, the end, command line."""
import os
import signal

from drive_program import DriveProgram, refusals, stands, starts, wait
from hal_outside import halcmd, pins, until
from mitsubishi_line import Drive, Line

LINK = "line"


def turns(drive):
    return drive.turns != "00"


def run(what):
    starts(vfd, drive, turns, what, on="run", ok="up-to-speed", rest_s=0.5)


drive, pump = Drive(), Drive()
drive.turns = "02"                                              # left running
drive.values["7A"] = "08"
line = Line(LINK, {b"03": drive, b"11": pump})
vfd = DriveProgram("mitsub_vfd", "--port", LINK, "-b", "19200", "spindle=03", "pump=11", component="spindle")
print(pins("spindle.*"))
print(halcmd("list", "comp").count("pump"), vfd.all("fwd scale-cmd scale-fb scale-amps scale-volts scale-user"))
until(lambda: ("FA", "00") in drive.told, "what a killed program left running stops")
until(lambda: ("F3", "0E") in drive.told, "the special monitor is chosen")
print(drive.told[0], "asked:", [command for command in drive.asked if command != "6F"])
vfd.set(monitor=1)
until(lambda: vfd.is_true("up-to-speed") and vfd.get("motor-user") == "42", "monitored")
print({name: round(float(vfd.get("motor-" + name)), 6) for name in ("fb", "amps", "volts", "power")},
      vfd.all("stat-bit-3 stat-bit-7 alarm"))
for name in ("fb", "amps", "volts", "user"):
    halcmd("setp", "spindle.scale-" + name, "2")
until(lambda: vfd.get("motor-user") == "84" and vfd.get("motor-fb") == "60", "scaled")
print("== runs")
vfd.set(motor_cmd=-1200, scale_cmd=0.05)
run("forward")
print(drive.turns, [data for command, data in drive.told if command == "ED"][-1])
vfd.set(fwd=0)
until(lambda: drive.turns == "04", "reverse")
vfd.set(fwd=1)
for command, hundredths in ((1e9, "9C40"), ("nan", "0000"), (1200, "1770")):
    vfd.set(motor_cmd=command)
    until(lambda: drive.told[-1] == ("ED", hundredths), f"{command}: {hundredths}")
vfd.set(run=0)
until(lambda: not turns(drive), "stops")
print("the other drive:", pump.turns)
print("== emergency stop")
run("runs without one")
vfd.set(estop=1)
wait(0.5)
print(stands(drive, turns))
drive.told.clear()
vfd.set(estop=0)
until(lambda: drive.told == [("FA", "00")], "emergency stop")
print(stands(drive, turns, 0.5))
vfd.set(reset_on_estop=1)
vfd.set(estop=1)
until(lambda: ("FD", "9696") in drive.told, "reset")
print("still on:", stands(drive, turns))
run("runs")
vfd.set(estop=0, run=0)
until(lambda: not turns(drive), "emergency stop")
vfd.set(run=1)
print("commanded while stopped:", stands(drive, turns, 0.5))
vfd.set(reset_on_estop=0, estop=1)
print("still on:", stands(drive, turns, 0.5))
print("== faults")
run("runs")
drive.values["7A"] = "88"
until(lambda: vfd.is_true("alarm") and not turns(drive), "an alarm: no command to run any more")
drive.values["7A"] = "08"
until(lambda: not vfd.is_true("alarm"), "reset on the panel")
print("after it:", stands(drive, turns))
run("runs")
drive.refuses = True
vfd.set(run=0)
wait(0.3)
drive.refuses = False
until(lambda: not turns(drive), "a stop that is refused is sent again")
print("== the line")
run("runs")
drive.broken = True
until(lambda: not vfd.is_true("up-to-speed"), "wrong bytes")
drive.broken = False
until(lambda: vfd.is_true("up-to-speed"), "good again")
print("a disturbance does not stop it:", stands(drive, turns))
for monitor in (1, 0):
    drive.told.clear()
    vfd.set(monitor=monitor)
    drive.silent = True
    until(lambda: not vfd.is_true("up-to-speed"), "silence")
    wait(2.5)
    drive.silent = False
    until(lambda: drive.told, "answers")
    print("first told:", drive.told[0], stands(drive, turns))
    vfd.set(monitor=1)
    run("runs")
drive.told.clear()
line.unplug()
until(lambda: not vfd.is_true("up-to-speed"), "the adapter is gone")
line.plug()
until(lambda: vfd.is_true("up-to-speed"), "and there again")
print("first told:", drive.told[0], stands(drive, turns))
run("runs")
vfd.set(debug=1)
wait(0.3)
halcmd("setp", "pump.run", "1")
until(lambda: turns(pump), "the other drive runs")
drive.told.clear()
status, said = vfd.end()
print("ends with", status, drive.told[-1], pump.turns, "traffic:", "b'036F1" in vfd.out)
for text in sorted(set(said)):
    print(text)
vfd = DriveProgram("mitsub_vfd", "-p", LINK)
vfd.process.send_signal(signal.SIGHUP)
print("an end in silence:", vfd.end()[1][-1])
vfd = DriveProgram("mitsub_vfd", "-p", "/nothing")
print("without a line:", vfd.end()[1])
print("== command line")
refusals("mitsub_vfd", ["-h"], ["spindle"], ["spindle=1"], ["-b", "12345"], ["-x"])
os.unlink(LINK)
