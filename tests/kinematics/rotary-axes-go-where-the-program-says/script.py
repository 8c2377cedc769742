# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-093: with any tool offset, work offset and G92 on all nine axes, G53, G28 and G30 go to the
machine's coordinates. FP-095: in G93 a move lasts 1/F minutes whatever axes it has. FP-096: a
wrapped rotary goes less than a turn after many of them, in the direction of the word's sign."""
import random

from mill import *

AXES = "XYZABCUVW"
bad = []


def joints():
    sleep(0.01)
    return [j["output"] for j in poll().joint[:9]]


def check(title, wanted):
    at = joints()
    for letter, value in wanted.items():
        d = at[AXES.index(letter)] - value
        if letter == "B":
            d = (d + 180) % 360 - 180
        if abs(d) > 1e-4:
            bad.append(f"{title}: {letter} at {at[AXES.index(letter)]:.4f} instead of {value:.4f}")


def do(line):
    done, told = mdi(line), messages()
    if done != RCS_DONE or told:
        bad.append(f"{line}: {done} {told}")


def words(values):
    return " ".join(f"{k}{v:.4f}" for k, v in values.items())


def some(rng, low, high, letters=AXES):
    return {k: round(rng.uniform(low, high), 4) for k in letters}


on()
mode(MODE_MDI)
for seed in range(6):
    rng = random.Random(seed)
    ref = some(rng, 5, 150)
    do("G49 G92.1 G54 G53 G0 " + words(ref))
    do("G28.1")
    ref30 = some(rng, 5, 150)
    do("G53 G0 " + words(ref30))
    do("G30.1")
    do("G43.1 " + words(some(rng, -20, 20)))
    do("G10 L2 P1 " + words(some(rng, -30, 30)))
    do("G92 " + words(some(rng, 0, 40)))
    do("G0 X1 A10 C20 U3")
    for letter in AXES:
        target = round(rng.uniform(0, 90), 4)
        do(f"G53 G0 {letter}{target}")
        check(f"seed {seed} G53 {letter}", {letter: target})
    do("G28")
    check(f"seed {seed} G28", ref)
    do("G91")
    do("G30 X0 Y0 Z0 A0 B0 C0 U0 V0 W0")
    do("G90")
    check(f"seed {seed} G30", ref30)
do("G49 G92.1 G54")
do("G10 L2 P1 " + " ".join(f"{k}0" for k in AXES))
do("G53 G0 " + " ".join(f"{k}0" for k in AXES))

for line, seconds in (("G1 X0.0002 A90 F6", 10), ("G1 X50 A90.01 F10", 6), ("G1 A0 C50 F12", 5), ("G1 X0 U30 F12", 5),
                      ("G1 X0.0002 C30 W20 F10", 6)):
    do("G93")
    t = clock.now()
    do(line)
    t = clock.now() - t
    if abs(t - seconds) > 0.25:
        bad.append(f"G93 {line}: {t:.2f} s instead of {seconds}")
do("G94 F1000")

do("G53 G0 A0 B0")
do("G91 G0 B350")
for _ in range(80):
    do("B355")
    if bad:
        break
do("G90")
at = joints()[4]
do("G0 B10")
if not 0 <= joints()[4] - at < 360:
    bad.append(f"after 80 turns B goes from {at} to {joints()[4]}")
check("B10", {"B": 10})
do("G0 B0")
at = joints()[4]
do("G0 B350")
if abs(joints()[4] - at - 350) > 1e-4:
    bad.append(f"B350 from B0 goes by {joints()[4] - at}")
# the direction of a sign: B-20 turns backwards to 20
before = joints()[4]
do("G0 B-20")
if not before - 360 < joints()[4] < before or abs(joints()[4] % 360 - 20) > 1e-4:
    bad.append(f"B-20 from 350: {joints()[4] - before}")
print("\n".join(bad[:12]) if bad else "as the program says")
