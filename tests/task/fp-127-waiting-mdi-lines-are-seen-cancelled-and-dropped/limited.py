# SPDX-License-Identifier: GPL-2.0-or-later
# [TASK]MDI_QUEUE: as many lines may wait, 0: none is taken while one is being executed.
from mill import *

on()
mode(MODE_MDI)
for line in ("G1 X1 F600", "M66 P0 L3 Q1", "G0 X10", "G0 X20", "G0 X30"):
    c.mdi(line)
    print(line, c.wait_complete(0.01), s.queued_mdi_commands if poll() else "", messages())
need(lambda s: s.interp_state == INTERP_IDLE, "end")
print(xyz(1))
print(mdi("G0 X5"), xyz(1))
