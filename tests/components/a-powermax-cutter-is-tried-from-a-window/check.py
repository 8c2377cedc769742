# SPDX-License-Identifier: GPL-2.0-or-later
"""pmx485-test with a cutter of its protocol on a pty: what the window shows and sends, wrong entries, a silent and a
disturbed line, a line that is gone, what is left when it closes."""
import os
import subprocess
import sys
import time
import tkinter as tk
from pathlib import Path

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import pmx485_test  # noqa: E402
from kerf.powermax import CURRENT, FAULT, MODE, PRESSURE  # noqa: E402
from powermax import REMOTE, Powermax  # noqa: E402

os.environ["LANGUAGE"] = "C"


def until(condition, what):
    end = time.monotonic() + 20
    while not condition():
        root.update()
        if time.monotonic() > end:
            return print("never:", what)
        time.sleep(0.005)
    print(what)


def shown(name):
    return window.labels[name].cget("text")


def enter(register, text):
    window.entries[register].delete(0, "end")
    window.entries[register].insert(0, text)


def press(name):
    window.buttons[name].invoke()
    root.update()
    return window.status.cget("text")


def remote():
    return [cutter.registers[register] for register in sorted(REMOTE)]


cutter = Powermax()
root = tk.Tk()
window = pmx485_test.Window(root, "/dev/nowhere")
root.update()
print(window.buttons["send"].state(), press("connect"))
window.port.set(cutter.path)
cutter.silent = True
print(press("connect"), window.buttons["connect"].cget("text"), window.buttons["send"].state())
cutter.silent = False
until(lambda: shown(MODE) and shown(("range", PRESSURE)) and shown(pmx485_test.ARC_LOW), "the cutter answers")
print(window.status.cget("text"), [shown(name) for name in (MODE, CURRENT, PRESSURE, FAULT, pmx485_test.ARC_LOW,
                                                            ("range", CURRENT), ("range", PRESSURE))])
print("looking changes nothing:", remote())
for current, pressure in (("", "0"), ("x", "0"), ("nan", "0"), ("19", "0"), ("30", "49")):
    enter(CURRENT, current)
    enter(PRESSURE, pressure)
    print(repr(current), repr(pressure), press("send"), remote())
enter(CURRENT, "40,5")
enter(PRESSURE, "65")
window.entries[MODE].current(2)
print(press("send"), remote())
until(lambda: shown(MODE) == "Gouge" and shown(CURRENT) == "40.5" and shown(PRESSURE) == "65", "read back")
enter(PRESSURE, "0")
print("the cutter chooses the pressure:", press("send"), remote())
cutter.registers[FAULT] = 210
until(lambda: shown(FAULT) == "210", "a fault")
print(press("release"), remote())
cutter.broken = True
until(lambda: shown(MODE) == "", "a disturbed line")
print(window.status.cget("text"), window.buttons["send"].state())
cutter.broken = False
until(lambda: shown(FAULT) == "210", "good again")
print(repr(window.status.cget("text")))
press("send")
print("disconnected:", repr(press("connect")), window.buttons["connect"].cget("text"), repr(shown(FAULT)), remote())
press("connect")
until(lambda: shown(CURRENT), "connected again")
press("send")
window.close()
print("closed:", remote())
root = tk.Tk()
window = pmx485_test.Window(root, cutter.path)
press("connect")
until(lambda: shown(CURRENT), "another window")
cutter.unplug()
until(lambda: window.cutter is None, "the line is gone")
print(window.status.cget("text").replace(cutter.path, "PTY"), window.buttons["connect"].cget("text"))
window.close()
done = subprocess.run(["pmx485-test", "-h"], capture_output=True, text=True)
print(done.returncode, done.stdout.splitlines()[0])
done = subprocess.run(["pmx485-test"], capture_output=True, text=True, env=os.environ | {"DISPLAY": ""})
print(done.returncode, done.stderr.strip())
