# The same with queued lines in coordinated mode: pause, step, resume, abort, reverse, overrides and
# external offsets at random times (FP-035: a stop while an offset is under way).
from fuzz import WEIGHTS, Sequence, check

check(["xyz", "gantry", "delta", "five"], range(25), Sequence, WEIGHTS)
