# SPDX-License-Identifier: GPL-2.0-or-later
# FP-002, FP-003, FP-004, FP-010, FP-079, FP-015: nothing but an order starts a spindle.
from mill import *


def show(what):
    sleep(0.3)
    poll()
    print(f"{what:44} speed {s.spindle[0]['speed']:g} flood {s.flood} mist {s.mist}", messages())


on()
# FP-002: an abort near the start, while the S word of a later line is read already.
for wait in (0.0, 0.001, 0.01, 0.05, 0.2):
    program("M3 S1000\nG1 X1 F60\nS1500\nG1 X2\nM4 S800\nG1 X3\nM2\n")
    c.auto(AUTO_RUN, 0)
    sleep(wait)
    c.abort()
    show(f"aborted after {wait} s")
mdi("S900")
show("an S word after that")
# FP-003: paused, stopped by hand, aborted.
program("M3 S1000\nM8\nG1 X10 F60\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(1)
c.auto(AUTO_PAUSE)
sleep(0.2)
c.spindle(SPINDLE_OFF)
c.flood(FLOOD_OFF)
show("paused, stopped by hand")
c.abort()
show("aborted")
c.auto(AUTO_RUN, 0)
sleep(1)
c.auto(AUTO_PAUSE)
sleep(0.2)
c.spindle(SPINDLE_OFF)
c.auto(AUTO_RESUME)
show("stopped by hand, resumed")
c.abort()
# FP-004: started by MDI, stopped by hand; then routines save and restore the state, one of them fails.
open("probe.ngc", "w").write("o<probe> sub\nM70\nG91\no1 if [#1 EQ 3]\nG38.3 Z-1 F300\no1 else\nG38.2 Z-1 F300\n"
                             "o1 endif\nG90\nM72\no<probe> endsub\nM2\n")
open("saved.ngc", "w").write("o<saved> sub\nM73\nG91 G38.2 Z-1 F300\nG90\no<saved> endsub\nM2\n")
for call in ("o<probe> call [3]", "o<probe> call [2]", "o<saved> call"):
    mdi("M3 S700")
    mdi("M8")
    c.spindle(SPINDLE_OFF)
    c.wait_complete()
    c.flood(FLOOD_OFF)
    c.wait_complete()
    mdi(call)
    show(call)
    mdi("G90 S800")
    show("an S word after that")
mdi("M5 M9")
# S0 is a speed of 0, also for the next start and for a spindle that turns.
for lines in (("S800", "M3", "M5", "M3 S0"), ("S300",), ("S0",), ("S0 M4",), ("M5 S600", "S0", "G96 D500 S50 M3", "S0"),
              ("G97 M5",)):
    for line in lines:
        mdi(line)
    show("; ".join(lines))
# FP-079: until a change is confirmed no spindle starts, the first time and later.
halcmd("unlinkp", "iocontrol.0.tool-changed")
for number in (1, 2):
    setp("iocontrol.0.tool-changed", 0)
    mdi("M3 S600")
    mode(MODE_MDI)
    c.mdi(f"T{number} M6")
    need(lambda s: getp("iocontrol.0.tool-change") == "TRUE", "tool change")
    show(f"change to T{number}")
    c.spindle(SPINDLE_FORWARD, 500)
    c.wait_complete(0.5)
    show("start by hand")
    c.mdi("M3 S500")
    show("start by MDI waits")
    setp("iocontrol.0.tool-changed", 1)
    need(lambda s: s.interp_state == INTERP_IDLE, "end")
    setp("iocontrol.0.tool-changed", 0)
    show(f"confirmed, T{poll().tool_in_spindle}")
    mdi("M5")
# A start by hand during the change of a program, and an abort of the change.
program("M3 S400\nT3 M6\nG1 X1\nM2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: getp("iocontrol.0.tool-change") == "TRUE", "tool change")
c.spindle(SPINDLE_FORWARD, 500)
c.wait_complete(0.5)
show("program: start by hand")
c.abort()
show(f"aborted, T{poll().tool_in_spindle}")
# A start by hand as soon as the machine rests after an abort counts: nothing restored takes it back.
started = 0
for step in range(8):
    program("S400\nG1 X1 F60\nG1 X0\nM2\n")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.current_vel > 0.5, "motion")
    c.abort()
    need(lambda s: s.interp_state == INTERP_IDLE and s.inpos, "rest")
    sleep(0.0005 * step)
    c.spindle(SPINDLE_FORWARD, 500)
    sleep(0.3)
    started += poll().spindle[0]["speed"] == 500
    c.spindle(SPINDLE_OFF)
    c.wait_complete()
print("starts after an abort:", started, "of 8", messages())
# FP-010: path modes survive.
for code in ("G61", "G61.1", "G64 P0.1 Q0.02"):
    mdi(code)
    for stop in (STATE_ESTOP, STATE_OFF):
        before = tuple(poll().gcodes[11:13]), s.settings[3:5]
        c.state(stop)
        c.wait_complete()
        on(home=False)
        print(code, (tuple(poll().gcodes[11:13]), s.settings[3:5]) == before, s.settings[3:5])
# FP-015: a hold is latched in a tool change and in an M66 wait too.
setp("iocontrol.0.tool-changed", 0)
program("T1 M6\nG0 X5\nM66 P0 L3 Q10\nG0 X9\nM2\n")
mdi("G0 X0")
mode(MODE_AUTO)
c.auto(AUTO_RUN, 0)
need(lambda s: getp("iocontrol.0.tool-change") == "TRUE", "tool change")
c.auto(AUTO_PAUSE)
setp("iocontrol.0.tool-changed", 1)
sleep(2)
print("held after the change", poll().interp_state == INTERP_PAUSED, xyz(1), s.tool_in_spindle)
c.auto(AUTO_RESUME)
sleep(1)
print("resumed", xyz(1))
c.auto(AUTO_PAUSE)
setp("motion.digital-in-00", 1)
sleep(1)
print("held after the input", xyz(1))
c.auto(AUTO_RESUME)
idle()
print("end", xyz(1), messages())
