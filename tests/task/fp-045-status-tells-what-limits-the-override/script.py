# FP-045: status has the override that was asked for, the one the move under way has, and why they differ.
from mill import *

CAUSES = {getattr(linuxcnc, n): n[9:].lower() for n in dir(linuxcnc) if n.startswith("OVERRIDE_")}
on()
print("at rest", round(poll().override_effective, 3), CAUSES[s.override_cause])


def show(what):
    sleep(0.3)
    poll()
    asked = s.rapidrate if s.motion_type == MOTION_TYPE_TRAVERSE else s.feedrate
    print(f"{what}: asked {asked:g}, is {s.override_effective:.3f}, {CAUSES[s.override_cause]}; speed "
          f"{s.current_vel * 60:.0f}")


def put(call, *values):
    call(*values)


mdi("G21 G90 G64 G0 X0 Y0 Z0")
c.mdi("G1 X200 F2000")
for rate in (1.0, 0.5, 1.3):
    put(c.feedrate, rate)
    show("feed")
setp("motion.feed-inhibit", 1)
show("inhibit")
setp("motion.feed-inhibit", 0)
setp("motion.feed-hold", 1)
show("hold")
setp("motion.feed-hold", 0)
put(c.maxvel, 20)
show("slider")
put(c.maxvel, 1000)
idle()
put(c.feedrate, 1.5)
c.mdi("G1 X0 F5000")
show("beyond the axis")
idle()
put(c.rapidrate, 0.25)
c.mdi("G0 X200")
show("rapid")
put(c.rapidrate, 1)
idle()
program("M50 P0\nG1 X0 F2000\nM50 P1\nM52 P1\nG1 X100\nM2\n")
setp("motion.adaptive-feed", 0.5)
c.auto(AUTO_RUN, 0)
show("M50 P0")
put(c.auto, AUTO_PAUSE)
show("pause")
put(c.auto, AUTO_RESUME)
until(lambda s: s.motion_line == 5)
show("adaptive")
c.abort()
