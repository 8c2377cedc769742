# SPDX-License-Identifier: GPL-2.0-or-later
"""gs2_vfd with a drive on a pty: set-up, speed, direction, faults of the line, disabling, the end, options."""
import os
import signal
import subprocess
import time

from hal_outside import halcmd, pins, until
from modbus_device import SerialDevice

drive, told = SerialDevice(3, 0x2200, "line"), []
STATUS, SPEED, RUN, DIRECTION, RESET = 0x2100, 0x091A, 0x091B, 0x091C, 0x091E
drive.watch = lambda address, value: address == RUN and told.append(value)
drive.holding[STATUS:STATUS + 13] = [1, 2, 300, 0, 15, 3100, 2300, 0, 5, 1, 90, 250, 104]


def get(pin):
    return halcmd("getp", "d." + pin)


def setp(pin, value):
    halcmd("setp", "d." + pin, str(value))


program = subprocess.Popen(["gs2_vfd", "-d", drive.path, "-n", "d", "-t", "3", "-p", "n", "-r", "5", "-A", "4.5", "-R",
                            "-X"], stdout=subprocess.PIPE, text=True)
print(program.stdout.readline().strip().replace(drive.path, "PTY"))
until(lambda: "d" in halcmd("list", "comp").split(), "loaded")
print(pins("d.*"))
print({name: get(name) for name in ("error-count", "loop-time", "retval", "tolerance", "nameplate-HZ", "nameplate-RPM",
                                    "ack-delay", "spindle-fwd", "enable")})
setp("loop-time", 0.005)
print("disabled:", drive.asked)
setp("enable", 1)
until(lambda: get("initialized") == "TRUE", "set up")
print([drive.holding[n] for n in (0x0101, 0x0100, 0x0102, 0x0605)])
until(lambda: get("firmware-revision") == "104", "read")
print({name: get(name) for name in ("status-1", "status-2", "frequency-command", "frequency-out", "output-current",
                                    "DC-bus-volts", "output-voltage", "motor-RPM", "scale-frequency", "power-factor",
                                    "load-percentage", "is-stopped", "at-speed")})
print("== runs")
setp("speed-command", -865)
setp("spindle-fwd", 0)
setp("spindle-on", 1)
until(lambda: (drive.holding[SPEED], drive.holding[RUN], drive.holding[DIRECTION]) == (300, 1, 1)
      and get("spindle-rev") == "TRUE", "reverse")
drive.holding[STATUS + 3] = 299
until(lambda: get("frequency-out") == "29.9", "nearly")
print(get("at-speed"), get("is-stopped"))
drive.holding[STATUS + 3] = 300
until(lambda: get("at-speed") == "TRUE", "at speed")
before = drive.asked.count(6)
until(lambda: drive.asked.count(3) > 100, "many looks")
setp("err-reset", 1)
until(lambda: drive.holding[RESET] == 1, "reset")
for value in ("nan", "inf", "1e30"):
    setp("speed-command", value)
    until(lambda: drive.holding[SPEED] == (65535 if value == "1e30" else 0), value)
    setp("speed-command", 865)
    until(lambda: drive.holding[SPEED] == 300, "300")
setp("nameplate-HZ", 1)
setp("nameplate-RPM", 10)
until(lambda: (get("nameplate-HZ"), get("nameplate-RPM")) == ("60", "1800"), "nameplate")
print("== faults")
drive.silent = True
until(lambda: int(get("error-count")) > 1 and get("retval") == "-1", "silence is counted")
setp("spindle-on", 0)
time.sleep(0.1)
drive.silent = False
until(lambda: drive.holding[RUN] == 0, "a stop that was not taken is sent again")
until(lambda: get("at-speed") == "FALSE", "not at speed")
setp("spindle-on", 1)
until(lambda: drive.holding[RUN] == 1, "runs again")
drive.silent = True
setp("enable", 0)
until(lambda: get("spindle-on") == "FALSE", "disabled while the line is dead")
print(get("initialized"), get("at-speed"))
drive.silent = False
until(lambda: drive.holding[RUN] == 0 and get("spindle-on") == "FALSE" and get("initialized") == "FALSE",
      "disabled: stops")
setp("enable", 1)
until(lambda: get("initialized") == "TRUE", "enabled")
print("still off:", drive.holding[RUN])
time.sleep(0.1)
setp("spindle-on", 1)
until(lambda: drive.holding[RUN] == 1, "on")
halcmd("net", "on", "d.spindle-on")
setp("enable", 0)
until(lambda: get("initialized") == "FALSE", "disabled")
halcmd("sets", "on", "1")
time.sleep(0.1)
setp("enable", 1)
until(lambda: get("initialized") == "TRUE", "enabled, and on all the time")
time.sleep(0.2)
print("does not start by itself:", drive.holding[RUN])
for what in ("silent for a while", "unplugged for a moment"):
    halcmd("sets", "on", "0")
    time.sleep(0.1)
    halcmd("sets", "on", "1")
    until(lambda: drive.holding[RUN] == 1, "on")
    told.clear()
    if what.startswith("silent"):
        drive.silent = True
        time.sleep(2)
        drive.silent = False
    else:
        drive.unplug()
        time.sleep(0.2)
        drive.plug()
    until(lambda: told and get("retval") == "0", what)
    time.sleep(0.2)
    print("stops first, does not start by itself:", told[0], 1 not in told)
halcmd("sets", "on", "0")
time.sleep(0.1)
halcmd("sets", "on", "1")
until(lambda: drive.holding[RUN] == 1, "on")
program.send_signal(signal.SIGTERM)
print("ends with", program.wait(20), "run", drive.holding[RUN])
os.unlink("line")
print("== options")
for options in (["-r", "1"], ["-r", "115"], ["-p", "x"], ["-b", "9"], ["-t", "0"], ["-t", "255"], ["-n", "x" * 28],
                ["-A", "x"], ["-q"], ["-h"], ["-d", "/nothing"]):
    done = subprocess.run(["gs2_vfd", *options, *([] if "-d" in options else ["-d", "/none"])], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=20)
    print(options, done.returncode, done.stderr.splitlines()[-1:])
