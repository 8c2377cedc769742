# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *


def show(what):
    poll()
    print(f"{what:8} interp {s.interp_state} exec {s.exec_state} command {s.command!r} queued "
          f"{s.queued_mdi_commands} rcs {s.state}", xyz(1), messages())


on()
mode(MODE_MDI)
for line in ("G0 X10", "G4 P1", "M66 P0 L3 Q2", "G0 X20", "G0 X0"):
    c.mdi(line)
for _ in range(4):
    sleep(0.7)
    show("queue")
print(c.wait_complete(20))
show("end")
# An abort drops them all.
for line in ("G4 P1", "M66 P0 L3 Q5", "G0 X20", "G0 X0"):
    c.mdi(line)
sleep(0.1)
show("queued")
c.abort()
sleep(0.1)
show("aborted")
sleep(2)
show("later")
print(mdi("G0 X3"), xyz(1))
# Mistakes: status ERROR until the next command.
print(mdi("G1 X5"), messages(), poll().state)
print(mdi("G999"), messages())
print(mdi(""), messages())
print(mdi("M2"), messages())
# A line is read when those before it have been given to the machine: what they order is done before its mistake.
mode(MODE_MDI)
for line in ("G0 X0", "G1 X1 F60", "M3 S100", "G1 X2", "M5", "G1 X[1/0]", "G0 X9"):
    c.mdi(line)
sleep(0.3)
show("orders")
print(c.wait_complete(20), s.spindle[0]["speed"] if poll() else 0, s.position[0] > 1, messages())
# Not homed, not in MDI mode.
mode(MODE_MANUAL)
c.mdi("G0 X1")
print(c.wait_complete(), messages())
c.teleop_enable(0)
c.unhome(1)
c.wait_complete()
c.mdi("G0 X1")
print(c.wait_complete(), messages())
mode(MODE_MDI)
c.mdi("G0 X1")
print(c.wait_complete(), messages())
mode(MODE_AUTO)
c.auto(AUTO_RUN, 0)
print(c.wait_complete(), messages())
# Called subroutines that wait continue by themselves.
mode(MODE_MANUAL)
c.home(1)
need(lambda s: all(s.homed[:3]), "homing")
print(mdi("o<waits> call"), xyz(1), messages())
print(mdi("o<nothere> call"), messages())
