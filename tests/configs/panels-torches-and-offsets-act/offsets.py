# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *

MAP = [(-100, 0.0), (-50, 0.45), (0, 0.8), (50, 0.6), (100, -0.2)]


def height(x):
    for (a, low), (b, high) in zip(MAP, MAP[1:]):
        if a <= x <= b:
            return low + (high - low) * (x - a) / (b - a)


on()
mdi("G21 G90 G0 X-90 Y0 Z0")
sleep(1)
mode(MODE_MDI)
c.mdi("G1 X90 F1200")
need(lambda s: not s.inpos, "motion")
worst = 0
while not poll().inpos:
    x, z = (hal.get_value(f"joint.{j}.pos-cmd") for j in (0, 2))
    if abs(x) < 85:
        worst = max(worst, abs(z - height(x)))
    sleep(0.02)
print("the axis follows the surface within 0.02 mm:", worst < 0.02)
print("at X90:", round(hal.get_value("axis.z.eoffset"), 3), "limited:", hal.get_value("motion.eoffset-limited"))
print("the program's own Z stays:", round(hal.get_value("joint.2.pos-cmd") - hal.get_value("axis.z.eoffset"), 3))
