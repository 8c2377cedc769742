# SPDX-License-Identifier: GPL-2.0-or-later
"""The rs274 package: canons, the program record, batches, the G-code writer."""
import math
import os
import tempfile
from types import SimpleNamespace

from harness import *

import gcode
import rs274
from rs274.author import Gcode, simplify
from rs274.glcanon import GLCanon
from rs274.glcanon_batch import BatchGLCanon
from rs274.interpret import StatMixin

check(rs274.Translated and rs274.ArcsToSegmentsMixin, "names of the package")
TOOLS = [(i if i < 3 else -1, 0., 0., i * 1., 0., 0., 0., 0., 0., 0., .5, 0., 0., 0) for i in range(4)]


def stat():
    return SimpleNamespace(tool_table=TOOLS, angular_units=1.0, linear_units=1 / 25.4, axis_mask=0x1ff,
                           block_delete=False)


class Canon(GLCanon, StatMixin):
    def __init__(self, folder, **kw):
        GLCanon.__init__(self, {"dwell": (1, 0, 0)}, kw.pop("geometry", "XYZABCUVW"), **kw)
        StatMixin.__init__(self, stat(), False)
        self.parameter_file = folder + "/p.var"

    def change_tool(self, nr):
        GLCanon.change_tool(self, nr)
        StatMixin.change_tool(self, nr)


class Batches(BatchGLCanon, StatMixin):
    def __init__(self, folder):
        BatchGLCanon.__init__(self)
        StatMixin.__init__(self, stat(), False)
        self.parameter_file = folder + "/p.var"
        self.seen = []

    def change_tool(self, nr):
        BatchGLCanon.change_tool(self, nr)
        StatMixin.change_tool(self, nr)

    def batch_progress(self, line):
        self.seen.append(line)


