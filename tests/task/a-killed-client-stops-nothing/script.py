# SPDX-License-Identifier: GPL-2.0-or-later
# Clients that send commands, read status and messages and write tool data are killed while a program runs:
# it goes on to its end, and the next client is served at once.
import random
import signal
from mill import *

CLIENT = """
import linuxcnc
from kerf import clock
clock.join("client", 600)
s, c, e = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()
while True:
    s.poll()
    e.poll()
    c.feedrate(1.0)
    c.display_msg("from a client")
    s.toolinfo(2)
"""
R = random.Random(7)
on()
program("G61 F1200\no1 repeat [20]\nG1 X5\nG1 X0\no1 endrepeat\nT2 M6\nG1 X2\nM2\n")
c.auto(AUTO_RUN, 0)
killed = 0
for n in range(6):
    child = clock.spawn(["/usr/bin/python3", "-c", CLIENT + "    clock.sleep(0.001)\n"], f"client{n}", priority=600)
    sleep(R.uniform(0.05, 0.4))
    child.send_signal(signal.SIGKILL)
    child.wait()
    killed += 1
    before = s.taskbeat if poll() else 0
    sleep(0.05)
    if poll().taskbeat - before < 20:
        print("client", n, "held task back")
    messages()
print(killed, "clients killed", c.wait_complete(100) if c.auto(AUTO_FORWARD) is None else 0)
idle()
print(xyz(1), poll().tool_in_spindle, mdi("G10 L1 P2 Z51"), s.interp_state)
