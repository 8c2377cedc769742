# FP-029: a set speed alone is not shown as turning; orientation and running exclude each other; with constant surface
# speed the status has the commanded rpm, D only where it acts, beside the surface speed that
# is set and the measured rpm.
import os

import hal
from mill import *

h = hal.component(f"turns{os.getpid()}")
h.ready()


def pin(name):
    return hal.get_value(f"spindle.0.{name}")


def show(what, wait=0.3):
    """State of spindle 0 in the status; what its outputs do."""
    sleep(wait)
    now = poll().spindle[0]
    print(f"{what}: speed {now['speed']:.1f} direction {now['direction']} enabled {now['enabled']} orient "
          f"{now['orient_state']}, "
          f"set {s.settings[2]:g};", *(p for p in ("on", "forward", "reverse", "orient", "locked") if pin(p)),
          f"{pin('speed-out'):.1f}", messages())


on()
mdi("S4000")
show("S4000 alone")
for stop in (lambda: c.spindle(SPINDLE_OFF), c.abort, lambda: mdi("M5")):
    mdi("M4 S500")
    show("M4 S500")
    stop()
    mdi("S4000")
    show("S4000 after a stop")
mdi("M3 S600")
c.mdi("M19 R90 Q5")
show("M19 while M3 is active", 0.5)
setp("spindle.0.is-oriented", 1)
c.wait_complete(5)
setp("spindle.0.is-oriented", 0)
show("oriented")
mdi("S700")
show("S700 after it")
mdi("M3")
show("M3")
c.mdi("M19 R0 Q5")
sleep(0.5)
c.abort()
show("M19, aborted")
mdi("G21 G18 G90 G0 X20")
mdi("G96 D3000 S170 M3")
show("G96 at 20", 0)
print("measured apart", pin("speed-in") * 60 < 1300)
sleep(3)
print("measured, at speed", round(pin("speed-in") * 60 / 1352.8, 2))
for x in (40, 5):
    mdi(f"G0 X{x}")
    show(f"at {x}")
c.spindleoverride(0.5)
show("override 50 %")
c.spindleoverride(1.0)
mdi("G0 X20 M5")
show("M5")
mdi("M4")
show("M4")
mdi("G97 S400")
show("G97 S400")
