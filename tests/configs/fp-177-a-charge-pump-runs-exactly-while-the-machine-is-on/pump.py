# SPDX-License-Identifier: GPL-2.0-or-later
import hal
from mill import *


def pumping():
    """Whether the pin of the pump changes; looked at every 7 base periods, for it changes in each."""
    edges, last = 0, hal.get_value("parport.0.pin-17-out-fake")
    for _ in range(40):
        sleep(0.00035)
        now = hal.get_value("parport.0.pin-17-out-fake")
        edges += now != last
        last = now
    return edges > 4


def state(what):
    sleep(0.1)
    enabled, closed = hal.get_value("motion.motion-enabled"), hal.get_value("estop.ok-out")
    print(f"{what}: chain closed {closed}, machine on {enabled}, pump {pumping()}, agrees "
          f"{pumping() == (enabled and closed)}")


state("start")
c.state(STATE_ESTOP_RESET)
state("reset")
c.state(STATE_ON)
state("on")
c.state(STATE_OFF)
state("off")
c.state(STATE_ON)
state("on again")
hal.set_p("parport.0.pin-10-in-fake", "0")
state("the button pressed")
c.state(STATE_ON)
state("on asked for while it is pressed")
hal.set_p("parport.0.pin-10-in-fake", "1")
state("the button released")
c.state(STATE_ESTOP_RESET)
state("reset")
c.state(STATE_ON)
state("on")
c.state(STATE_ESTOP)
state("the operator's stop")
