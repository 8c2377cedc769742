# The display of the machine: runs AXIS as if it were on another computer.
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import hal
import linuxcnc
import session
from kerf import clock

clock.join("far")
clock.leave()
sys.stdout = open("../seen", "w", buffering=1)
Path("far.nml").write_text(re.sub(r"^(P +xemc +\S+ +)LOCAL", r"\1REMOTE",
                                  Path(os.environ["NMLFILE"]).read_text(), flags=re.M))
Path("far.ini").write_text(Path("mill.ini").read_text().replace("[EMC]\n", "[EMC]\nNML_FILE = far.nml\n", 1))
env = {name: value for name, value in os.environ.items()
       if not name.startswith("LINUXCNC_SESSION")} | {"AXIS_NO_HAL": "1", "KERF_CLOCK": "real"}


def until(condition, what, seconds=120):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            screen.kill()
            sys.exit(f"did not happen: {what}")
        time.sleep(0.05)


def told(text):
    return os.path.exists("../state") and text in Path("../state").read_text()


def speed():
    return hal.get_value("joint.0.vel-cmd")


screen = subprocess.Popen(["axis", "-ini", "far.ini"], env=env, stdin=subprocess.DEVNULL,
                          stdout=open("../far.log", "w"), stderr=subprocess.STDOUT)
window = subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name", "AXIS.* on "],
                        stdout=subprocess.PIPE, text=True, check=True).stdout.split()[0]
c = linuxcnc.command()
for order in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    c.state(order)
    c.wait_complete()
task = session.processes("milltask")[0]
os.kill(task, signal.SIGSTOP)
until(lambda: told("The controller does not answer: what is shown is old."), "the stopped task is told")
os.kill(task, signal.SIGCONT)
until(lambda: told("The controller answers again."), "the task is back")
print("task stopped, and on: told")
subprocess.run(["xdotool", "windowfocus", window, "keydown", "Right"], check=True)
until(speed, "a jog")
session.kill("linuxcncsvr")
until(lambda: not speed(), "its end", 20)
until(lambda: told("no answer of the server"), "the lost connection is told")
subprocess.run(["xdotool", "keyup", "Right"], check=True)
time.sleep(1)
shown = os.stat("../state").st_ino
until(lambda: os.stat("../state").st_ino != shown, "the screen goes on", 60)
print("server gone: told, stands:", not speed(), "the screen is there:", screen.poll() is None)
screen.terminate()
screen.wait()
