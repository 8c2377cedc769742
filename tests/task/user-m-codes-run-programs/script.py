# SPDX-License-Identifier: GPL-2.0-or-later
import re

import mill
from mill import *


def messages():
    return [re.sub(r"/\S*/", "", m) for m in mill.messages()]


on()
print(mdi("M101 P1.5"), messages(), open("mcode.log").read().strip(), getp("motion.digital-in-03"))
print(mdi("M102"), messages())
print(mdi("M104"), messages())
print(mdi("M105"), messages())
mode(MODE_MDI)
c.mdi("M103")
sleep(0.5)
poll()
print("running", s.interp_state, s.exec_state)
c.abort()
sleep(0.1)
poll()
print("aborted", s.interp_state, s.exec_state, messages())
print(run("M101 P1 Q2\nG0 X1\nM102\nG0 X2\nM2\n"), xyz(1), messages(), poll().interp_state)
