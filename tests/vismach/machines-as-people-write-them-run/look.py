#!/usr/bin/python3
"""look.py MACHINE.py: starts it, moves every pin, tells whether the picture follows; pictures
are the window's pixels."""
import os
import re
import signal
import subprocess
import sys
import time

machine = sys.argv[1]
name = os.path.basename(machine)[:-3]
component = "m" + name[:2]


def halcmd(*words):
    return subprocess.run(["halcmd", *words], capture_output=True, text=True).stdout


def picture():
    """The window as it is, by the X server."""
    from PIL import ImageGrab
    return ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).tobytes()


def wait(condition, what):
    for _ in range(600):
        if condition():
            return True
        time.sleep(0.05)
    print(f"{name}: {what}: did not happen")
    return False


child = subprocess.Popen(["/usr/bin/python3", machine])
try:
    wait(lambda: f"{component}." in halcmd("show", "pin", component)
         and "vismach.plotclear" in halcmd("show", "pin", "vismach"), "the pins are there")
    first = picture()
    wait(lambda: picture() != first or first.count(b"\0") != len(first), "a picture is drawn")
    time.sleep(0.5)
    before = picture()
    for pin in re.findall(rf"IN\s+\S+\s+({component}\.\S+)", halcmd("show", "pin", component)):
        halcmd("setp", pin, "1" if "clamped" in pin else "3" if "tool" == pin.split(".")[1] else "313" if "order" in pin
               else "0.7" if "load" in pin else "12.5")
    followed = wait(lambda: picture() != before, "the picture follows the pins")
    print(f"{name}:", "follows its pins" if followed and child.poll() is None else "does not run")
finally:
    child.send_signal(signal.SIGTERM)
    print(f"{name}: ends with status", child.wait(20))
