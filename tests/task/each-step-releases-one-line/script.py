# SPDX-License-Identifier: GPL-2.0-or-later
# The first STEP only arms; each later one lets one source line go; after the last the program is over.
from mill import *


def show(what):
    poll()
    print(f"{what:8} interp {s.interp_state} task_paused {s.task_paused} paused {s.paused} stepping "
          f"{s.single_stepping} line {s.current_line}", xyz(2), messages())


on()
program("G0 X10\nG0 X20\nG0 X30\nM2\n")
for n in range(1, 7):
    c.auto(AUTO_STEP)
    sleep(1)
    show(f"step {n}")
c.auto(AUTO_STEP)
sleep(0.5)
show("again")
c.abort()
sleep(0.1)
show("abort")
c.auto(AUTO_RUN, 0)
print(c.wait_complete(20))
show("run")
