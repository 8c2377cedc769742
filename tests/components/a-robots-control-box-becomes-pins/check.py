# SPDX-License-Identifier: GPL-2.0-or-later
"""scorbot-er-3 with a control box on a pty: pins, moves, velocities, limit switches; a box that is silent, says
nonsense, or is unplugged."""
import re
import threading

from drive_program import DriveProgram, refusals
from hal_outside import pins, until
from pty_line import PtyLine

COMMAND = re.compile(rb"(X)|(\d)([mv])(-?\d+)\n(\r?)|(\d)l")


class Box(PtyLine):
    def __init__(self, link):
        self.switches, self.silent, self.told, self.looks = "01000001", False, [], 0
        self.changed = threading.Lock()
        super().__init__(link)

    def take(self, data, write):
        while data and (command := COMMAND.match(data)):
            data = data[command.end():]
            if joint := command.group(6):
                if not self.silent:
                    write(self.switches[int(joint) - 1].encode())
                self.looks += joint == b"8"
                continue
            assert bool(command.group(5)) == (command.group(3) == b"m")
            with self.changed:
                self.told.append(command.group().decode().strip())
        return data

    def heard(self):
        """What was told since the last call."""
        with self.changed:
            told, self.told = self.told, []
        return told


def rounds():
    """The program has sent what it had to send."""
    seen = box.looks
    until_silently(lambda: box.looks >= seen + 3)


def until_silently(condition):
    while not condition():
        pass


box = Box("line")
robot = DriveProgram("scorbot-er-3", "line")
print(pins("scorbot-er-3.joint[07].*"), len(pins("scorbot-er-3.*").splitlines()))
rounds()
print(box.heard(), robot.all("joint0.motor-max-vel joint7.scale joint0.limit-sw joint1.limit-sw joint7.limit-sw"))


def move(**values):
    robot.set(**values)
    rounds()
    print(values, box.heard())


def joint(number, **values):
    move(**{f"joint{number}.{name}": value for name, value in values.items()})


joint(0, motor_pos_cmd=12.9)
joint(0, scale=-2)
joint(0, motor_pos_cmd=12.4)
joint(7, motor_pos_cmd=1e12)
joint(7, motor_max_vel=4)
for value in ("nan", "inf", "-inf"):
    joint(7, motor_pos_cmd=value)
joint(7, motor_pos_cmd=1e12 + 5)
box.switches = "10000010"
rounds()
print(robot.all("joint0.limit-sw joint1.limit-sw joint6.limit-sw joint7.limit-sw"))
print("== silent, then nonsense")
box.silent = True
rounds()
box.silent, box.switches = False, "x0000010"
rounds()
box.switches = "00000000"
until(lambda: not robot.is_true("joint0.limit-sw"), "answers again")
print("== unplugged: nothing of what was asked for meanwhile is made up for")
box.unplug()
robot.set(**{"joint0.motor_pos_cmd": 500})
box.heard()
box.plug()
until(lambda: "8v4" in box.told, "found again")
print(box.heard())
joint(0, motor_pos_cmd=501)
status, told = robot.end()
print(status, *told[:2], "and", len(told) - 2, "of the line", sep="\n")
print("== without a line")
robot = DriveProgram("scorbot-er-3", "/nothing")
print(*robot.end())
refusals("scorbot-er-3", ["a", "b"])