with tempfile.TemporaryDirectory() as d:
    def preview(text, make=Canon, **kw):
        open(d + "/t.ngc", "w").write(text)
        if os.path.exists(d + "/p.var"):
            os.remove(d + "/p.var")
        c = make(d, **kw)
        result = gcode.parse(d + "/t.ngc", c, ["G20"])
        c.calc_extents()
        return result, c

    # The rapid before the first feed is not recorded; the rest is, with lines and kinds.
    result, c = preview("G0 X1 Y2\nG1 X4 F60\nG0 Z1\nG4 P2\nG2 X6 I1\nM2\n")
    g = c.program_geometry
    check(result == (1, 6), result)
    check(g.kinds.tolist()[:5] == [3, 1, 0, 4, 2] and set(g.kinds.tolist()[4:]) == {2}, g.kinds)
    check(g.lines.tolist()[:4] == [2, 2, 3, 4] and g.lines[-1] == 5, g.lines)
    check(g.positions().dtype.name == "float32" and g.positions()[1].tolist() == [4, 2, 0], g.positions()[:4])
    check(c.min_extents == [1, 2, 0] and near(c.max_extents, [6, 3, 1], 1e-6), (c.min_extents, c.max_extents))
    check(abs(c.g0_length - 1) < 1e-9 and abs(c.g1_length - 3 - math.pi) < .02, (c.g0_length, c.g1_length))
    check(abs(c.run_time(10) - (c.g1_length / 1 + 1 / 10 + 2)) < 1e-9
          and abs(c.run_time(.5) - (c.g1_length + 1) / .5 - 2) < 1e-9, c.run_time(10))
    check(c.dwells == [(4, (1, 0, 0), 4, 2, 1, 0)] and c.dwell_time == 2, c.dwells)
    check(g.spans_for_line(3) == [(1, 3)] and g.spans_for_line(4) == [] and len(g.spans_for_line(5)) == 1,
          g.spans_for_line(5))
    check(g.n_moves == len(g.kinds) - 2 and not g.is_empty, g.n_moves)
    try:
        c.traverse
        check(False, "old lists are gone")
    except AttributeError as e:
        check(str(e).startswith("GLCanon.traverse was removed (see retire-canon-move-lists); "), e)

    # Tools, tool offsets: recorded is the controlled point, "notool" adds the offset.
    result, c = preview("T2 M6\nG43 H2\nG0 X1\nG1 Z-1 F9\nM2\n")
    check(c.tool_list == [2] and near([c.zo], [2 * 25.4 / 25.4]), (c.tool_list, c.zo))
    check(near([c.max_extents_notool[2] - c.max_extents[2]], [c.zo]), (c.max_extents, c.max_extents_notool))
    check(c.program_geometry.tool_number(c.program_geometry.tools[-1]) == 2
          and c.program_geometry.tool_number(0) is None, "tools")

    # Rotation and offsets; extents without the rotation.
    result, c = preview("G10 L2 P1 X1 Y1 R90\nG1 F9 X0 Y0\nX2\nM2\n")
    check(near(c.max_extents, [1, 3, 0], 1e-6) and near(c.max_extents_zero_rxy[:2], [3, 2], 1e-6),
          (c.max_extents, c.max_extents_zero_rxy))
    # Several rotations: all is turned back by the one that is in force at the end (M2 goes to G54).
    first = "G10 L2 P1 X3 Y1 R30\n"
    for text, low, high in (("G1 F9 X0 Y0\nX2 Y1\nG10 L2 P1 X1 Y2 R60\nX2 Y0\nM2\n", [-1.2321, -.366], [3.366, 2]),
                            ("G10 L2 P2 X1 Y2 R0\nG1 F9 X0 Y0\nX2 Y1\nG55\nX2 Y0\nM2\n", [-.0981, 1], [5, 2])):
        _, c = preview(first + text)
        found = c.min_extents_zero_rxy, c.max_extents_zero_rxy
        check(near(found[0][:2], low, 1e-4) and near(found[1][:2], high, 1e-4), found)
    _, c = preview(first + "G43.1 Z1 X2\nG1 F9 X0 Y0\nX2 Y1\nM2\n")
    check(near(c.max_extents_zero_rxy, [5, 2.634, -1], 1e-3) and
          near(c.max_extents_notool_zero_rxy, [7, 2.634, 0], 1e-3), "the tool offset is not turned")
    _, c = preview("T1 M6\nG1 Z5 X1 F9\nG43 H1\nG1 X2\nM2\n")
    check(c.min_extents == c.min_extents_notool == [0, 0, 0], "the place where a tool change leaves the machine counts")

    # Directives in comments.
    result, c = preview("G1 X1 F9\n(AXIS,hide)\nG1 X50\n(PREVIEW,show)\n(AXIS,notify,look here, please)\nX2\n"
                        "(AXIS,notify)\nM2\n")
    check(c.max_extents[0] == 2 and c.notify == 2 and c.notify_message == "(AXIS,notify):2",
          (c.max_extents, c.notify_message))
    open(d + "/t.ngc", "w").write("G1 X1 F9\n(AXIS,stop)\nX50\nM2\n")
    c = Canon(d)
    try:
        gcode.parse(d + "/t.ngc", c, ["G20"])
        check(False, "stop stops")
    except (KeyboardInterrupt, RuntimeError):
        c.calc_extents()
        check(c.max_extents[0] == 1, c.max_extents)
    # A directive without its value changes nothing, an unreadable one has a default; canon and reader in C++ agree.
    for text, want in (("XY_Z_POS", (0., 1.5, 0, "")), ("UV_Z_POS", (0., 1.5, 0, "")), ("UV_Z_POS,", (0., 30., 0, "")),
                       ("XY_Z_POS,q", (5 / 25.4, 1.5, 0, "")), ("notify", (0., 1.5, 1, "(AXIS,notify):1")),
                       ("notify,", (0., 1.5, 1, "(AXIS,notify):1")), ("notify,a,b", (0., 1.5, 1, "a"))):
        _, c = preview(f"G1 X1 F9\n(AXIS,{text})\nM2\n", is_foam=1)
        p = gcode.load(d + "/t.ngc", d + "/p2.var", ["G20"])
        both = [(c.foam_z, c.foam_w, c.notify, c.notify_message),
                (0. if p.foam_z is None else p.foam_z, 1.5 if p.foam_w is None else p.foam_w, p.notify,
                 p.notify_message)]
        check(both == [want] * 2, f"{text}: {both}")
    result, c = preview("(AXIS,XY_Z_POS,2)\n(AXIS,UV_Z_POS,x)\nG1 F9 X1 U2\nG21\n(AXIS,UV_Z_POS,25.4)\nM2\n", is_foam=1)
    check(c.foam_z == 2 and near([c.foam_w], [1.0])
          and c.program_geometry.positions(1).shape == c.program_geometry.positions().shape, (c.foam_z, c.foam_w))
    check(c.min_extents[2] == 1 and c.max_extents[2] == 2, (c.min_extents, c.max_extents))

    # Rotary axes are drawn where the geometry says so, extents stay raw.
    result, c = preview("G1 F9 Y1\nA90\nM2\n", geometry="!XYZA")
    check(near(c.program_geometry.positions()[-1], [0, 0, 1], 1e-5) and near(c.max_extents, [0, 1, 0]),
          c.program_geometry.positions()[-1])
    check(c.program_geometry.n_vertices == 12, c.program_geometry.n_vertices)
    result, c = preview("G1 F9 X1\nM2\n", geometry="-XYZ")
    check(c.program_geometry.positions()[-1].tolist() == [-1, 0, 0], c.program_geometry.positions()[-1])

    # Batches record the same.
    text = "G0 X1\nG1 X2 F9\nG4P1\nT1M6\nG43H1\nG0Z3\nG33.1 Z1 K.1\nG2X4I1\nG1 Z0\nM101P2\nM2\n".replace("G33.1 Z1 K.1\n", "")
    (r1, a), (r2, b) = preview(text), preview(text, Batches)
    check(r1 == r2 and a.program_geometry.kinds.tolist() == b.program_geometry.kinds.tolist(), (r1, r2))
    check(a.program_geometry.lines.tolist() == b.program_geometry.lines.tolist() and a.run_time(3) == b.run_time(3),
          "same lines")
    check(abs(a.program_geometry.positions() - b.program_geometry.positions()).max() == 0 and b.seen, b.seen)
    check(preview("M2\n")[1].max_extents == [0, 0, 0], "an empty program")

