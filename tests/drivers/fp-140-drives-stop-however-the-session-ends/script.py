# SPDX-License-Identifier: GPL-2.0-or-later
"""The screen: starts the spindle, waits until the drives turn, then something ends."""
import os
import time

import session
from mill import *

way, flag = os.environ["WAY"], Path(os.environ["TURNING"])
on(home=False)
c.mode(MODE_MDI)
c.wait_complete()


def turning(tries):
    for _try in range(tries):
        sleep(0.01)
        if flag.exists():
            return True
        time.sleep(0.01)        # the drives live in real time
    return False


# A drive that has not answered yet when the spindle starts waits for the next start.
for _start in range(20):
    mdi("M5")
    turning(30)
    mdi("M3 S600")
    if turning(100):
        break
print("the drives turn" if flag.exists() else "the drives do not turn")
if way == "launcher":
    os.kill(session.processes("linuxcnc")[0], 9)
elif way != "screen":
    session.kill(way)
if way != "screen":
    clock.leave()
    time.sleep(60)
