# SPDX-License-Identifier: GPL-2.0-or-later
"""pmx485 with a cutter of its protocol on a pty: remote mode, limits, settings, fault and arc time, a disturbed and a
silent line, the ends."""
import subprocess

import hal
from hal_outside import halcmd, pins, until
from powermax import REMOTE, Powermax


def value(pin):
    return float(halcmd("getp", f"pmx485.{pin}"))


def begin():
    child = subprocess.Popen(["pmx485", cutter.path])
    until(lambda: "pmx485" in halcmd("list", "comp").split(), "loaded")
    return child


def status():
    return halcmd("getp", "pmx485.status") == "TRUE"


motmod = hal.component("motmod")  # the program lives as long as motion does
motmod.ready()
cutter = Powermax()
program = begin()
print(pins("pmx485.*"))
for pin, setting in (("mode", 1), ("current", 40.5), ("pressure", 65)):
    halcmd("setp", f"pmx485.{pin}_set", str(setting))
halcmd("setp", "pmx485.enable", "1")
until(status, "answers")
print("registers:", [cutter.registers[r] for r in sorted(REMOTE)], "pins:",
      [value(p) for p in ("mode", "current", "pressure")])
print("limits:", [value(p) for p in ("current_min", "current_max", "pressure_min", "pressure_max")], "arc time:",
      value("arcTime"))
halcmd("setp", "pmx485.current_set", "30")
until(lambda: cutter.registers[0x2094] == 30 * 64, "a new current is written")
cutter.registers[0x2096] = 70 * 128  # on the cutter's panel
until(lambda: cutter.registers[0x2096] == 65 * 128, "what the panel changes is set again")
cutter.registers[0x2098] = 210
until(lambda: value("fault") == 210, "a fault is shown")
cutter.broken = True
until(lambda: not status(), "a disturbed line is told")
cutter.broken = False
until(status, "it comes back")
cutter.silent = True
until(lambda: not status(), "a silent line is told")
cutter.silent = False
until(status, "it comes back")
halcmd("setp", "pmx485.enable", "0")
until(lambda: not any(cutter.registers[r] for r in REMOTE), "disabled: the cutter's panel rules")
halcmd("setp", "pmx485.enable", "1")
until(status, "enabled again")
halcmd("unloadusr", "pmx485")
until(lambda: not any(cutter.registers[r] for r in REMOTE), "unloaded: the cutter's panel rules")
program.wait()
program = begin()
halcmd("setp", "pmx485.enable", "1")
until(status, "loaded again")
motmod.exit()
program.wait()
until(lambda: not any(cutter.registers[r] for r in REMOTE), "ends with motion")
for words in ((), ("/dev/nowhere",), ("/dev/null",)):
    done = subprocess.run(["pmx485", *words], capture_output=True, text=True)
    print(done.returncode, done.stderr.strip())
