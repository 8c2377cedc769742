# SPDX-License-Identifier: GPL-2.0-or-later
# FP-122, FP-125: a thousand probe moves in a row, each followed at once by the next; 100 times out of
# emergency stop and on, each command sent the moment the one before is done. PROBES and STARTS for more.
import os

from mill import *

PROBES, STARTS = int(os.environ.get("PROBES", "1000")), int(os.environ.get("STARTS", "100"))

on()
mdi("G53 G0 Z50")
program(f"F60000\n#1 = 0\no1 repeat [{PROBES // 2}]\nG91\nG38.3 X0.2\nG38.3 X-0.2\nG90\n#1 = [#1 + #5070]\n"
        "o1 endrepeat\n(debug,contacts #1)\nM2\n")
c.auto(AUTO_RUN, 0)
print(c.wait_complete(PROBES), messages(), xyz(3))
missed = 0
for n in range(STARTS):
    c.state(STATE_ESTOP)
    c.state(STATE_ESTOP_RESET)
    c.wait_complete()
    c.state(STATE_ON)
    c.wait_complete()
    if not until(lambda s: s.task_state == STATE_ON, 0.1):
        missed += 1
print("not on", missed, all(poll().homed[:3]), messages())
