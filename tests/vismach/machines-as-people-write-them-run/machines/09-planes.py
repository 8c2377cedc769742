#!/usr/bin/env python3
# the tilted work plane, and a line between two points
from vismach import *
import hal
c = hal.component("m09")
names = ["ox", "oy", "oz", "xx", "xy", "xz", "zx", "zy", "zz", "ax", "ay", "az"]
for n in names:
    c.newpin(n, hal.HAL_FLOAT, hal.HAL_IN)
c["xx"] = c["zz"] = 1
c.newpin("order", hal.HAL_S32, hal.HAL_IN)
c.ready()
work, tooltip = Capture(), Capture()
plane = HalPlaneFromNormal(c, "ox", "oy", "oz", "zx", "zy", "zz", 200)
grid = HalGridFromNormalAndDirection(c, "ox", "oy", "oz", "xx", "xy", "xz", "zx", "zy", "zz", 100)
axes = HalCoordsFromNormalAndDirection(c, "ox", "oy", "oz", "xx", "xy", "xz", "zx", "zy", "zz", 50)
line = HalLine(c, "ox", "oy", "oz", "ax", "ay", "az", 10)
euler = HalRotateEuler([BoxCentered(10, 20, 30)], c, "ax", "ay", "az", 313)
moved = HalVectorTranslate([Collection([tooltip, Sphere(0, 0, 0, 3)])], c, "ax", "ay", 0)
main(Collection([work, Color([0, .5, 1, .3], [plane]), grid, axes, line, euler, moved, HalGrid(c, 100),
                 HalGridFromNormal(c, "ox", "oy", "oz", "zx", "zy", "zz", 60)]), tooltip, work, 200)
