# SPDX-License-Identifier: GPL-2.0-or-later
# Probe moves one right after the other, from a program and by MDI: each is over when motion says so
# for that command, never by an older picture of it.
from mill import *

on()
print("program:", run("G21 G90 G0 X0 Z0\nF6000\no1 repeat [1500]\n  G38.3 Z-0.02\n  G38.3 Z0\no1 endrepeat\nM2\n",
                      2000), messages(), xyz())
wrong = []
for n in range(300):
    target = -0.05 * (n % 7) - 0.01
    result = mdi(f"G38.3 Z{target} F6000", 20)
    poll()
    if (result != RCS_DONE or s.probing or abs(s.position[2] - target) > 1e-6 or s.queue
            or abs(s.probed_position[2] - target) > 1e-3):
        wrong.append((n, result, s.probing, s.position[2], s.queue, s.probed_position[2]))
print("MDI:", wrong[:3], len(wrong), messages())
