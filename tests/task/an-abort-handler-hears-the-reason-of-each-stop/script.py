# SPDX-License-Identifier: GPL-2.0-or-later
# [RS274NGC]ON_ABORT_COMMAND runs once after each stop and hears why; it moves nothing, what it sets is in force, and
# one that is wrong is told and stops nothing else.
import hal
from mill import *


def heard():
    sleep(0.2)
    return messages()


PROGRAM = "G21 G90 F600\nM3 S500\nG92 X0\nG1 X40\nM2\n"


def started():
    if poll().task_state != STATE_ON:
        on(home=False)
        sleep(0.6)  # for so long an open chain is told as one that the reset has not closed
    mdi("G92.1")
    mdi("G53 G0 X0")
    program(PROGRAM)
    messages()
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.current_vel > 5, "motion")


def chain():
    halcmd("unlinkp", "iocontrol.0.emc-enable-in")
    hal.set_p("iocontrol.0.emc-enable-in", "0")


STOPS = {"abort": c.abort, "machine off": lambda: c.state(STATE_OFF), "emergency stop": lambda: c.state(STATE_ESTOP),
         "limit switch": lambda: hal.set_p("joint.1.neg-lim-sw-in", "1"), "chain": chain}
on()
for name, stop in STOPS.items():
    started()
    stop()
    sleep(0.01)
    there = xyz(0)
    print(f"{name}:", heard(), "at rest:", max(abs(a - b) for a, b in zip(there, xyz(0))) <= 1, "spindle",
          poll().spindle[0]["enabled"], "G92", s.g92_offset[0], s.interp_state == INTERP_IDLE)
    hal.set_p("joint.1.neg-lim-sw-in", "0")
    if name == "chain":
        hal.set_p("iocontrol.0.emc-enable-in", "1")
print("reset:", (c.state(STATE_ESTOP), c.wait_complete(), heard(), c.state(STATE_ESTOP_RESET), c.wait_complete(),
                 heard())[2::3])
on(home=False)
heard()
print("a mistake that is read:", run("G1 X[1/0]\nM2\n"), heard())
print("a mistake that is executed:", run("F100\nG2 X10 Y0 R1\nM2\n"), heard())
print("a mistake in MDI:", mdi("G1 X[1/0]"), heard())
print("a mode change:", (mode(MODE_MANUAL), mode(MODE_MDI), heard())[2])
Path("on_abort.ngc").write_text("o<on_abort> sub\nG1 X[1/0]\no<on_abort> endsub\nM2\n")
started()
c.abort()
print("a handler that is wrong:", heard(), mdi("G53 G0 X1"), xyz()[0])
