# SPDX-License-Identifier: GPL-2.0-or-later
# Running back along the path and on again; M19 with its waits, faults and time-outs; block delete and
# optional stop, as the machine starts and as switched.
from mill import *

on()
# ---- AUTO_REVERSE, AUTO_FORWARD
program("G21 G90 G61 F600\n" + "".join(f"G1 X{n}\n" for n in range(1, 21)) + "M2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[0] > 8, "move")
c.auto(AUTO_PAUSE)
need(lambda s: s.current_vel == 0 and s.paused, "pause")
at, line = s.position[0], s.motion_line
c.auto(AUTO_REVERSE)
c.wait_complete(0.1)
sleep(0.3)
print("paused, told to reverse: moves", poll().position[0] != at)
c.auto(AUTO_RESUME)
need(lambda s: s.position[0] < 5, "move backwards")
print("back: line fell", poll().motion_line < line, "interpreter", s.interp_state, "codes", s.gcodes[1])
c.auto(AUTO_PAUSE)
need(lambda s: s.current_vel == 0, "pause")
c.auto(AUTO_FORWARD)
c.auto(AUTO_RESUME)
print("forward again:", c.wait_complete(60), xyz(), messages())
# while it moves reverse is ignored, as documented; as far back as there is path: it stays there and can go on


def turn_back():
    c.auto(AUTO_PAUSE)
    need(lambda s: s.current_vel == 0, "pause")
    c.auto(AUTO_REVERSE)
    c.auto(AUTO_RESUME)


program("G21 G90 G61 F600\nG0 X0\n" + "".join(f"G1 X{n}\n" for n in range(1, 6)) + "M2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: 2 < s.position[0] < 5 and s.motion_line > 3, "move")
c.auto(AUTO_REVERSE)
at = s.position[0]
sleep(0.02)
print("told in motion: goes on", poll().position[0] > at)
turn_back()
sleep(8)
at = poll().position[0]
sleep(0.1)
print("at the beginning:", poll().position[0] == at, round(at, 3), "interpreter", s.interp_state, messages())
c.auto(AUTO_FORWARD)
print("and on:", c.wait_complete(60), xyz(), messages())
# abort while it runs back: the next program runs forward
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[0] > 2 and s.motion_line > 3, "move")
turn_back()
sleep(0.1)
print("runs back:", poll().current_vel > 0, getp("motion.tp-reverse"))
c.abort()
c.wait_complete()
idle()
print("aborted backwards, then:", run("G0 X1\nG1 F600 X3\nM2\n"), xyz(), messages())

# ---- M19
halcmd("net", "orient", "spindle.0.orient-angle")
print("orient:", getp("spindle.0.orient"))
mode(MODE_MDI)
c.mdi("M19 R90 Q2")
need(lambda s: getp("spindle.0.orient") == "TRUE", "orient request")
print("asked for", getp("spindle.0.orient-angle"), "mode", getp("spindle.0.orient-mode"), "state",
      poll().exec_state == EXEC_WAITING_FOR_SPINDLE_ORIENTED, s.spindle[0]["orient_state"])
setp("spindle.0.is-oriented", 1)
print("reached:", c.wait_complete(5), messages(), getp("spindle.0.orient"), poll().spindle[0]["orient_state"])
setp("spindle.0.is-oriented", 0)
print("time-out:", mdi("M19 R10 Q0.5"), messages(), poll().interp_state)
c.mdi("M19 R10 P2 Q5")
need(lambda s: getp("spindle.0.orient") == "TRUE", "orient request")
print("mode", getp("spindle.0.orient-mode"))
setp("spindle.0.orient-fault", 7)
print("fault:", c.wait_complete(5), messages(), poll().spindle[0]["orient_fault"])
setp("spindle.0.orient-fault", 0)
program("M19 R45 Q60\nG0 X9\nM2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: s.exec_state == EXEC_WAITING_FOR_SPINDLE_ORIENTED, "wait")
c.abort()
c.wait_complete()
sleep(0.5)
print("aborted:", poll().exec_state, "orient", getp("spindle.0.orient"), xyz()[0], messages())
print("M19 without Q does not wait:", run("M19 R45\nG0 X4\nM2\n"), xyz()[0], getp("spindle.0.orient"), messages())
print("M3 ends it:", mdi("M3 S100"), getp("spindle.0.orient"), getp("spindle.0.on"), mdi("M5"))

# ---- block delete, optional stop
TEXT = "G0 X1\n/G0 X2\n/ G0 Y2\nM1\nG0 Z-1\nM2\n"
print("at start:", poll().block_delete, s.optional_stop)
for delete in (0, 1):
    for stop in (0, 1):
        mdi("G0 X0 Y0 Z0")
        c.set_block_delete(delete)
        c.set_optional_stop(stop)
        c.wait_complete()
        print(delete, stop, (poll().block_delete, s.optional_stop), end=" ")
        program(TEXT)
        c.auto(AUTO_RUN, 0)
        until(lambda s: s.interp_state in (INTERP_IDLE, INTERP_PAUSED) and s.inpos, 10)
        sleep(0.1)
        print("paused" if poll().interp_state == INTERP_PAUSED else "ended", xyz(1), end=" ")
        if s.interp_state == INTERP_PAUSED:
            c.auto(AUTO_RESUME)
        c.wait_complete(10)
        print(xyz(1), messages())
