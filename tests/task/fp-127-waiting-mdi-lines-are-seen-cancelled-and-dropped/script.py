# SPDX-License-Identifier: GPL-2.0-or-later
# FP-127. The waiting lines are seen and taken out singly; whatever stops the machine drops them all.
from mill import *


def waiting():
    return [line for _, line in poll().mdi_queue], s.queued_mdi_commands


def give(*lines):
    serials = {}
    for line in lines:
        c.mdi(line)
        serials[line] = c.serial
    return serials


def fill():
    mode(MODE_MDI)
    return give("G0 X1", "G4 P1", "M66 P0 L3 Q2", "G0 X20", "G0 Y20", "G0 Z-2")


def cancel(serial):
    c.mdi_cancel(serial)
    return c.wait_complete(0.1), messages()


on()
serials = fill()
print("waiting", waiting(),
      [serial for serial, _ in s.mdi_queue] == [serials[line] for line in ("M66 P0 L3 Q2", "G0 X20", "G0 Y20", "G0 Z-2")])
print("cancel", cancel(serials["G0 Y20"]), waiting())
print("again", cancel(serials["G0 Y20"]), waiting())
print("running", cancel(serials["G4 P1"]), waiting())
need(lambda s: s.interp_state == INTERP_IDLE, "end")
print(xyz(1), waiting())
fill()
print("all", cancel(0), waiting(), c.wait_complete(20), xyz(1))
give("M66 P0 L3 Q2", *(f"G0 X{i}" for i in range(18)))
print("18 wait,", len(poll().mdi_queue), "shown", s.queued_mdi_commands, c.wait_complete(20), xyz(1))
for name, stop in (("abort", c.abort), ("MDI", lambda: c.mode(MODE_MDI)), ("auto", lambda: c.mode(MODE_AUTO)),
                   ("manual", lambda: c.mode(MODE_MANUAL)), ("off", lambda: c.state(STATE_OFF)),
                   ("estop", lambda: c.state(STATE_ESTOP)), ("chain", lambda: setp("iocontrol.0.emc-enable-in", 0)),
                   ("enable", lambda: setp("motion.enable", 0)), ("mistake", lambda: None)):
    mdi("G0 X0 Y0 Z0")
    fill()
    if name == "mistake":
        give("G1 X3 F", "G0 Y8")
    before = waiting()[1]
    stop()
    sleep(5 if name == "mistake" else 0.2)
    mess, left = messages(), waiting()
    setp("iocontrol.0.emc-enable-in", 1)
    setp("motion.enable", 1)
    if poll().task_state != STATE_ON:
        on(home=False)
    mode(MODE_MDI)
    sleep(4)
    print(f"{name:8}", before, left, waiting(), xyz(1), s.interp_state, mess)
