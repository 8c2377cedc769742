# SPDX-License-Identifier: GPL-2.0-or-later
# A panel's keys switch the machine on, home and jog it, turn the spindle and run a program.
from mill import *

def hal(*words, feed=None):
    """Output goes to a file: a program that is started keeps it open."""
    with open("said", "w") as said:
        status = clock.run(words, input=feed, text=True, stdout=said, stderr=said).returncode
    return status, open("said").read()


def codes(*numbers):
    """Scan codes, a cycle each, as the keypad sends them."""
    hal("halstreamer", feed="".join(f"{n}\n" for n in numbers) + "64\n")
    sleep(0.05)


def down(row, column):
    codes(0xC0 | row << 3 | column)


def up(row, column):
    codes(0x80 | row << 3 | column)


def press(row, column):
    down(row, column)
    up(row, column)


def at(axis):
    return round(poll().position[axis], 3)


print("loaded", hal("halcmd", "loadusr", "-W", "panelui")[0])
press(0, 0)
need(lambda s: s.task_state == STATE_ESTOP_RESET, "estop reset")
press(0, 1)
need(lambda s: s.task_state == STATE_ON, "machine on")
press(0, 2)
need(lambda s: all(s.homed[:s.joints]), "homing")
press(1, 0)
press(1, 1)
need(lambda s: s.mist and s.flood, "coolant")
press(1, 0)
need(lambda s: not s.mist and s.flood, "mist off")
press(1, 2)
need(lambda s: s.optional_stop, "optional stop")
press(2, 2)
before = at(0)
down(2, 0)
sleep(0.5)
up(2, 0)
sleep(1)
stopped = at(0)
sleep(1)
print("jogged for half a second at 10/s:", 3 < stopped - before < 8, "and stopped:", at(0) == stopped)
before = at(1)
press(2, 1)
sleep(2)
print("one step", round(at(1) - before, 3))
press(3, 0)
need(lambda s: s.spindle[0]["speed"] == 500, "spindle forward")
press(3, 0)
need(lambda s: s.spindle[0]["speed"] == 600, "faster")
press(3, 1)
press(3, 1)
need(lambda s: s.spindle[0]["speed"] == 400, "slower")
press(3, 2)
need(lambda s: s.spindle[0]["speed"] == 0, "spindle stop")
press(4, 0)
need(lambda s: at(0) == 1 and at(1) == 2, "MDI")
need(lambda s: s.task_mode == MODE_MANUAL, "manual mode again")
press(4, 1)
need(lambda s: at(0) == 3, "MDI line")
print("mode stays MDI:", poll().task_mode == MODE_MDI)
program("G1 F60 X4\nG1 X5\nG1 X20\nM2\n")
press(5, 0)
need(lambda s: at(0) > 4, "start")
down(6, 0)
need(lambda s: s.feedrate == 0.5, "feed override")
up(6, 0)
need(lambda s: s.feedrate == 1, "feed override back")
press(5, 1)
need(lambda s: s.paused, "pause")
press(4, 1)
sleep(0.5)
print("no MDI while a program waits:", poll().task_mode == MODE_AUTO)
press(5, 0)
need(lambda s: not s.paused and at(0) > 6, "resume")
press(5, 2)
need(lambda s: s.interp_state == INTERP_IDLE, "abort")
press(6, 1)
need(lambda s: s.interp_state == INTERP_IDLE and at(2) == 0, "quill up")
press(7, 7)
need(lambda s: s.task_state != STATE_ON, "machine off")
hal("halcmd", "unloadusr", "panelui")
print("done", [m for m in messages() if "panel" in m])
