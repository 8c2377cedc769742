# FP-074: a height map moves what is programmed in work coordinates; a move to machine coordinates (G53, G28, G30) ends
# where it says and stays there, until the next move in work coordinates. Offsets of others act on all moves, as ever.
from mill import *

on()
mdi("G21 G90 G64 G10 L2 P1 Z-50")
mdi("G0 X0 Y0 Z10")


def shown(line):
    mdi(line)
    poll()
    there = round(s.joint_position[2], 4) + 0.0
    sleep(3)
    poll()
    return f"{line}: machine Z {there}, 3 s later {round(s.joint_position[2], 4) + 0.0}"


setp("z_level_compensation.enable-in", 1)
sleep(1)
poll()
print("corrected at rest:", round(s.joint_position[2], 4))
for line in ("G0 Z-2", "G53 G0 Z-4", "G53 G0 X5", "M5", "G0 Z-2", "G0 X5", "G28", "G0 X0 Y0 Z-2", "G30 Z10",
             "G1 F900 Z-2"):
    print(shown(line))
setp("axis.z.eoffset-work-only", 0)
print("a setting of every offset:", shown("G53 G0 Z-4"))
setp("axis.z.eoffset-work-only", 1)
program("G0 Z-2\nG53 G0 Z-4\nG0 Z-2\nM2\n")
c.auto(AUTO_RUN, 0)
seen = []
sleep(0.05)
poll()
while s.interp_state != INTERP_IDLE or s.queue:
    poll()
    seen.append(s.joint_position[2])
    sleep(0.001)
sleep(1)
poll()
print(f"in a program: {min(abs(z + 4) for z in seen):.4f} from Z-4 at the least, ends at {s.joint_position[2]:.4f}",
      messages())
# Power off and on: there is no offset then, and none asked for, until the counts change.
setp("z_level_compensation.enable-in", 0)
sleep(2)
halcmd("unlinkp", "axis.z.eoffset-counts")
for step in ("counts", "off and on", "counts again"):
    if "on" in step and "off" in step:
        c.state(STATE_OFF)
        c.wait_complete()
        on(home=False)
    else:
        setp("axis.z.eoffset-counts", int(getp("axis.z.eoffset-counts")) + 1000)
    sleep(2)
    ask, have = (float(getp(f"axis.z.{pin}")) for pin in ("eoffset-request", "eoffset"))
    print(f"{step}: asked for", "nothing" if ask == 0 else "something", ask == have or (ask, have))
