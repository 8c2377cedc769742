#!/usr/bin/env python3
# the mill of a tutorial: table on saddle, head on column
from vismach import *
import hal

c = hal.component("m01")
c.newpin("joint0", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("joint1", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("joint2", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()

work = Capture()
table = Collection([
    Box(-50, -20, -10, 50, 20, 0),
    Color([0.8, 0.2, 0.2, 1], [BoxCentered(10, 10, 10)]),
    work])
table = HalTranslate([table], c, "joint0", -1, 0, 0)
saddle = Collection([table, Color([0.4, 0.4, 0.5, 1], [Box(-15, -30, -20, 15, 30, -10)])])
saddle = HalTranslate([saddle], c, "joint1", 0, -1, 0)
tooltip = Capture()
tool = Collection([tooltip, CylinderZ(0, 0.5, 10, 2), CylinderZ(10, 6, 30, 6)])
head = HalTranslate([Translate([tool], 0, 0, 20)], c, "joint2", 0, 0, 1)
base = Collection([Box(-60, -40, -30, 60, 60, -20), Box(-10, 40, -20, 10, 60, 80)])
model = Collection([saddle, head, base])
main(model, tooltip, work, 150, hud=None, rotation_vectors=[(1, 0, 0), (0, 0, 1)], lat=-75, lon=215)
