#!/usr/bin/python3
"""Estimates of kerf-time beside the time that the machine takes, in virtual time."""
import os
import subprocess

import linuxcnc
from axis.program import Loader
from axis.settings import read
from kerf import clock
from kerf.runner import Machine

clock.join("display", 900)
ini = os.environ["INI_FILE_NAME"]
machine = Machine(ini)
machine.prepare()
settings = read(linuxcnc.ini(ini))
settings.ini_path = ini
loader = Loader(settings)


def estimate(program, *options):
    state = [word for code in loader.init_codes(machine.poll()) for word in ("-i", code)]
    words = subprocess.run(["kerf-time", "-ini", ini, *options, *state, program], capture_output=True,
                           text=True).stdout.splitlines()[-1].split()
    assert words[0] == "end", words
    return float(words[1])


def run(program):
    machine.start(program)
    begin = clock.now()
    machine.wait(lambda s: s.interp_state == linuxcnc.INTERP_IDLE, program, 600)
    taken = clock.now() - begin
    machine.command.mode(linuxcnc.MODE_MANUAL)
    machine.command.wait_complete()
    return taken


for name, feed, rapid in [line.split() for line in os.environ["PROGRAMS"].splitlines()]:
    machine.command.feedrate(float(feed))
    machine.command.rapidrate(float(rapid))
    clock.sleep(3)      # the spindle of the program before comes to rest
    expected, taken = estimate(name, "-f", feed, "-r", rapid), run(name)
    error = abs(expected / taken - 1)
    print(os.path.basename(name), feed, rapid,
          "within 2 %" if error < 0.02 else f"expected {expected:.3f}, took {taken:.3f}")
for name, text in (("endless", "G21\nF600\no1 while [1]\nG1 X1\nG1 X0\no1 endwhile\nM2\n"),
                   ("days", "G21\nF6000\no1 while [1]\nG1 X0.01\nG4 P1\nG1 X0\nG4 P1\no1 endwhile\nM2\n"),
                   ("broken", "G21\nG1 X1 F60\nG1 X Y2\nM2\n")):
    with open(f"{name}.ngc", "w") as f:
        f.write(text)
    lines = subprocess.run(["kerf-time", "-ini", ini, "-c", "0.3" if name != "days" else "4", f"{name}.ngc"], capture_output=True,
                           text=True).stdout.splitlines()
    words = lines[-1].split(None, 2)
    print(name, words[0], words[2])
    if name == "days":        # a screen keeps these lines
        seconds = float(words[1])
        print("told at the begin:", float(lines[1].split()[2]) < 3, "days:", seconds > 86400, "lines:",
              "few" if len(lines) < seconds / 2 else len(lines))
loader.close()
