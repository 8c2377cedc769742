# SPDX-License-Identifier: GPL-2.0-or-later
"""The Python modules of the two deltas: defaults, geometry, both directions, None out of reach."""
import lineardeltakins
import random
import rotarydeltakins

rng = random.Random(1)


def round_trips(module, box, count=2000):
    worst = 0
    for _ in range(count):
        p = [rng.uniform(*b) for b in box]
        q = module.inverse(*p)
        worst = max(worst, max(abs(a - b) for a, b in zip(module.forward(*q), p)))
    return worst < 1e-9


print("linear", lineardeltakins.get_geometry(), [round(x, 6) for x in lineardeltakins.inverse(10, 20, 30)])
print("round trips", round_trips(lineardeltakins, [(-90, 90), (-90, 90), (-100, 100)]))
print("out of reach", lineardeltakins.inverse(500, 0, 0), lineardeltakins.forward(0, 0, 1e6))
lineardeltakins.set_geometry(100, 200)
print("changed", lineardeltakins.get_geometry(), [round(x, 6) for x in lineardeltakins.inverse(10, 20, 30)],
      round_trips(lineardeltakins, [(-60, 60), (-60, 60), (-100, 100)]))
print("rotary", rotarydeltakins.get_geometry(), [round(x, 6) for x in rotarydeltakins.inverse(1, 2, -12)])
print("round trips", round_trips(rotarydeltakins, [(-4, 4), (-4, 4), (-18, -9)]))
print("out of reach", rotarydeltakins.inverse(0, 0, -50), rotarydeltakins.inverse(0, 0, 0))
rotarydeltakins.set_geometry(100, 100, 200, 40)
print("changed", rotarydeltakins.get_geometry(), round_trips(rotarydeltakins, [(-50, 50), (-50, 50), (-260, -150)]))
