# SPDX-License-Identifier: GPL-2.0-or-later
# Two minutes, or SOAK_HOURS, of a busy machine (a program in a loop, offsets, tool changes, messages, three clients
# that poll and read every attribute, one that dies again and again): none of the processes
# grows in memory or in open files.
import os
import re
import time

from mill import *
from process_sizes import sizes

ROUNDS = max(12, round(float(os.environ.get("SOAK_HOURS", "0")) * 360))  # of ten seconds
LOOKS = max(3, ROUNDS // 60)  # a long run looks six times an hour, and tells it in the file SOAK_LOG
WALL_END = time.monotonic() + float(os.environ.get("SOAK_WALL_S", "inf"))
NAMES = ("milltask", "rtapi_app", "halui", "linuxcncsvr", "client")
CLIENT = """
import linuxcnc
from kerf import clock
open("/proc/self/comm", "w").write("client")
clock.join("client", 600)
s, e, m = linuxcnc.stat(), linuxcnc.error_channel(), linuxcnc.message_log()
names = [n for n in dir(s) if not n.startswith("_") and n not in ("poll", "toolinfo")]
while True:
    s.poll()
    [getattr(s, n) for n in names]
    e.poll()
    m.poll()
    clock.sleep(0.02)
"""


on()
children = [clock.spawn(["/usr/bin/python3", "-c", CLIENT], f"client{n}", priority=600) for n in range(3)]
program("o1 while [1]\nG10 L2 P1 X0.25\nT1 M6\nT2 M6\nG0 X1\n(MSG, round)\nG1 F6000 X0\n(DEBUG, "
        "#5420)\no1 endwhile\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(20)
looks, errors, log = [sizes(NAMES)], 0, linuxcnc.message_log()
for n in range(ROUNDS):
    sleep(10)
    short = clock.spawn(["/usr/bin/python3", "-c",
                         "import linuxcnc; linuxcnc.stat().poll(); linuxcnc.command().debug(0)"], "short", priority=600)
    clock.wait_until(lambda: short.poll() is not None, 60)
    errors += sum(m["kind"] in (OPERATOR_ERROR, NML_ERROR) for m in log.poll())
    if n % (ROUNDS // LOOKS) == ROUNDS // LOOKS - 1:
        looks.append(sizes(NAMES))
        if file := os.environ.get("SOAK_LOG"):
            poll()
            with open(file, "a") as f:
                print(f"{(n + 1) / 360:.2f} h, {errors} errors, state {s.interp_state}, {looks[-1]}", file=f)
        if time.monotonic() > WALL_END:
            break
poll()
print("program runs:", s.interp_state != INTERP_IDLE, "errors:", errors)
looks = [looks[(len(looks) - 1) * n // 3] for n in range(4)]
first = looks[0]
# What leaks grows from third to third; a page touched for the first time does so once.
grown = {re.sub(r"\d+$", "", n): [l[n] for l in looks] for n in first
         if all(n in l for l in looks)
         and (all(b[n][0] - a[n][0] > 150 for a, b in zip(looks, looks[1:])) or looks[-1][n][1] > first[n][1] + 2)}
print(len(first), sorted({re.sub(r"\d+$", "", n) for n in first}), "grown:", grown)
if ROUNDS > 12:
    print((n + 1) / 360, "hours:", {n: [l.get(n) for l in looks] for n in first})
c.abort()
for child in children:
    child.kill()
    child.wait()
