#!/usr/bin/env python3
# a tool whose size comes from pins, by a class of the user's own
from vismach import *
import hal
import math
import sys

for setting in sys.argv[1:]: exec(setting)

c = hal.component("m02")
for name in ("x", "y", "z", "tool-length", "tool-radius"):
    c.newpin(name, hal.HAL_FLOAT, hal.HAL_IN)
c["tool-length"] = 20
c["tool-radius"] = 2
c.ready()


class HalToolCylinder(CylinderZ):
    def __init__(self, comp, *args):
        CylinderZ.__init__(self, *args)
        self.comp = comp

    def coords(self):
        length, radius = self.comp["tool-length"], max(self.comp["tool-radius"], 0.1)
        return -length, radius, 0, radius


tooltip = Capture()
tool = Collection([HalTranslate([tooltip], c, "tool-length", 0, 0, -1), HalToolCylinder(c, 0, 0, 0, 0)])
head = Collection([tool, Color((0.3, 0.3, 0.7, 1), [CylinderZ(0, 8, 25, 12)])])
head = HalTranslate([head], c, "z", 0, 0, 1)
work = Capture()
table = HalTranslate([HalTranslate([Collection([work, Box(-40, -40, -65, 40, 40, -60)])], c, "x", -1, 0, 0)], c, "y",
                     0, -1, 0)
main(Collection([head, table]), tooltip, work, 200)
