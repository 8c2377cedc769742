# FP-025: a spindle with constant surface speed that is stopped and started by hand in a pause keeps mode and value;
# after an abort the spindle mode is G97, shown and in effect, and a program starts with the S word it has.
import os

import hal
from mill import *

h = hal.component(f"turns{os.getpid()}")
h.ready()


def speed():
    return round(hal.get_value("spindle.0.speed-out"))


def mode():
    poll()
    return "G96" if 960 in s.gcodes else "G97"


on()
LATHE = "g21 g90 g18\ng0 x20 z0\ng96 d3000 s170\nm3\ng1 x19 f30\ng1 x10 f30\nm2\n"
program(LATHE)
c.auto(AUTO_RUN, 0)
need(lambda s: 19 < s.joint_position[0] < 19.9 and speed() > 0, "cut")
c.auto(AUTO_PAUSE)
need(lambda s: s.paused and s.current_vel == 0, "pause")
sleep(0.1)
before = speed()
print("surface speed kept while cutting", 1350 < before < 1430)
for words in ((SPINDLE_FORWARD,), (SPINDLE_FORWARD, 170), (SPINDLE_REVERSE, 500)):
    c.spindle(SPINDLE_OFF)
    need(lambda s: speed() == 0, "stop by hand")
    c.spindle(*words)
    need(lambda s: speed() != 0, f"start by hand with {words}")
    sleep(0.1)
    print("by hand", words, "as before", speed() == (-before if words[0] == SPINDLE_REVERSE else before))
c.spindle(SPINDLE_OFF)
need(lambda s: speed() == 0, "stop by hand")
c.spindle(SPINDLE_FORWARD, 100)
c.auto(AUTO_RESUME)
need(lambda s: 18 < s.joint_position[0] < 18.6, "cut goes on")
print("faster at a smaller radius", before < speed() < before * 1.15)
c.abort()
sleep(0.5)
print("after an abort", mode(), speed(), messages())
program("g21 g90\nm3 s400\ng1 x18 f300\nm2\n")
c.auto(AUTO_RUN, 0)
until(lambda s: speed() != 0 and s.current_vel > 0, 5)
print("the next program", mode(), speed(), messages())
c.abort()
sleep(0.3)
program(LATHE)
for run in (1, 2):
    c.auto(AUTO_RUN, 0)
    need(lambda s: 19 < s.joint_position[0] < 19.95 and speed() > 1000, "cut")
    c.abort()
    sleep(0.5)
    print("run", run, mode(), speed(), messages())
