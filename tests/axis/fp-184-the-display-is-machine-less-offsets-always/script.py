#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import math
import os
import random
import sys

import operator_lib

SEED, STEPS = int(os.environ.get("SEED") or 184), int(os.environ.get("STEPS") or 24)
SYSTEMS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")


def lines(op):
    """What the screen shows: numbers by the name before the colon, and the systems that it names."""
    found, systems = {}, set()
    for line in op.app.preview.readout_lines:
        name, colon, rest = line.partition(":")
        if colon and rest.split() and name.strip() in "XYZ":
            found[name.strip()] = float(rest.split()[0])
        elif line.split() and line.split()[0] in SYSTEMS:
            systems.add(line.split()[0])
    return found, systems


def relative(s):
    """The machine's position less all offsets."""
    x, y, z = (s.actual_position[i] - s.tool_offset[i] - s.g5x_offset[i] for i in range(3))
    a = math.radians(-s.rotation_xy)
    x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
    return [v - g92 for v, g92 in zip((x, y, z), s.g92_offset)]


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, pick, counts = op.app, random.Random(SEED), {"positions": 0, "parameters": 0, "moving": 0}

    def check(what):
        """The display against the very status that it was made from."""
        shown, systems = lines(op)
        s = app.stat
        wanted = dict(zip("XYZ", relative(s)))
        counts["positions"] += 1
        counts["moving"] += not s.inpos
        wrong = {n: (shown.get(n), v) for n, v in wanted.items() if n not in shown or abs(shown[n] - v) > 0.00051}
        if wrong or systems - {SYSTEMS[s.g5x_index - 1]}:
            raise AssertionError(f"seed {SEED}, after {what}: {wrong} {systems} G5x number {s.g5x_index}")

    def follow(what, seconds):
        for _ in range(round(seconds / 0.04)):
            op.wait(0.04)
            check(what)

    def parameters(what):
        """Interpreter's numbers of the same: system, offsets, position."""
        op.idle()
        app.notifications.clear()
        op.type("(debug,P #5220 #5420 #5421 #5422 #5211 #5212 #5213 #5210)")
        op.until(lambda: any(m.startswith("P ") for m in op.messages()), f"parameters after {what}")
        numbers = [float(w) for w in op.messages()[-1].split()[1:]]
        app.notifications.clear()
        s, shown = app.stat, lines(op)[0]
        good = numbers[0] == s.g5x_index and all(abs(n - shown[c]) < 0.001 for n, c in zip(numbers[1:4], "XYZ"))
        good = good and all(abs(n * numbers[7] - v) < 1e-5 for n, v in zip(numbers[4:7], s.g92_offset))
        counts["parameters"] += 1
        if not good:
            raise AssertionError(f"seed {SEED}, after {what}: parameters {numbers}, shown {shown}, G92 "
                                 f"{s.g92_offset[:3]}")

    def mdi(text):
        op.key("F5")
        op.type(text)
        follow(text, pick.choice((0.1, 0.3)))
        parameters(text)

    def number():
        return round(pick.uniform(-20, 20), 3)

    def program():
        op.key("F3")
        op.key("r")
        follow("run", pick.uniform(0.1, 2.0))
        op.key("Escape")
        follow("abort", 0.4)

    def restart():
        op.key("F1")
        follow("emergency stop", 0.2)
        op.power_on()

    def home_again():
        op.key("F3")
        app.command.teleop_enable(0)
        op.wait(0.1)
        app.command.unhome(-1)
        follow("unhome", 0.3)
        op.home()
        follow("homing", 0.3)
    steps = [lambda: mdi(pick.choice(SYSTEMS))] * 4 + [lambda: mdi(f"G10 L20 P0 X{number()} Y{number()}")] * 3 + [
        lambda: mdi(f"G10 L2 P{pick.randint(1, 9)} X{number()} Z{number()} R{pick.choice((0, 0, 30, 123.5))}"),
        lambda: mdi(f"G92 X{number()} Z{number()}"), lambda: mdi(pick.choice(("G92.1", "G92.2", "G92.3"))),
        lambda: mdi(f"G43.1 Z{number()}"), lambda: mdi("G49"),
        lambda: mdi(f"G53 G0 X{pick.uniform(5, 60):.3f} Y{pick.uniform(5, 60):.3f}"), lambda: mdi("T1 M6 G43"), program,
        program, restart, home_again]
    follow("the start", 0.2)
    op.power_on()
    follow("power", 0.2)
    op.key("Home", state=4)
    follow("homing", 1.0)
    op.until(app.all_homed, "homing")
    op.wait(0.2)
    for _ in range(STEPS):
        app.notifications.clear()
        pick.choice(steps)()
    print("the display agrees:", {name: n > 10 for name, n in counts.items()})


operator_lib.run(script)
