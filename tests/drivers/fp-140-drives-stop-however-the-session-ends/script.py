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
c.mdi("M3 S600")
for _try in range(1000):
    sleep(0.01)
    if flag.exists():
        break
    time.sleep(0.01)            # the drives live in real time
print("the drives turn" if flag.exists() else "the drives do not turn")
if way == "launcher":
    os.kill(session.processes("linuxcnc")[0], 9)
elif way != "screen":
    session.kill(way)
if way != "screen":
    clock.leave()
    time.sleep(60)
