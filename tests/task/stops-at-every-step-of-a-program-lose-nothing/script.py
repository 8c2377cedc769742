# SPDX-License-Identifier: GPL-2.0-or-later
# A program that probes, changes tools and turns spindles is stopped in every 16th of its time by each
# kind of stop. No output rises
# without an order, homing, offsets and tool table stay, and the operator is told of every stop.
import hal
from mill import *

PINS = ("spindle.0.on", "iocontrol.0.coolant-flood", "iocontrol.0.coolant-mist", "iocontrol.0.tool-change",
        "iocontrol.0.tool-prepare", "motion.digital-out-00")


def pins():
    return tuple(bool(hal.get_value(p)) for p in PINS)


def chain():
    halcmd("unlinkp", "iocontrol.0.emc-enable-in")
    hal.set_p("iocontrol.0.emc-enable-in", "0")


STOPS = {"abort": c.abort, "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP), "chain": chain,
         "limit": lambda: hal.set_p("joint.0.neg-lim-sw-in", "1"),
         "fault": lambda: hal.set_p("joint.1.amp-fault-in", "1")}
on()
mdi("G10 L2 P1 X0.5 Y0.25")
busy_program()
c.auto(AUTO_RUN, 0)
total = 0.0
while poll().interp_state != INTERP_IDLE:
    sleep(0.02)
    total += 0.02
print("it runs", messages(), s.tool_in_spindle)
total = round(total, 1)
original = [l for l in open("mill.tbl")]
wrong, told = [], set()
steps = 16
for name, stop in STOPS.items():
    for n in range(steps):
        busy_program()
        messages()
        tool = s.tool_in_spindle
        c.auto(AUTO_RUN, 0)
        sleep(total * n / steps + 0.003)
        stop()
        c.wait_complete()
        sleep(0.05)
        first = pins()
        if any(first[:5]):
            wrong.append((name, n, "on", first))
        sleep(0.7)
        if later := [p for p, a, b in zip(PINS, first, pins()) if b and not a]:
            wrong.append((name, n, "rose", later))
        poll()
        if not all(s.homed[:3]) or s.g5x_offset[:2] != (0.5, 0.25) or s.interp_state != INTERP_IDLE:
            wrong.append((name, n, s.homed[:3], s.g5x_offset[:2], s.interp_state))
        if name in ("limit", "fault"):
            told.update(m for m in messages())
        if name == "chain":
            hal.set_p("iocontrol.0.emc-enable-in", "1")
        hal.set_p("joint.0.neg-lim-sw-in", "0")
        hal.set_p("joint.1.amp-fault-in", "0")
        if poll().task_state != STATE_ON:
            on(home=False)
        if any(pins()[:5]):
            wrong.append((name, n, "on after the machine was turned on", pins()))
print(len(STOPS) * steps, "stops", wrong)
print(sorted(told))
print([l for l in open("mill.tbl")] == original)
