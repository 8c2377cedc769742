# The tolerance of the startup code is in force though the machine is switched on at once.
from mill import *

on()
program("G53 G0 X0 Y0 Z-20\nG53 G0 Y-50\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(0.02)
worst = 0.0
while poll().interp_state != INTERP_IDLE or s.queue:
    worst = max(worst, min(abs(s.joint_position[2] + 20), abs(s.joint_position[1])))
    sleep(0.002)
print("corner within 0.01 mm:", worst <= 0.01)
