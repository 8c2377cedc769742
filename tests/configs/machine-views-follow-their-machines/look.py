#!/usr/bin/python3
# Display of a machine with a view: homes, moves, compares the pins of the view with the joints and looks whether the
# picture changes.
import os
import subprocess
import sys
import time

import hal
import linuxcnc
from kerf import clock
from PIL import ImageGrab

view, pins = os.environ["VIEW"], os.environ["PINS"].split()
clock.join("operator", 100)
out = open("../seen", "a", buffering=1)
s, c = linuxcnc.stat(), linuxcnc.command()


def do(name, *args):
    getattr(c, name)(*args)
    c.wait_complete()


def window():
    """The window of the view, drawn anew until it has a picture."""
    for _ in range(300):
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", view], capture_output=True,
                               text=True).stdout.split()
        if found:
            return True
        time.sleep(0.1)
    return False


def picture():
    """What the screen shows when it rests."""
    before = None
    for _ in range(100):
        now = ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).tobytes()
        if now == before:
            return now
        before = now
        time.sleep(0.3)
    return now


for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    do("state", state)
do("mode", linuxcnc.MODE_MANUAL)
do("teleop_enable", 0)
s.poll()
do("home", -1)
while not all(s.homed[:s.joints]):
    clock.sleep(0.1)
    s.poll()
print(f"{view}: window:", window(), end=" ", file=out)
first = picture()
do("mode", linuxcnc.MODE_MANUAL)
do("teleop_enable", 0)
for joint in range(s.joints):
    c.jog(linuxcnc.JOG_INCREMENT, True, joint, 5 + joint, 4 + joint)
    c.wait_complete()
    clock.sleep(3)
s.poll()
seen, asked = [hal.get_value(f"{view}.{p}") for p in pins], s.joint_actual_position[:len(pins)]
print("pins follow:", all(abs(a - b) < 1e-6 for a, b in zip(seen, asked)), "joints moved:",
      [round(v, 3) for v in asked], end=" ", file=out)
print("picture changed:", first != picture(), file=out)
sys.exit(0)
