#!/usr/bin/env python3
# pins of programs that are not there yet, a scale of 0 and a part of one's own that fails until its pin has a value
from vismach import *
import hal
c = hal.component("m11")
for name in ("x", "grow", "load"):
    c.newpin(name, hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
c["load"] = float("nan")


class Gauge:
    def draw(self):
        glPushMatrix()
        Box(0, 0, 0, 10, 10, 100 / c["x"]).draw()
        glPopMatrix()


hud = Hud()
hud.show("Machine eleven")
hud.add_pin("load {:5.1f} %", "spindle-vfd.0.load")
hud.add_txt("FAULT", 7)
hud.show_tags_in_pin("m11.load")
hud.show_tag_if_same("coolant", "coolant-unit.on")
hud.hide_all("another.pin")
work, tooltip = Capture(), Capture()
table = HalScale([work, Box(-50, -50, -10, 50, 50, 0)], c, 1, 1, 1, "grow")
arm = HalRotateEuler([Translate([tooltip, Gauge()], 0, 0, 10)], c, "x", 0, 0, "load")
main(Collection([table, arm]), tooltip, work, 100, hud)
