# SPDX-License-Identifier: GPL-2.0-or-later
import signal
import sys
import time

import session
from mill import *

part = sys.argv[1]
folder = Path.cwd()
journal = folder / "mill.var.journal"
TEXT = """G21 G90 G17 G94 G64 P0.05
T2 M6
G43
G10 L2 P2 X10 Y5
G55
M3 S1200
M8
G0 Z60
G1 X10 F6000
G1 X20 F60
G1 Y10
G1 X0
M2
"""


def gone():
    for _ in range(1000):
        if not journal.exists():
            return True
        time.sleep(0.01)
    return False


if part == "cut":
    print("nothing was cut off before:", messages())
    on()
    run("G0 X1\nM2\n")
    print("a program that ended leaves nothing:", gone())
    program(TEXT, "part.ngc")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == 10 and s.position[0] > 21, "line 10")
    c.auto(AUTO_PAUSE)      # the journal is written in wall time: it is to say line 10
    for _ in range(400):
        if journal.exists() and "line 10\n" in journal.read_text():
            break
        c.auto(AUTO_RESUME)
        sleep(0.001)
        c.auto(AUTO_PAUSE)
        time.sleep(0.05)
    for text in journal.read_text().splitlines():
        if not text.startswith(("time", "position")):
            print("   ", text)
    session.kill("milltask")
    signal.pause()
elif part == "again":
    told = []
    clock.wait_until(lambda: told.extend(messages()) or told, 5)
    print(len(told), told[0].split(" (", 1)[0] if told else None)
    on()
    mode(MODE_AUTO)
    c.program_open(str(folder / "part.ngc"))
    c.wait_complete()
    before = xyz()
    line = int([l for l in journal.read_text().splitlines() if l.startswith("line ")][0].split()[1])
    c.restore(line)
    print("restore:", until(lambda s: s.restore_line == line, 10))
    print(s.restore_text)
    sleep(2)
    poll()
    print("nothing moved or started:", xyz() == before, s.spindle[0]["enabled"], s.flood, s.tool_in_spindle)
    c.restore_confirm(line)
    need(lambda s: s.motion_line == line and s.spindle[0]["enabled"] and s.current_vel > 0 and s.g5x_index == 2,
         "the line", 100)
    print("goes on:", s.spindle[0]["speed"], s.flood, s.tool_in_spindle, s.g5x_index)
    c.abort()
    c.wait_complete()
    print("stopped by the operator, it leaves nothing:", gone())
else:
    print("nothing was cut off:", messages())
