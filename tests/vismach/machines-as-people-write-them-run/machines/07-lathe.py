#!/usr/bin/env python3
# a lathe: the chuck turns with the spindle, the turret is tilted
from vismach import *
import hal
c = hal.component("m07")
c.newpin("x", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("z", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("spindle-revs", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
work = Capture()
jaws = [Rotate([Box(20, -5, 0, 35, 5, 20)], n * 120, 0, 0, 1) for n in range(3)]
chuck = HalRotate([Collection(jaws + [CylinderZ(-20, 40, 0, 40), Color([.9, .9, .6, 1], [CylinderZ(0, 15, 80, 15)])])],
                  c, "spindle-revs", 360, 0, 0, 1)
tooltip = Capture()
insert = Collection([tooltip, Color([1, .8, 0, 1], [TriangleXZ(0, 0, 8, 3, 3, 8, -2, 2)]),
                     TriangleXY(0, 0, 5, 0, 0, 5, 0, 1), TriangleYZ(0, 0, 5, 0, 0, 5, 0, 1)])
holder = Collection([insert, Box(5, -4, 3, 40, 4, 12), ArcX(40, 60, 15, 30, 0, 270, 24)])
slide = HalTranslate([HalTranslate([holder], c, "x", 1, 0, 0)], c, "z", 0, 0, 1)
model = Rotate([Collection([work, chuck, slide])], -90, 0, 1, 0)
main(model, tooltip, work, 200, lat=-30, lon=-30)
