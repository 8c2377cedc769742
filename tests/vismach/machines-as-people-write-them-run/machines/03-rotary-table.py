#!/usr/bin/env python3
from vismach import *
import hal
c = hal.component("m03")
[c.newpin(n, hal.HAL_FLOAT, hal.HAL_IN) for n in "xyzac"]
c.ready()
work = Capture()
platter = Collection([work, CylinderZ(-10, 40, 0, 40), Color([1, 1, 0, 1], [Box(-2, 0, 0, 2, 38, 1)])])
platter = HalRotate([platter], c, "c", 1, 0, 0, 1)
trunnion = Collection([platter, CylinderX(-60, 8, -40, 8), CylinderX(40, 8, 60, 8)])
trunnion = HalRotate([trunnion], c, "a", 1, 1, 0, 0)
trunnion = HalTranslate([trunnion], c, "x", -1, 0, 0)
tooltip = Capture()
spindle = Collection([tooltip, Translate([CylinderZ(0, 3, 40, 10)], 0, 0, 0),
                      Rotate([CylinderY(-5, 2, 5, 2)], 45, 0, 0, 1)])
spindle = HalTranslate([HalTranslate([spindle], c, "y", 0, 1, 0)], c, "z", 0, 0, 1)
main(Collection([trunnion, spindle]), tooltip, work, 250, lat=-60, lon=30)
