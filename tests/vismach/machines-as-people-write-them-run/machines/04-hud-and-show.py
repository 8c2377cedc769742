#!/usr/bin/env python3
# a head-up display with pins, and parts that a pin shows
from vismach import *
import hal
c = hal.component("m04")
c.newpin("x", hal.HAL_FLOAT, hal.HAL_IN)
c.newpin("tool", hal.HAL_S32, hal.HAL_IN)
c.newpin("clamped", hal.HAL_BIT, hal.HAL_IN)
c.ready()
hud = Hud()
hud.show("Machine four")
hud.add_txt("----------")
hud.add_pin("X: {:8.3f}", "m04.x")
hud.add_txt("CLAMPED", "clamp")
hud.show_tags_in_pin("m04.clamped")
hud.set_hud_rgba(0, 0, .4, .6)
hud.set_hud_text_rgb(1, 1, 1)
work, tooltip = Capture(), Capture()
jaw = HalShow([Color([1, 0, 0, 1], [BoxCenteredXY(10, 10, 20)])], c, True, "clamped", 1, 0)
tools = Collection([HalShow([CylinderZ(0, r, 20, r)], c, r, "tool") for r in (1, 2, 3)])
model = Collection([work, HalTranslate([Collection([tooltip, tools])], c, "x", 1, 0, 0), jaw,
                    Scale([Sphere(0, 0, 0, 5)], 1, 1, 2)])
main(model, tooltip, work, 100, hud=hud)
