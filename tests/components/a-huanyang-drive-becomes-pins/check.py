# SPDX-License-Identifier: GPL-2.0-or-later
"""hy_vfd with a drive of its protocol on a pty: set-up, both directions, speed, a disturbed
line, disabling, the end, options."""
import os
import pty
import signal
import subprocess
import threading
import time
import tty

from hal_outside import halcmd, pins, until
from modbus_device import crc


class Huanyang:
    """Answers; runs at once at what it is told."""

    def __init__(self):
        self.parameters = {4: 5000, 5: 40000, 11: 2000, 141: 2200, 142: 70, 143: 2, 144: 3000}
        self.status = [0, 0, 35, 0, 310, 220, 1, 40]
        self.controls = []
        self.control, self.frequency, self.silent, self.broken, self.asked = 8, 0, False, False, []
        self.end, self.other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(self.other)
        self.path = os.ttyname(self.other)
        threading.Thread(target=self.serve, daemon=True).start()

    def answer(self, function, data):
        if function in (1, 2):
            number = data[0]
            if function == 2:
                self.parameters[number] = data[1] << 8 | data[2]
            value = self.parameters.get(number, 0)
            return bytes([2, number, value]) if number == 143 else bytes([3, number, value >> 8, value & 0xFF])
        if function == 3:
            self.control = data[0]
            self.controls.append(data[0])
            running = self.control in (1, 0x11)
            self.status[0], self.status[1] = self.frequency, self.frequency if running else 0
            return bytes([1, (0x09 if running else 0) | (0x24 if self.control == 0x11 else 0)])
        if function == 4:
            return bytes([3, data[0], self.status[data[0]] >> 8, self.status[data[0]] & 0xFF])
        self.frequency = data[0] << 8 | data[1]
        return bytes([2]) + data[:2]

    def serve(self):
        data = b""
        while more := os.read(self.end, 256):
            data += more
            while len(data) >= 3 and len(data) >= 5 + data[2]:
                size = 5 + data[2]
                frame, data = data[:size], data[size:]
                assert frame[-2:] == crc(frame[:-2])
                if frame[0] == 1 and not self.silent:
                    self.asked.append(frame[1])
                    reply = bytes([1, frame[1]]) + self.answer(frame[1], frame[3:-2])
                    os.write(self.end, reply + (b"xx" if self.broken else crc(reply)))


drive = Huanyang()


def get(pin):
    return halcmd("getp", "hy_vfd." + pin)


def setp(pin, value):
    halcmd("setp", "hy_vfd." + pin, str(value))


program = subprocess.Popen(["hy_vfd", "-d", drive.path, "-p", "n", "-f", "100", "-S", "24000", "--register", "PD001=2",
                            "--regdump"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
until(lambda: "hy_vfd" in halcmd("list", "comp").split(), "loaded")
print(pins("hy_vfd.*"))
print("waits:", drive.asked)
setp("enable", 1)
until(lambda: get("hycomm-ok") == "TRUE" and get("Tmp") == "40", "enabled")
print({n: drive.parameters[n] for n in (1, 5, 11, 144)},
      {name: get(name) for name in ("max-freq", "base-freq", "freq-lower-limit", "rated-motor-voltage",
                                    "rated-motor-current", "rated-motor-rev", "motor-poles", "OutA", "DCV", "ACV",
                                    "Cont", "CNTR")})
print("== runs")
setp("speed-command", 12000)
setp("spindle-on", 1)
time.sleep(0.3)
print("without a direction:", drive.control)
setp("spindle-forward", 1)
until(lambda: drive.control == 1 and drive.frequency == 20001, "forward")
until(lambda: get("spindle-at-speed") == "TRUE", "at speed")
print({name: get(name) for name in ("SetF", "OutF", "CNTR", "CNST", "CNST-run", "CNST-running", "CNST-command-rf",
                                    "frequency-command")}, round(float(get("spindle-speed-fb"))),
                                    round(float(get("spindle-speed-fb-rps"))))
setp("spindle-reverse", 1)
until(lambda: drive.control == 8 and get("spindle-at-speed") == "FALSE", "both directions: stops")
setp("spindle-forward", 0)
until(lambda: drive.control == 0x11 and get("CNST-command-rf") == "TRUE", "reverse")
setp("speed-command", 100)
until(lambda: drive.frequency == 10000, "not below the lowest")
setp("speed-command", -99999)
until(lambda: drive.frequency == 40000, "not above the highest")
print("== the line")
drive.broken = True
until(lambda: get("hycomm-ok") == "FALSE" and int(get("error-count")) > 0 and get("retval") == "1", "CRC errors")
drive.broken = False
until(lambda: get("hycomm-ok") == "TRUE" and get("retval") == "0", "good again")
drive.silent = True
setp("spindle-on", 0)
setp("enable", 0)
time.sleep(0.2)
print("dead:", drive.control)
drive.silent = False
until(lambda: drive.control == 8, "stops when it hears again")
setp("spindle-on", 1)
time.sleep(0.3)
print("disabled:", drive.control)
setp("enable", 1)
until(lambda: get("hycomm-ok") == "TRUE", "enabled, and on all the time")
time.sleep(0.3)
print("does not start by itself:", drive.control)
setp("spindle-on", 0)
time.sleep(0.3)
setp("spindle-on", 1)
until(lambda: drive.control == 0x11, "on")
drive.silent = True
time.sleep(2.5)
until(lambda: get("hycomm-ok") == "FALSE", "silent for a while")
drive.controls.clear()
drive.silent = False
until(lambda: get("hycomm-ok") == "TRUE", "good again")
time.sleep(0.3)
print("stops first, does not start by itself:", drive.controls[0], 0x11 not in drive.controls)
setp("spindle-on", 0)
time.sleep(0.3)
setp("spindle-on", 1)
until(lambda: drive.control == 0x11, "on")
program.send_signal(signal.SIGTERM)
out, told = program.communicate(timeout=20)
print("ends with", program.returncode, "control", drive.control)
print(out.splitlines()[:3], len(out.splitlines()) % 183, any("CRC error" in line for line in told.splitlines()))
print("== options")
for options in (["-r", "1"], ["-B", "401"], ["--register", "PD1"], ["--register", "PD300=1"], ["-x", "PD001=2"], ["-h"],
                ["-d", "/nothing"]):
    done = subprocess.run(["hy_vfd", *options, *([] if "-d" in options else ["-d", "/none"])], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=20)
    print(options, done.returncode, done.stderr.splitlines()[-1:])
