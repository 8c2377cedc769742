#!/usr/bin/env python3
# struts that point at each other (hexapods, deltas), a pin for scale, two components
from vismach import *
import hal
c = hal.component("m10")
c.newpin("height", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("swell", hal.HAL_FLOAT, hal.HAL_IN)
c["swell"] = 1
c["height"] = 80
c.ready()
tooltip, work = Capture(), Capture()
feet, heads = [Capture() for n in range(3)], [Capture() for n in range(3)]
struts = [Track([CylinderZ(0, 3, 100, 3)], feet[n], heads[n], work) for n in range(3)]
base = Collection([work]
                  + [Rotate([Translate([feet[n], Sphere(0, 0, 0, 4)], 60, 0, 0)], 120 * n, 0, 0, 1) for n in range(3)])
platform = Collection([tooltip, CylinderZ(0, 30, 5, 30)]
                      + [Rotate([Translate([heads[n]], 25, 0, 0)], 120 * n, 0, 0, 1) for n in range(3)])
model = Collection([base, HalTranslate([platform], c, "height", 0, 0, 1),
                    HalScale([BoxCentered(5, 5, 5)], c, 1, 1, 1, "swell")] + struts)
main(model, tooltip, work, 300)
