# SPDX-License-Identifier: GPL-2.0-or-later
"""(The machine model of rs274 does not convert a tool offset in force when the units change, so
units change here without one.) Property: G5x, G10, G92, G52, tool offsets, rotation and units change the numbers,
never the absolute position. FP-100: M2 with DISABLE_G92_PERSISTENCE clears parameters and offset together. FP-101:
stored positions are machine positions under any offset, rotation, unit and tool. FP-102: rotating there and
back restores the position exactly."""
import random
from harness import *

ABS = "(print,%.9f#<_abs_x> #<_abs_y> #<_abs_z> #<_metric>)\n"
HOME = "(print,%.9f#5161 #5162 #5163)\n"
for seed in range(60):
    r = random.Random(seed)
    n = lambda: "%.4f" % r.uniform(-30, 30)
    program = f"G21\nG0 X{n()} Y{n()} Z{n()}\n" + ABS + "G28.1\n" + HOME
    for _ in range(40):
        program += r.choice([
            f"G10 L2 P{r.randint(0, 9)} X{n()} Y{n()} Z{n()} R{n()}", f"G10 L20 P{r.randint(0, 9)} X{n()} Y{n()}",
            f"G{r.choice([54, 55, 56, 57, 58, 59, 59.1, 59.2, 59.3])}", f"G92 X{n()} Y{n()} Z{n()}",
            f"G52 X{n()}", "G92.1", "G92.2", "G92.3", f"G43.1 X{n()} Z{n()}", "G43 H3", "G49",
            f"G43.2 H{r.randint(1, 3)}", "G49\nG20", "G49\nG21", "G28.1",
            f"G10 L1 P1 X{n()} Z{n()}", f"G10 L10 P1 X{n()} Z{n()}", f"G10 L11 P2 Y{n()}"]) + "\n" + ABS + HOME
    run = rs274(program + "M2\n")
    check(run.status == 0, f"seed {seed}: {run.error}")
    values = [[float(x) for x in l.split()] for l in run.printed]
    first, home = values[0], values[1]
    for v in values[2::2]:
        mm = [x if v[3] else x * 25.4 for x in v[:3]]
        check(near(mm, first[:3], 1e-5), f"seed {seed}: moved from {first} to {mm}")
    for v in values[3::2]:
        check(near(v, home, 1e-6), f"FP-101 seed {seed}: home {home} became {v}")

# FP-101: back to the stored place, whatever is in force
for seed in range(30):
    r = random.Random(seed)
    n = lambda: "%.4f" % r.uniform(-30, 30)
    run = rs274(f"{r.choice(['G20', 'G21'])}\nG0 X{n()} Y{n()} Z{n()}\n" + ABS
                + f"G30.1\nG10 L2 P1 X{n()} Y{n()} R{n()}\n"
                f"G92 X{n()}\nG43.1 Z{n()}\nG0 X{n()} Y{n()}\nG30\n" + ABS + "M2\n")
    a, b = ([float(x) for x in l.split()] for l in run.printed)
    check(near([x if a[3] else x * 25.4 for x in a[:3]], [x if b[3] else x * 25.4 for x in b[:3]], 1e-5),
          f"FP-101: {a} {b}")

# FP-102
for seed in range(20):
    r = random.Random(seed)
    text = f"G10 L2 P1 X3 Y4 R{r.uniform(0, 90):.4f}\nG92 X5 Y6\nG0 X1 Y2\n(print,%.9f#5420 #5421)\n" \
           f"G10 L2 P1 R{r.uniform(0, 360):.4f}\nG10 L2 P1 R{{0}}\n(print,%.9f#5420 #5421)\nM2\n"
    back = text.split(" R")[1].split("\n")[0]
    lines = rs274(text.replace("{0}", back)).printed
    a, b = ([float(x) for x in l.split()] for l in lines)
    check(near(a, b, 1e-8), f"FP-102: {a} {b}")

# FP-100
ini = "[EMC]\nVERSION=1.1\n[TRAJ]\nLINEAR_UNITS=mm\n[RS274NGC]\nDISABLE_G92_PERSISTENCE=1\n"
seen = {}
run = rs274("G92 X5\nM2\n", ini=ini, keep=lambda d: seen.update(var=open(d + "/p.var").read()))
offsets = [v for n, v in run.calls if n == "SET_G92_OFFSET"]
check(offsets[-1] == [0] * 6 and offsets[-2][0] == -5, f"FP-100: {offsets}")
check("5210\t0.000000" in seen["var"] and "5211\t0.000000" in seen["var"], "FP-100: parameters")
run = rs274("G92 X5\nM2\n", keep=lambda d: seen.update(var=open(d + "/p.var").read()))
check("5210\t1.000000" in seen["var"] and "5211\t-0.196850" in seen["var"], "without it they are kept")
done()
