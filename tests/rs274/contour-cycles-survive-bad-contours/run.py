# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-105: degenerate contours of G70, G71, G72 end with an error or harmlessly, in bounded time; offsets of
monotone contours have no loops; the samples of the reference."""
import random
from harness import *


def xz(run):
    return [(n[9:10] if n != "ARC_FEED" else "A", *((v[0], v[2]) if n != "ARC_FEED" else (v[1], v[0])))
            for n, v in run.moves()]


head = "G18 G21 G90 F100\nG0 X20 Z5\no100 sub\n{}\no100 endsub\n{}\nM2\n"
run = rs274(head.format("G1 X10 Z1\nZ-5\nX15 Z-10\nX20", "G71 Q100 X20 Z2 D.2 I2 R.5"))
m = xz(run)
check(len(m) == 32 and near(m[-3][1:], [10.2, -4.9172]) and near(m[-2][1:], [15.0828, -9.8])
      and near(m[-1][1:], [20, -9.8]), m)
run = rs274(head.format("G1 X10 Z1\nZ-5 U1\nX15 Z-10 C1\nX20", "G70 Q100 X20 Z2"))
check([tuple(round(v, 4) for v in p[1:]) for p in xz(run)[3:]] == [(10, 1), (11, -5), (14.6998, -9.6247),
                                                                   (15.4806, -10), (20, -10)], xz(run))
run = rs274("G18 G21 F100\nG0 X2 Z0\no1 sub\nG1 X-10 Z-1\nZ-5\no1 endsub\nG91\nG71 Q1 X20 Z2 I5\nM2\n")
check([p[1:] for p in xz(run)][1:4] == [(20, 2), (22, 2), (22, 2)] and xz(run)[-1][1:] == (22, -4), xz(run))

for cycle in ("G71 Q100 X20 Z2 I1", "G72 Q100 X20 Z2 I1", "G70 Q100 X20 Z2 D1 P3", "G71 Q100 X20 Z2 I1 D1",
              "G71.1 Q100 X20 Z2", "G71.2 Q100 X20 Z2", "G72.2 Q100 X20 Z2 D.5"):
    for contour in ("", "G1 X10 Z1", "G1 X20 Z2", "G1 X10 Z1\nX10 Z-5\nX10 Z2", "G1 X20 Z2\nZ-5", "G1 X10 Z1\nX10 Z-5",
                    "G1 X25 Z1\nZ-5\nX10", "G1 X10 Z1\nZ-5\nG2 X15 Z-10 R1", "G1 X10 Z1\nG3 X10.0005 Z.9995 R5\nG1 Z-3",
                    "G1 X10 Z1\nX20 Z1", "G1 X10 Z2\nZ2", "G1 X10 Z1\nZ-5 A500\nX20",
                    "G1 X10 Z1\nZ-.0001\nX10.0001\nZ-.0002\nX20", "G3 X10 Z-10 R15\nG2 X20 Z-20 R15",
                    "G1 X10 Z1\nG2 X10 Z-9 I5 K-5\nG1 X20"):
        run = rs274(head.format(contour, cycle))
        check(run.status == 0 or "Z" in run.err or "G7" in run.error, f"{cycle} {contour!r}: {run.err}")
        check(len(run.lines) < 20000, f"{cycle} {contour!r}: {len(run.lines)} lines")

for seed in range(120):
    r = random.Random(seed)
    x, z, text = r.uniform(1, 6), 0.0, []
    rising = seed % 2  # without pockets the contour is cut in one run at the end
    text.append(f"G1 X{x:.4f} Z0")
    for _ in range(r.randint(2, 8)):
        dz, dx = -r.uniform(.5, 6), r.uniform(0 if rising else -2, 4)
        if r.random() < .3:
            radius = r.uniform(.6, 2) * (dz * dz + dx * dx) ** .5
            text.append(f"{r.choice(['G2', 'G3'])} X{x + dx:.4f} Z{z + dz:.4f} R{radius:.4f}")
        else:
            text.append(f"G1 X{x + dx:.4f} Z{z + dz:.4f}")
        x, z = x + dx, z + dz
    text.append("G1 X25")
    for cycle in f"G71 Q100 X25 Z2 I{r.uniform(.4, 3):.2f} D{r.uniform(0, 1):.2f} R.5", f"G72 Q100 X25 Z2 I2 D.3", f"G70 Q100 X25 Z2 D1 P2":
        run = rs274(head.format("\n".join(text), cycle))
        check(run.status == 0 or run.error.startswith(("G7X error", "Arc radius too small", "Radius to end")),
              f"seed {seed}: {run.error}")
        check(len(run.lines) < 20000, f"seed {seed}: {len(run.lines)} lines")
        if run.status or cycle[:3] != "G71" or not rising or "G2" in str(text) or "G3" in str(text):
            continue
        # Without loops: Z never goes forward again along the final contour.
        feeds = [p for p in xz(run) if p[0] != "T"]
        tail = feeds[-(len(text) - 1):]
        check(all(a[2] >= b[2] - .011 for a, b in zip(tail, tail[1:])), f"seed {seed}: loop in {tail}")
done()