# Who has which tool.
s = StatMixin(stat(), False)
check(s.get_index(2) == 2 and s.get_index(9) == 0 and s.get_tool(77)[0] == -1 and len(s.get_tool(77)) == 14, "tools")
s.change_tool(2)
check(s.tools[0] == TOOLS[2] and s.get_tool(2) == TOOLS[2], "a tool in the spindle stays in the table")
s.change_tool(9)
check(s.tools[0][0] == -1, "no tool")
check(s.get_axis_mask() == 0x1ff and s.get_external_length_units() == 1 / 25.4 and s.get_block_delete() is False,
      "machine")
r = StatMixin(stat(), True)
r.change_tool(2)
check(r.tools[0] == TOOLS[2] and r.tools[2] == TOOLS[0] and r.get_tool(2) == TOOLS[2], "a random changer swaps")

# The writer: what it leaves out stays within the tolerance, arcs are found, and it runs.
points = [(math.cos(t / 40) * 3, math.sin(t
                                          / 40) * 3, 0.) for t in range(60)] + [(x / 10, 3., 0.)
                                                                                for x in range(5, -40, -1)]
pieces = simplify(points, .001, 17)
check(len(pieces) < 20 and any(p[0] == "arc" for p in pieces) and pieces[-1][1] == points[-1], pieces)
lines = []
w = Gcode(homeheight=2, safetyheight=.5, tolerance=.001, units="G20", target=lines.append)
w.begin()
w.set_feed(10)
w.rapid(3, 0)
w.cut(z=0)
for p in points[1:]:
    w.cut(*p)
w.continuous(.01)
w.set_plane(18)
w.exactpath()
w.home()
w.end()
check(lines[0] == "G20" and lines[-1] == "M2" and "G64 P0.01" in lines and "G61" in lines and "G18" in lines
      and len(lines) < 40, lines)
check(lines[2:5] == ["G0 Z0.5", "S1000 M3", "G4 P3"], f"the spindle turns before it cuts: {lines[:5]}")
for speed, want in ((2500, 1), (0, 0)):
    lines = []
    Gcode(target=lines.append, spindle_speed=speed).begin()
    check(lines.count("S2500 M3") == want == len([l for l in lines if "M3" in l]), f"{speed}: {lines}")
teeth = [(n / 100, 0., -.1 * (n % 2)) for n in range(5000)]
check([p[1] for p in simplify(teeth, .001, 18)] == teeth[1:], "thousands of teeth of one height")
done()
