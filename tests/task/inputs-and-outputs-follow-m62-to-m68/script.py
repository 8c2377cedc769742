# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *


def show(what):
    poll()
    print(f"{what:8} interp {s.interp_state} exec {s.exec_state} input_timeout {s.input_timeout}", messages())


on()
mode(MODE_MDI)
for line, before, after in (("M66 P0 L3 Q1", 0, 1), ("M66 P0 L4 Q1", 1, 0), ("M66 P0 L1 Q1", 0, 1),
                            ("M66 P0 L2 Q1", 1, 0)):
    setp("motion.digital-in-00", before)
    sleep(0.01)
    c.mdi(line)
    sleep(0.5)
    show("waits")
    setp("motion.digital-in-00", after)
    sleep(0.05)
    show("came")
    print(line, mdi("(debug,#5399)"), messages())
c.mdi("M66 P0 L3 Q1")
sleep(0.5)
show("waits")
sleep(1)
show("too late")
print(mdi("(debug,#5399)"), messages(), poll().input_timeout)
print(mdi("M66 P0 L0"), mdi("(debug,#5399)"), messages(), poll().input_timeout)
setp("motion.analog-in-00", 2.5)
print(mdi("M66 E0 L0"), mdi("(debug,#5399)"), messages())
for line in ("M66 P0 E0 L0", "M66 P0 L3 Q0", "M66 E0 L3 Q1", "M66 L0", "M66 P77 L0"):
    print(line, mdi(line), messages())
print(mdi("M64 P1"), getp("motion.digital-out-01"), poll().dout[:3])
print(mdi("M65 P1"), getp("motion.digital-out-01"))
print(mdi("M68 E1 Q1.5"), getp("motion.analog-out-01"), poll().aout[:3])
print(mdi("M62 P0"), getp("motion.digital-out-00"), mdi("G0 X1"), getp("motion.digital-out-00"))
c.set_digital_output(2, 1)
c.set_analog_output(2, -3.25)
sleep(0.01)
print(getp("motion.digital-out-02"), getp("motion.analog-out-02"))
# numbers that no output has: none of the others changes
for line in ("M64 P4", "M65 P258", "M68 E258 Q9", "M62 P257", "M67 E257 Q9", "G0 X2"):
    print(line, mdi(line), [t.split(" (")[0] for t in messages()])
print([getp(f"motion.digital-out-0{i}") for i in range(4)], [getp(f"motion.analog-out-0{i}") for i in range(4)])
