# SPDX-License-Identifier: GPL-2.0-or-later
"""Property: the same part written in mm and in inches is the same path (2000 random lines)."""
import random
from harness import *


def program(seed: int, inch: bool) -> str:
    r = random.Random(seed)
    k = 1 / 25.4 if inch else 1
    out = ["G20" if inch else "G21", "G90 G17 F%.9f" % (500 * k), "G0 X0 Y0 Z%.9f" % (5 * k)]
    for _ in range(60):
        x, y, z = (r.uniform(-50, 50) for _ in range(3))
        i = r.uniform(5, 20)
        out.append(r.choice([
            "G0 X%.9f Y%.9f" % (x * k, y * k), "G1 X%.9f Z%.9f" % (x * k, z * k),
            "G1 X0 Y0\nG2 X%.9f Y%.9f I%.9f J0 Z%.9f" % (i * k, i * k, i * k, z * k),
            "G1 X0 Y0\nG3 X%.9f Y0 R%.9f" % (i * k, i * k), "G92 X%.9f" % (x * k), "G92.1",
            "G10 L2 P2 X%.9f Y%.9f R%.3f" % (x * k, y * k, r.uniform(0, 90)), "G55", "G54",
            "G43.1 Z%.9f" % (z * k), "G49",
            "G0 Z%.9f\nG81 X%.9f Y%.9f Z%.9f R%.9f\nG80" % (30 * k, x * k, y * k, -abs(z) * k, 2 * k), "G28.1", "G28",
            "G91 G1 X%.9f\nG90" % (x / 10 * k)]))
    return "\n".join(out) + "\nM2\n"


for seed in range(30):
    mm, inch = rs274(program(seed, False)), rs274(program(seed, True))
    check(mm.status == inch.status, f"seed {seed}: {mm.error} / {inch.error}")
    a, b = mm.moves(), inch.moves()
    check(len(a) == len(b) > 20, f"seed {seed}: {len(a)} and {len(b)} moves")
    for n, ((ka, va), (kb, vb)) in enumerate(zip(a, b)):
        scaled = [v * 25.4 if not (ka == "ARC_FEED" and j == 4)
                  and j not in ((6, 7, 8) if ka == "ARC_FEED" else (3, 4, 5)) else v
                  for j, v in enumerate(vb)]
        check(ka == kb and near(va, scaled, 0.003), f"seed {seed} move {n}: {ka}{va} / {kb}{scaled}")
done()
