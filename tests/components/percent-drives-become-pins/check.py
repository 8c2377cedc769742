# SPDX-License-Identifier: GPL-2.0-or-later
"""hy_gt_vfd and svd-ps_vfd, each with a drive on a pty: speed, at speed, a dead line, stop, the end, options."""
import signal
import subprocess
import time

from hal_outside import halcmd, pins, until
from modbus_device import SerialDevice


def work(name, run, frequency, first, more, tells):
    print("==", name)
    drive, told = SerialDevice(1, 0x5001), []
    drive.watch = lambda address, value: address == run and told.append(value)
    drive.holding[first[0]:first[0] + len(first[1])] = first[1]
    for address, value in more.items():
        drive.holding[address] = value
    get = lambda pin: halcmd("getp", f"{name}.{pin}")
    setp = lambda pin, value: halcmd("setp", f"{name}.{pin}", str(value))
    speed = first[0] + 5 if name == "hy_gt_vfd" else first[0] + 4
    program = subprocess.Popen([name, "-d", drive.path, "-p", "n", "-S", "24000", "-F", "400", "-f", "50"],
                               stderr=subprocess.PIPE, text=True)
    until(lambda: name in halcmd("list", "comp").split(), "loaded")
    setp("period-seconds", 0.001)
    print(pins(f"{name}.*"))
    until(lambda: drive.holding[run] == 5 and {pin: get(pin) for pin in tells} == tells, f"stands and tells {tells}")
    setp("speed-cmd", 12000)
    setp("spindle-on", 1)
    until(lambda: drive.holding[run] == 1 and drive.holding[frequency] == 5000 and get("freq-cmd") == "200",
          "runs at half")
    drive.holding[speed] = 11900
    until(lambda: get("at-speed") == "TRUE", "at speed")
    for command, part in ((-5, 0), ("nan", 0), (99999, 10000), (240, 100)):
        setp("speed-cmd", command)
        until(lambda: drive.holding[frequency] == part and get("at-speed") == "FALSE", f"{command}: {part}")
    drive.silent = True
    until(lambda: int(get("modbus-errors")) > 6, "failures are counted")
    setp("spindle-on", 0)
    time.sleep(0.1)
    drive.silent = False
    until(lambda: drive.holding[run] == 5 and get("freq-cmd") == "0", "stops when it hears again")
    setp("spindle-on", 1)
    until(lambda: drive.holding[run] == 1, "on")
    told.clear()
    drive.silent = True
    time.sleep(1.5)
    drive.silent = False
    until(lambda: told and told[0] == 5, "silent for a while: stops first")
    time.sleep(0.2)
    print("does not start by itself:", 1 not in told)
    setp("spindle-on", 0)
    time.sleep(0.2)
    setp("spindle-on", 1)
    until(lambda: drive.holding[run] == 1, "on")
    program.send_signal(signal.SIGTERM)
    errors = program.communicate(timeout=20)[1].splitlines()
    print("ends with", program.returncode, "run", drive.holding[run], "told",
          len(errors) > 0 and all("register 0x" in line for line in errors))


work("hy_gt_vfd", 0x1000, 0x2000, (0x3000, [20000, 0, 3100, 220, 3, 100, 2]),
     {0x300A: 1, 0x300B: 2, 0x300C: 3, 0x300D: 4, 0x3010: 5, 0x3014: 6, 0x5000: 7},
     {"freq-fb": "200", "dc-bus-voltage": "310", "output-voltage": "220", "output-current": "3", "speed-fb": "100",
      "output-power": "2", "input-terminal": "1", "output-terminal": "2", "AI1": "3",
      "AI2": "4", "HDI-frequency": "5", "external-counter": "6", "fault-info": "7", "fault-info-code": "7"})
work("svd-ps_vfd", 0x2000, 0x1000, (0x1001, [20000, 3100, 220, 3, 100, 2]), {0x1009: 1, 0x100A: 3000, 0x100B: 4000},
     {"freq-fb": "200", "dc-bus-voltage": "310", "output-voltage": "220", "output-current": "3", "speed-fb": "100",
      "output-power": "2", "input-terminal": "1", "AI1": "3", "AI2": "4"})
print("== options")
for options in ([], ["-S", "1000", "-F", "50", "-f", "60"], ["-S", "0"], ["-r", "1"], ["-t", "300"], ["-q"], ["-h"],
                ["-S", "1000", "-F", "50", "-f", "5", "-d", "/nothing"]):
    done = subprocess.run(["svd-ps_vfd", *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, timeout=20)
    print(options, done.returncode, done.stderr.splitlines()[-1:])
