# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-107: with G98 no sideways motion happens below the initial level. FP-111: with
CYCLES_BOTH_WAYS a cycle drills upward when R is below the bottom. FP-108: in G7 X words are
diameters in every plane; R, I, K are radii."""
import random
from harness import *

for seed in range(60):
    r = random.Random(seed)
    g = r.choice("G73 G81 G82 G83 G85 G86 G89 G84".split())
    plane, (down, a, b) = r.choice([(17, (2, 0, 1)), (18, (1, 2, 0)), (19, (0, 1, 2))])
    axis = "XYZ"
    level = r.uniform(5, 20)
    words = f"{axis[down]}{-r.uniform(1, 9):.3f} R{r.uniform(.5, 4):.3f} P.1"
    words = words if g in ("G82", "G86", "G89", "G84") else words[:-4]
    words += " Q1.5" if g in ("G73", "G83") else ""
    holes = "".join(f"{axis[a]}{r.uniform(-9, 9):.3f} {axis[b]}{r.uniform(-9, 9):.3f}\n" for _ in range(4))
    run = rs274(f"G21 G{plane} F100 S100 M3\nG0 {axis[down]}{level:.4f}\nG98 {g} {words} {holes}G80\nM2\n")
    check(run.status == 0, f"seed {seed}: {run.error}")
    at = [0, 0, 0]
    at[down] = round(level, 4)
    for name, v in run.moves():
        sideways = v[a] != at[a] or v[b] != at[b]
        check(not sideways or at[down] >= level - 1e-3, f"FP-107 seed {seed} {g}: travels at {at[down]}")
        at = v[:3]

# FP-111
ini = "[EMC]\nVERSION=1.1\n[TRAJ]\nLINEAR_UNITS=mm\n[RS274NGC]\nCYCLES_BOTH_WAYS=%d\n"
program = "G21 F100\nG0 Z-20\nG98 G83 X1 Y1 Z-2 R-8 Q3\nG80\nM2\n"
check(rs274(program, ini=ini % 0).error == "R less than z in cycle in xy plane", "refused by default")
run = rs274(program, ini=ini % 1)
check([v[2] for _, v in run.moves()] == [-20, -20, -8, -5, -8, -6, -2, -20], run.moves())

# FP-108
run = rs274("G21 G7 G19 F100\nG0 X20 Y0 Z0\nG81 X-10 R3 Y5 Z6\nM2\n")
check([v[0] for _, v in run.moves()] == [10, 10, 3, -5, 3], f"X is a diameter, R a radius: {run.moves()}")
run = rs274("G7\nG0 X20\n(print,#5420 #<_x> #5021)\nG10 L20 P1 X4\n(print,#5420)\nG92 X8\n(print,#5420)\nG52 X2\n"
            "(print,#5211)\nM2\n")
check(run.printed == ["10.000000 10.000000 10.000000", "2.000000", "4.000000", "%.6f" % (1 / 25.4)], run.printed)

# The quirks that the reference states
check([v[:3] for _, v in rs274("G20 F10 G0 Z1\nG99 G81 X1 Y1 Z-.5 R.1\nX2\nG98 X3\nM2\n").moves()] ==
      [[0, 0, 1], [1, 1, 1], [1, 1, .1], [1, 1, -.5], [1, 1, .1], [2, 1, .1], [2, 1, -.5], [2, 1, .1],
       [3, 1, 1], [3, 1, .1], [3, 1, -.5], [3, 1, 1]], "series with G99 and G98")
for text, want in {
    "G81 X1 Z-1": "R clearance plane unspecified in cycle", "G81 X1 R1 Z-1 L0": "Cannot do zero repeats of cycle",
    "G81 X1 R1": "Z value unspecified in xy plane canned cycle", "G81 X1 R-2 Z-1": "R less than z in cycle in xy plane",
    "G82 X1 R1 Z-1": "Dwell time p word missing with g82", "G83 X1 R1 Z-1": "Q word missing with g83",
    "G83 X1 R1 Z-1 Q0": "Negative or zero q value used", "G81 X1 A1 R1 Z-1": "Cannot put an a in canned cycle",
    "G84 X1 R1 Z-1": "Spindle not turning in G84", "G86 X1 R1 Z-1 P1": "Spindle not turning in g86",
    "G93 G81 X1 R1 Z-1 F1": "Cannot use inverse time feed with canned cycles",
    "G87 X1 R1 Z-1": "I word missing with g87", }.items():
    got = rs274(f"F100\n{text}\nM2\n").error
    check(got == want, f"{text}: {got!r}, not {want!r}")
check(rs274("G81 X1 R1 Z-1\nM2\n").error == "Cannot feed with zero feed rate", "F")
done()
