# Random sequences on machines with backlash and screw tables: motor commands, compensation
# included, stay within the limits of velocity, acceleration and jerk.
import kerf_motion as km
from fuzz import WEIGHTS, Sequence, check


def compensate(m):
    for j in range(m.joints):
        if j == 0:
            for n in range(-10, 11):
                m.send(km.SET_JOINT_COMP, joint=0, comp_nominal=10.0 * n, comp_forward=0.03 * (n % 3),
                       comp_reverse=-0.05 * (n % 2))
        else:
            m.send(km.SET_JOINT_BACKLASH, joint=j, backlash=(0.02, 0.5, 5.0)[j % 3])


check(["xyz", "gantry"], range(10), Sequence, WEIGHTS, ratios=(0.0, 0.3), prepare=compensate)
check(["delta", "five"], range(10), Sequence, WEIGHTS, prepare=compensate)
