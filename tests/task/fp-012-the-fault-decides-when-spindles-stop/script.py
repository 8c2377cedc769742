# SPDX-License-Identifier: GPL-2.0-or-later
# FP-012: each fault has its stop: the spindle goes off at once or when the joints stand; how a joint leaves its switch.
import hal
from mill import *

COAST = "sum2.0.in1"
FAULTS = {"limit": ("joint.0.neg-lim-sw-in", "1"), "amplifier": ("joint.1.amp-fault-in", "1"),
          "following error": (COAST, "5")}


def on_and_turning():
    if poll().task_state != STATE_ON:
        on(home=not all(s.homed[:3]))
    mdi("G53 G0 X0")
    mdi("M3 S500")
    c.mdi("G1 F6000 X100")
    sleep(0.2)
    messages()


def fail(pin, value):
    """The joint coasts from then on. The time."""
    hal.set_p(COAST, "0.05")
    hal.set_p(pin, value)
    need(lambda s: s.task_state != STATE_ON, "stop")
    hal.set_p(COAST, "0.05")        # also after the following error
    for p, _ in FAULTS.values():
        if p != COAST:
            hal.set_p(p, "0")
    return clock.now()


def off_when():
    return "on" if hal.get_value("spindle.0.on") else "off"


def faults():
    for name, (pin, bad) in FAULTS.items():
        on_and_turning()
        fail(pin, bad)
        sleep(0.02)
        coasting = off_when()
        sleep(0.3)
        later = off_when()
        hal.set_p(COAST, "0")
        sleep(0.05)
        print(f"{name}: spindle {coasting}, {later} while the joint coasts, {off_when()} when it stands;", *messages())
    on_and_turning()
    fail(*FAULTS["following error"])
    sleep(2.1)
    print("a joint that never stands:", off_when())
    hal.set_p(COAST, "0")


def stops_end_the_wait():
    """Emergency stop and turning on while the spindle still turns: off at once."""
    for what, state in (("emergency stop", STATE_ESTOP), ("on", STATE_ON)):
        on_and_turning()
        fail(*FAULTS["amplifier"])
        sleep(0.05)
        was = off_when()
        c.state(state)
        c.wait_complete()
        sleep(0.005)
        print(f"{what}: spindle {was}, then {off_when()};", *messages())
        hal.set_p(COAST, "0")
        sleep(0.1)


def switch():
    """On with a joint on its switch; jog away, and turn on again."""
    if poll().task_state != STATE_ON:
        on(home=False)
    c.mode(MODE_MANUAL)
    c.wait_complete()
    c.teleop_enable(0)
    c.wait_complete()
    hal.set_p("joint.0.neg-lim-sw-in", "1")
    need(lambda s: s.task_state != STATE_ON, "stop")
    sleep(0.1)
    messages()
    if not ini.find("TASK", "LIMIT_SWITCH_RETRACT") == "AUTO":
        c.override_limits()
        print("override:", c.wait_complete(), *messages())
    c.state(STATE_ON)
    until(lambda s: s.task_state == STATE_ON, 0.2)
    sleep(0.1)
    print("on:", poll().task_state == STATE_ON, *messages())
    at = s.joint_position[0]
    c.jog(JOG_INCREMENT, True, 0, 10, 2)
    sleep(1)
    hal.set_p("joint.0.neg-lim-sw-in", "0")
    print("moved:", round(poll().joint_position[0] - at, 3), *messages())


ini = linuxcnc.ini("mill.ini")
faults()
if ini.find("TASK", "AMP_FAULT_SPINDLE"):
    stops_end_the_wait()
switch()
