# SPDX-License-Identifier: GPL-2.0-or-later
# FP-045: steps of an override start from the present value, however it was set, end at the limits without wrapping,
# and the first one back acts; a jog goes on at any override.
import hal

from mill import *

me = hal.component("panel")
me.ready()
on()


def put(pin, value):
    hal.set_p("halui." + pin, str(value))
    sleep(0.1)


def press(pin, times=1):
    for _ in range(times):
        put(pin, 1)
        put(pin, 0)


for name, read in (("feed-override", lambda: poll().feedrate), ("rapid-override", lambda: poll().rapidrate),
                   ("spindle.0.override", lambda: poll().spindle[0]["override"])):
    put(f"{name}.scale", 0.1)
    way = []
    for pin, times in (("increase", 30), ("decrease", 1), ("decrease", 30), ("increase", 1)):
        press(f"{name}.{pin}", times)
        way.append(round(read(), 3))
    put(f"{name}.counts", 500)
    way.append(round(read(), 3))
    put(f"{name}.counts", 499)
    way.append(round(read(), 3))
    {"f": c.feedrate, "r": c.rapidrate, "s": lambda v: c.spindleoverride(v, 0)}[name[0]](0.75)
    c.wait_complete()
    put(f"{name}.counts", 500)
    way.append(round(read(), 3))
    print(name, way)
mode(MODE_MANUAL)
c.teleop_enable(1)
c.wait_complete()
for scale in (1.0, 0.37):
    c.feedrate(scale)
    c.wait_complete()
    before = xyz()[0]
    c.jog(JOG_INCREMENT, False, 0, 10, 2)
    until(lambda s: abs(xyz()[0] - before - 2) < 1e-6)
    print("jog at", scale, round(xyz()[0] - before, 3))
