# Jogs of joints and axes, wheels, external offsets, overrides, holds, inhibits, probe contacts,
# homing, aborts and switching off, at random: no joint exceeds speed, acceleration or jerk by more
# than 0.1 %, or a soft limit; every stop is reached; no position is lost.
from fuzz import JOG_WEIGHTS, Jogs, check

check(["xyz", "gantry", "delta", "five"], range(25), Jogs, JOG_WEIGHTS)
