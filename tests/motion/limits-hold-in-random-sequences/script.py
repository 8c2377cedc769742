# The same with queued lines in coordinated mode: pause, step, resume, abort, reverse, overrides and
# external offsets at random times. On machines with other kinematics external offsets are left out
# here: path and offset share the limits of an axis, not those of a joint.
from fuzz import WEIGHTS, Sequence, check

check(["xyz", "gantry"], range(25), Sequence, WEIGHTS)
check(["delta", "five"], range(25), Sequence, WEIGHTS, ratios=(0.0,))
