#!/usr/bin/env python3
# a robot: rotations in a chain, degrees from joints
from vismach import *
import hal
c = hal.component("m06")
for n in range(4):
    c.newpin("joint%d" % n, hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
D1, D2, D3 = 150.0, 120.0, 100.0
tooltip = Capture()
hand = Collection([tooltip, CylinderZ(0, 2, 40, 8), Box(-6, -2, 40, 6, 2, 44)])
hand = HalRotate([hand], c, "joint3", 1, 0, 0, 1)
hand = HalTranslate([hand], c, "joint2", 0, 0, 1)
outer = Collection([Translate([hand], D3, 0, -60), Color((.8, .5, .1, 1), [Box(0, -10, -10, D3, 10, 10)]),
                    CylinderZ(-12, 14, 12, 14)])
outer = HalRotate([outer], c, "joint1", 1, 0, 0, 1)
inner = Collection([Translate([outer], D2, 0, 0), Box(0, -12, -10, D2, 12, 10), CylinderZ(-15, 16, 15, 16)])
inner = HalRotate([inner], c, "joint0", 1, 0, 0, 1)
work = Capture()
floor = Collection([Box(-200, -200, -2, 300, 200, 0), Translate([work], 0, 0, 0), CylinderZ(0, 25, D1 - 15, 20)])
model = Collection([floor, Translate([inner], 0, 0, D1)])
main(model, tooltip, work, 600)
