# FP-022: G33.1 with words for a place aside goes there first and taps along the normal of the plane, then goes back.
import math

from mill import *

on()
for start, code, normal in (("G17", "G33.1 X10 Y5 Z-5 K1", (0, 0, 1)),
                            ("G17 G10 L2 P1 R30", "G33.1 X10 Z-5 K1", (0, 0, 1)),
                            ("G18", "G33.1 X4 Y5 K1", (-0.5, math.sqrt(0.75), 0)),
                            ("G17 G10 L2 P1 R0", "G33.1 Z-5 K1", (0, 0, 1))):
    program(f"{start}\nG21 G0 X0 Y0 Z0\nM3 S600\n{code}\nG1 Z1 F6000\nM2\n")
    c.auto(AUTO_RUN, 0)
    sleep(0.05)
    poll()
    deepest, aside, places = 0.0, 0.0, []
    while s.interp_state != INTERP_IDLE or s.queue:
        poll()
        p = s.joint_position[:3]
        if p[2] < 0.5:
            depth = sum(a * b for a, b in zip(p, normal))
            if abs(depth) > 0.5:
                places.append([a - depth * b for a, b in zip(p, normal)])
                deepest = max(deepest, abs(depth))
        sleep(0.002)
    spread = max((math.dist(q, places[0]) for q in places), default=0.0)
    print(f"{start} {code}: depth {deepest:.0f} at {[round(x, 2) + 0.0 for x in places[0]]}, off the "
          f"line by {spread:.4f};",
          f"then at {[round(x, 4) + 0.0 for x in s.joint_actual_position[:3]]}", messages())
