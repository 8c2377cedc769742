# SPDX-License-Identifier: GPL-2.0-or-later
# A paused program keeps its place: jogs, MDI, homing, modes, wheels are refused at 50 moments, so that resume starts
# exactly where it stopped, with spindle and offsets as they were, and the part is the same.
import random

import hal
from mill import *

R = random.Random(7)
on()
TEXT = "G21 G90 G64 P0.01 F1200\nM3 S800\n" + "".join(f"G1 X{10 * (n % 2)} Y{n / 2} Z{-(n % 3)}\n"
                                                      for n in range(1, 30)) + "M2\n"
hal.set_p("axis.z.jog-enable", "1")
hal.set_p("axis.z.jog-scale", "1")
hal.set_p("joint.0.jog-enable", "1")
hal.set_p("joint.0.jog-scale", "1")
program(TEXT)
c.auto(AUTO_RUN, 0)
wrong, counts = [], 0
for n in range(50):
    sleep(R.uniform(0.01, 0.3))
    c.auto(AUTO_PAUSE)
    need(lambda s: s.current_vel == 0 and s.interp_state == INTERP_PAUSED, "pause")
    before = (s.position, s.spindle[0]["speed"], s.motion_line, s.g5x_offset)
    for axis in range(3):
        for joint in (0, 1):
            c.jog(JOG_CONTINUOUS, joint, axis, R.choice((-20, 20)))
            c.jog(JOG_INCREMENT, joint, axis, 20, 1)
    counts += R.choice((-5, 5))
    hal.set_p("axis.z.jog-counts", str(counts))
    hal.set_p("joint.0.jog-counts", str(counts))
    c.mode(R.choice((MODE_MANUAL, MODE_MDI)))
    c.mdi("G0 X50")
    c.teleop_enable(0)
    c.home(0)
    sleep(0.2)
    poll()
    after = (s.position, s.spindle[0]["speed"], s.motion_line, s.g5x_offset)
    if before != after or s.interp_state != INTERP_PAUSED or s.task_mode != MODE_AUTO:
        wrong.append((n, before, after))
    if not all("auto mode" in m or "AUTO" in m or "MDI" in m for m in messages()):
        wrong.append((n, "messages"))
    c.auto(AUTO_RESUME)
print("pauses", n + 1, "wrong", wrong[:2])
print("end:", c.wait_complete(100), xyz(), messages())
