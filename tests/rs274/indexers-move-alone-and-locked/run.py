# SPDX-License-Identifier: GPL-2.0-or-later
"""Rotary axes with a lock: rapids of their own, also on the way to G28 and G30; wrapped axes."""
from harness import *

INI = "[TRAJ]\nLINEAR_UNITS=inch\n[AXIS_C]\nLOCKING_INDEXER_JOINT=4\n[AXIS_A]\nWRAPPED_ROTARY=1\n"


def path(program):
    r = rs274("G21 G90 F100\n" + program + "\nM2\n", ini=INI)
    moves = [(n, [a[0], a[5]]) if "STRAIGHT" in n else (n, a[:1]) for n, a in r.calls
             if n in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "SET_MOTION_CONTROL_MODE")]
    return moves, r


ALONE, AGAIN = ("SET_MOTION_CONTROL_MODE", ["CANON_EXACT_PATH"]), ("SET_MOTION_CONTROL_MODE", ["CANON_CONTINUOUS"])
moves, r = path("G0 C90")
check(moves == [ALONE, ("STRAIGHT_TRAVERSE", [0, 90]), AGAIN], (moves, r.err))
moves, r = path("G61\nG0 C90")
check(moves == [ALONE, ("STRAIGHT_TRAVERSE", [0, 90])], moves)
moves, r = path("G0 X1\nG28 X5 C30")
check(moves == [("STRAIGHT_TRAVERSE", [1, 0]), ALONE, ("STRAIGHT_TRAVERSE", [1, 30]), AGAIN,
                ("STRAIGHT_TRAVERSE", [5, 30]), ALONE, ("STRAIGHT_TRAVERSE", [5, 0]), AGAIN,
                ("STRAIGHT_TRAVERSE", [0, 0])], moves)
check(path("G0 X1 C5")[1].error == "Indexing axis C can only be moved alone", "alone")
check(path("G1 C5")[1].error == "Indexing axis C can only be moved with G0", "rapid")

# Wrapped: the sign says the direction, less than a turn.
r = path("G0 A350\nA10\nA-350\nA-10\nA0\nA-0")[1]
check([a[3] for n, a in r.moves()] == [350, 370, 350, 10, 360, 360], [a[3] for n, a in r.moves()])
check(path("G0 A360")[1].error == "Invalid absolute position 360.00 for wrapped rotary axis A", "a turn")
done()
