#!/usr/bin/python3
# A program beside the machine: the operator's hand, and who stops the screen's process.
import json
import os
import signal
import subprocess
import sys
import time

import hal
import hal.query
import linuxcnc

sys.stdout = open("../seen", "w", buffering=1)
s, c = linuxcnc.stat(), linuxcnc.command()


def comes(condition, seconds):
    end = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < end:
        time.sleep(0.02)
    return found


def until(condition, what, seconds=120):
    return comes(condition, seconds) or sys.exit(f"did not happen: {what}")


def x(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def state():
    """What the screen believes from now on."""
    try:
        os.unlink("../state")
    except FileNotFoundError:
        pass
    until(lambda: os.path.exists("../state"), "the screen gets on")
    with open("../state") as f:
        return json.load(f)


def speed(joint):
    return round(hal.get_value(f"joint.{joint}.vel-cmd"), 6)


def speeds(joint, seconds):
    found, end = set(), time.monotonic() + seconds
    while time.monotonic() < end:
        found.add(speed(joint))
        time.sleep(0.005)
    return found


def steady(joint):
    v = speed(joint)
    time.sleep(0.05)
    return v != 0 and v == speed(joint)


def frozen(what, joint, down, up, early):
    """early: the key is let go while the screen does not get on."""
    before = len(state()["said"])
    for _ in range(10):          # a screen that just does not get on, on a slow computer, takes no key
        x(*down)
        if comes(lambda: steady(joint), 10):
            break
        x(*up)
    open("../slow", "w").close()
    constant = len(speeds(joint, 0.8)) == 1
    os.unlink("../slow")
    state()
    os.kill(screen, signal.SIGSTOP)
    until(lambda: speed(joint) == 0, f"{what}: stop", 20)
    if early:
        x(*up)
    x("key", "F9", "key", "Home")        # in vain
    time.sleep(1.5)
    os.kill(screen, signal.SIGCONT)
    rests = speeds(joint, 0.6) == {0.0}
    if not early:
        x(*up)
    told = until(lambda: len(set((now := state())["said"][before:])) >= 3 and now, f"{what}: messages", 20)
    s.poll()
    print(f"{what}: constant {constant}, goes on: rests {rests}, jogs {told['jogs']}, spindle "
          f"{s.spindle[0]['direction']}", sorted(set(told["said"][before:])))


until(lambda: hal.component_exists("axisui") and hal.component_is_ready("axisui"), "the screen")
screen = hal.query.comp("axisui")["pid"]
until(state, "the screen")
for order in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    c.state(order)
    c.wait_complete()
state()
window = subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name", "AXIS.* on "],
                        stdout=subprocess.PIPE, text=True, check=True).stdout.split()[0]
x("windowfocus", window)
frozen("joint, key", 0, ("keydown", "Right"), ("keyup", "Right"), True)
c.home(-1)
until(lambda: s.poll() or all(s.homed[:4]), "homing")
c.teleop_enable(1)
c.wait_complete()
frozen("axis, key", 1, ("keydown", "Up"), ("keyup", "Up"), False)
frozen("angular axis, key", 3, ("keydown", "bracketright"), ("keyup", "bracketright"), True)
x("mousemove", *state()["plus"])
frozen("angular axis, mouse", 3, ("mousedown", 1), ("mouseup", 1), False)
x("keydown", "Down")
until(lambda: speed(1), "a new jog")
x("keyup", "Down")
until(lambda: speed(1) == 0, "its end", 20)
print("jogs again")
subprocess.run(["axis-remote", "--quit"], check=False, stdin=subprocess.DEVNULL)
