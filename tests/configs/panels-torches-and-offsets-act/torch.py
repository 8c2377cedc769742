# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *


def follow(text):
    """Runs a program; (gap, height controlled, trim) every 20 ms while the arc burns."""
    program(text)
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.interp_state != INTERP_IDLE, "start")
    rows = []
    while poll().interp_state != INTERP_IDLE or not s.inpos:
        if hal.get_value("arc-ok"):
            rows.append((hal.get_value("torch-gap"), hal.get_value("thc-active"), hal.get_value("trim")))
        sleep(0.02)
    return rows


on()
begin = "G21 G90 G64 P0.2 G52 Z-100\nG0 X30 Y50 Z3.8\nM3 S1\nG1 Z1.5 F1500\nG4 P0.5\n"
rows = follow(begin + "G1 X580 F3000\nM5\nG0 Z20\nG52 Z0\nM2\n")
cut = [gap for gap, active, _ in rows if active]
print("cut under control:", len(cut) > 300, "worst gap error below 0.5 mm:", max(abs(g - 1.5) for g in cut[100:]) < 0.5)
print("trim went up and down:", max(t for *_, t in rows) > 0.5, min(t for *_, t in rows) < -0.5)
print("given back:", abs(poll().actual_position[2] + 80) < 0.01, hal.get_value("axis.z.eoffset"))

# Slower than 90 % of the programmed feed: the height is held, the torch does not dive.
c.feedrate(0.5)
rows = follow(begin + "G1 X580 F3000\nM5\nG0 Z20\nG52 Z0\nM2\n")
c.feedrate(1)
rows = follow("G21 G90 G61 G52 Z-100\nG0 X130 Y50 Z3.8\nM3 S1\nG1 Z1.5 F1500\nG4 P0.5\nG1 X170 F6000\nG1 Y51\n"
              "G1 X168\nM5\nG0 Z20\nG52 Z0\nM2\n")
held = [b[2] - a[2] for a, b in zip(rows, rows[1:]) if not a[1] and not b[1]]
print("held in corners:", len(held) > 0 and max(map(abs, held)) < 0.02)
