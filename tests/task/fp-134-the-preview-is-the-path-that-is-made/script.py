# SPDX-License-Identifier: GPL-2.0-or-later
# Random programs, and one with what they leave out (tools, cycles, compensation, loops...), from random start states
# (work offset, rotation, G92, tool length, units, plane set by MDI): each vertex of what the screen draws lies on the
# path that is made, each point of the path that is cut lies on what is drawn, both within 1 um, and the drawing
# reaches as far as the path does. Arcs are drawn as chords, here of 0.7 degrees, less than 0.2 um beside them.
import math
import random

import numpy

from axis.program import Loader
from axis.settings import read
from mill import *

R = random.Random(134)


# Kinds of words that the random programs leave out.
EVERYTHING = """G21 G90 G94 G61 F3000
M3 S1000
T2 M6
G0 X5
G43
G0 Z2
G91 G1 Y1
G90 G98 G83 X3 Y2 Z-4 R1 Q1.5
X6 G99
G80
G91 G81 X1 Y1 Z-2 R-.5 L2
G80 G90 G18
G2 X#5420 Z#5422 I3 K2 Y7 P2
G17 G0 X-8 Y-8
G41 D3
G1 X0 Y-3
Y10
X12
Y0
G40 G1 X-8 Y-9
M61 Q3
G91 G1 X2
T1 M6
G43
G1 Y2
G90 G28.1
o1 repeat [3]
G91 G1 X1.5 Y-.5
o1 endrepeat
G90 G53 G1 X4 Z-30
G93 G1 X9 F60
G94 F3000
G10 L1 P4 Z44
T4 M6
G43
G10 L2 P0 R35
G91 G1 X2
G90 G28
G20 G1 X.3 Y.2 F120
G49
G1 Y0
M2
"""


def number(a, b):
    return f"{R.uniform(a, b):.3f}"


def random_program():
    lines = ["G21 G90 G94 G61 F600"]
    for _ in range(12):
        kind = R.randrange(10)
        if kind < 4:
            lines.append(R.choice(("G0", "G1")) + "".join(f" {a}{number(-10, 10)}" for a in "XYZ" if R.random() < 0.7))
        elif kind < 6:
            lines.append(f"G17 {R.choice(('G2', 'G3'))} X#5420 Y#5421 Z{number(-5, 5)} I{number(3, 8)} J{number(-3, 3)}")
        elif kind < 7:
            plane, words = R.choice((("G18", "X#5420 Z#5422 I{} K{}"), ("G19", "Y#5421 Z#5422 J{} K{}")))
            lines.append(f"{plane} {R.choice(('G2', 'G3'))} " + words.format(number(3, 8), number(-2, 2)) + "\nG17")
        elif kind < 8:
            lines.append(f"G91 G1 X{number(-3, 3)} Y{number(-3, 3)}\nG90")
        elif kind < 9:
            lines.append(R.choice((f"G92 X{number(-3, 3)} Y{number(-3, 3)}", "G92.1", f"G10 L2 P1 R{number(-90, 90)}",
                                   "G54", "G55", f"G43.1 Z{number(0, 5)}", "G49")))
        else:
            lines.append(f"G20 G1 X{number(-0.4, 0.4)} Y{number(-0.4, 0.4)} F24\nG21 F600")
    return "\n".join(l for l in lines if l not in ("G0", "G1")) + "\nM2\n"


def distances(points, path):
    """Of each point to the polyline."""
    a, b = path[:-1], path[1:]
    d = b - a
    long = numpy.maximum((d * d).sum(1), 1e-18)
    for p in points:
        t = numpy.clip(((p - a) * d).sum(1) / long, 0, 1)
        yield math.sqrt((((a + t[:, None] * d) - p) ** 2).sum(1).min())


on()
settings = read(linuxcnc.ini("mill.ini"))
settings.ini_path = str(Path("mill.ini").resolve())
loader = Loader(settings)
for n in range(4):
    for line in ("G90 G21 G17 G49 G92.1", "G10 L2 P1 X0 Y0 Z0 R0", "G54 G53 G0 X0 Y0 Z0"):
        mdi(line)
    for line in (f"G10 L2 P1 X{number(-20, 20)} Y{number(-20, 20)} Z-20 R{number(-180, 180)}",
                 f"G10 L2 P2 X{number(-20, 20)} Y5 Z-30 R{number(0, 45)}", R.choice(("G54", "G55")),
                 R.choice(("G92 X1 Y2 Z3", "G92.1")), R.choice(("G43.1 Z7.5", "G49")),
                 f"G53 G0 X{number(0, 9)} Y{number(0, 9)} Z-25", R.choice(("G20", "G21")), R.choice(("G18", "G17"))):
        mdi(line)
    program(random_program() if n < 3 else EVERYTHING, f"p{n}.ngc")
    mode(MODE_MANUAL)
    c.task_plan_synch()
    c.wait_complete()
    preview, (drawn,) = loader.read(str(Path(f"p{n}.ngc").resolve()), poll(), False,
                                    [(-1, 0.0, "XYZABCUVW", [0.0] * 9, "XYZ")], 60.0).result()
    mode(MODE_AUTO)
    offset = numpy.array(poll().tool_offset[:3])
    made, cut = [numpy.array(s.position[:3]) - offset], []
    c.auto(AUTO_RUN, 0)
    while poll().interp_state != INTERP_IDLE or s.queue:
        made.append(numpy.array(s.position[:3]) - numpy.array(s.tool_offset[:3]))
        if s.motion_type in (MOTION_TYPE_FEED, MOTION_TYPE_ARC):
            cut.append(made[-1])
        sleep(0.001 if s.current_vel < 7 else 0.002)  # corners are met exactly
    made.append(numpy.array(poll().position[:3]) - numpy.array(s.tool_offset[:3]))
    made = numpy.array(made)
    shown = numpy.asarray(drawn.vertices).astype(float) * 25.4
    worst = max(distances(shown, made))
    beside = max(distances(cut, numpy.vstack([made[:1], shown])))
    far = made if n < 3 else numpy.array(cut)    # where a new tool's tip is, without a move, is not drawn
    reach = max(abs(far.max(0) - shown.max(0)).max() if n < 3 else (far.max(0) - shown.max(0)).max(),
                abs(far.min(0) - shown.min(0)).max() if n < 3 else (shown.min(0) - far.min(0)).max())
    print(n, preview.error, messages(), "vertices", len(shown) > 20,
          "on the path" if worst < 1e-3 else f"OFF by {worst:.6f}",
          "drawn as it is made" if beside < 1e-3 and len(cut) > 500
          else f"MADE {beside:.6f} beside it, {len(cut)} points",
          "same extent" if reach < 0.05 else f"EXTENT differs by {reach:.4f}")
loader.close()
