# SPDX-License-Identifier: GPL-2.0-or-later
"""The display of one session: moves and ends, or runs a program until everything is killed at once."""
import sys
import time

import session
from mill import *

JOURNAL_S = 1.2              # of wall time, in which it is written twice

on(home=sys.argv[1] != "look")
if sys.argv[1] == "position":
    mdi("G0 X7.5")
elif sys.argv[1] == "journal":
    program("G21 G90\nG1 X40 F60\nM2\n", "part.ngc")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line == 2, "the move")
    c.auto(AUTO_PAUSE)
    for _ in range(int(JOURNAL_S / 0.05)):
        time.sleep(0.05)
        clock.sleep(0.01)
    session.kill_all()
else:
    poll()
    print(s.cut_off_line, s.position[0])
