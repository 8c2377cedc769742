#!/usr/bin/python3
# A program beside the machine: runs a program, takes the screen away, looks.
import os
import signal
import subprocess
import sys
import time

import hal
import hal.query
import linuxcnc

out = sys.stdout = open("../seen", "w", buffering=1)
display = os.environ["DISPLAY"]
s, c = linuxcnc.stat(), linuxcnc.command()


def until(condition, what, seconds=120):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"did not happen: {what}")
        time.sleep(0.05)


def screen():
    """Process of the screen that is up, or 0."""
    found = hal.query.comp("axisui")
    return found["pid"] if found and found["ready"] and os.path.exists(f"/proc/{found['pid']}/exe") else 0


def runs():
    s.poll()
    return s.interp_state != linuxcnc.INTERP_IDLE and s.task_state == linuxcnc.STATE_ON


def moves():
    x = hal.get_value("joint.0.motor-pos-cmd")
    until(lambda: hal.get_value("joint.0.motor-pos-cmd") != x, "motion", 20)
    return runs()


until(screen, "the screen")
until(lambda: subprocess.run(["axis-remote", "--ping"], stderr=subprocess.DEVNULL).returncode == 0,
      "the screen answers")
for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    c.state(state)
    c.wait_complete()
c.home(-1)
until(lambda: s.poll() or all(s.homed[:3]), "homing")
c.feedrate(0.7)
c.teleop_enable(1)
c.mode(linuxcnc.MODE_AUTO)
c.wait_complete()
c.program_open("part.ngc")
c.wait_complete()
c.auto(linuxcnc.AUTO_RUN, 0)
until(runs, "the run")
print("runs:", moves())

first = screen()
open("../fault", "w").close()
until(lambda: screen() not in (0, first), "a screen after the exception")
second = screen()
print("after an exception: a new screen, runs:", moves(), "feed", s.feedrate)

os.kill(int(os.environ["SERVER"]), signal.SIGKILL)
until(lambda: screen() == 0, "the screen is gone")
print("without a screen runs:", moves())
time.sleep(2)            # it tries to come back, in vain
again = subprocess.Popen(["Xvfb", display, "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset", "-nolock"],
                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
until(lambda: screen() not in (0, second), "a screen on the new server")
print("the server is back: a new screen, runs:", moves(), "feed", s.feedrate)

again.kill()
again.wait()
until(lambda: screen() == 0, "the screen is gone")
print("without a screen runs:", moves())
time.sleep(8)
print("still:", moves())
hal.set_p("motion.digital-in-00", "1")
until(lambda: not runs(), "end of the program")
print("end:", round(s.actual_position[0], 3), "task on:", s.task_state == linuxcnc.STATE_ON)
