# SPDX-License-Identifier: GPL-2.0-or-later
# The request names number, diameter and comment; a button of the machine confirms it; each confirmation leads on, from
# MDI, from a program and inside a remapped M6; none confirms the next request; a stop withdraws the request.
import hal
from kerf.tktools.hal_manualtoolchange import request_text
from mill import *

me = hal.component("button")
me.ready()


def asked():
    need(lambda s: hal.get_value("hal_manualtoolchange.change"), "request")
    print("asked:", request_text(hal.get_value("hal_manualtoolchange.number")).split("\n", 2)[-1:])


def press():
    hal.set_p("hal_manualtoolchange.change_button", "1")
    sleep(0.3)
    hal.set_p("hal_manualtoolchange.change_button", "0")
    sleep(0.1)


on()
mode(MODE_MDI)
c.mdi("T2 M6")
asked()
press()
print("MDI:", c.wait_complete(5), poll().tool_in_spindle, s.tool_offset[2], messages())
program("T1 M6\nG0 X1\nT3 M6\nG0 X2\nM2\n")
c.auto(AUTO_RUN, 0)
asked()
sleep(2)
print("waits:", poll().tool_in_spindle, xyz()[0])
press()
asked()
print("the second one waits too:", poll().tool_in_spindle, xyz()[0])
press()
print("program:", c.wait_complete(10), poll().tool_in_spindle, s.tool_offset[2], xyz()[0], messages())
c.auto(AUTO_RUN, 0)
asked()
c.abort()
c.wait_complete()
sleep(0.5)
print("stopped:", hal.get_value("hal_manualtoolchange.change"), hal.get_value("hal_manualtoolchange.changed"),
      poll().tool_in_spindle)
press()
mode(MODE_MDI)
c.mdi("T1 M6")
asked()
sleep(1)
print("a button pressed in between confirms nothing:", poll().tool_in_spindle)
press()
print("then:", c.wait_complete(5), poll().tool_in_spindle, messages())
mode(MODE_MDI)
c.mdi("T0 M6")
asked()
press()
print("none:", c.wait_complete(5), poll().tool_in_spindle)
