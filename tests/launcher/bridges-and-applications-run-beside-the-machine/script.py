# SPDX-License-Identifier: GPL-2.0-or-later
"""The display: what the bridge, an application and the limits of the spindle override are."""
import os

import hal
from kerf import clock

clock.join("script", 900)
print("bridge with", hal.get_value("bridge.arguments"), "arguments")
for name, value in (("direct-value", 1), ("scale", 0.01), ("count-enable", 1)):
    hal.set_p(f"halui.spindle.0.override.{name}", str(value))
for counts in (500, 1):
    hal.set_p("halui.spindle.0.override.counts", str(counts))
    clock.sleep(0.3)
    print("override", round(hal.get_value("halui.spindle.0.override.value"), 3))
clock.wait_until(lambda: os.path.exists("application.out") and os.path.getsize("application.out"), 20000)
print(open("application.out").read(), end="")
