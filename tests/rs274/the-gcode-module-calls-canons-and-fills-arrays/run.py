# SPDX-License-Identifier: GPL-2.0-or-later
"""gcode.parse with callbacks and batches, gcode.load into arrays: they agree."""
import math
import os
import signal
import tempfile
from harness import *
import gcode


class Canon:
    def __init__(self, folder):
        self.parameter_file = folder + "/p.var"
        self.log = []

    def get_axis_mask(self): return 0x1ff
    def get_external_length_units(self): return 1.0
    def get_external_angular_units(self): return 1.0
    def get_tool(self, i): return (1, 0., 0., 10., 0., 0., 0., 0., 0., 0., 6., 0., 0.,
                                   0) if i < 2 else (-1,) + (0.,) * 12 + (0,)
    def get_block_delete(self): return 0
    def check_abort(self): return False

    def __getattr__(self, name):
        if name.startswith("_") or name in ("use_move_batches", "move_batch", "log"):
            raise AttributeError(name)
        return lambda *a: self.log.append((name,) + a)

    def next_line(self, st):
        self.log.append(("next_line", st.sequence_number, st.motion_mode, st.feed_rate))


class Batches(Canon):
    use_move_batches = True

    def move_batch(self, rows):
        self.log += [("row",) + tuple(rows.cast("d")[i:i + 13]) for i in range(0, rows.nbytes // 8, 13)]


with tempfile.TemporaryDirectory() as d:
    def parse(text, canon=Canon, codes=("G20",)):
        open(d + "/t.ngc", "w").write(text)
        c = canon(d)
        return gcode.parse(d + "/t.ngc", c, list(codes)), c.log

    result, log = parse("G1 X25.4 F254 (hello)\nG2 X0 I-12.7\n(msg,hi)\nG4P.5\nM101P3\nT1 M6\nG43 H1\nG0 "
                        "Z2.54 A90\nG18\nM2\n", codes=["G21"])
    check(result == (1, 10), result)
    calls = [l for l in log if l[0] != "next_line"]
    check(calls[:3] == [("set_g5x_offset", 1) + (0.,) * 9, ("set_g92_offset",) + (0.,) * 9, ("set_xy_rotation", 0.)],
          calls[:3])
    check(calls[3:] == [("comment", "hello"), ("set_feed_rate", 10.), ("straight_feed", 1.) + (0.,) * 8,
                        ("arc_feed", 0., 0., .5, 0., -1, 0., 0., 0., 0., 0., 0., 0.), ("message", "hi"), ("dwell", .5),
                        ("user_defined_function", 1, 3., -1.), ("change_tool", 1),
                        ("tool_offset", 0., 0., 10. / 25.4) + (0.,) * 6,
                        ("straight_traverse", 0., 0., .1, 90.) + (0.,) * 5, ("set_plane", 3),
                        ("set_g5x_offset", 1) + (0.,) * 9, ("set_xy_rotation", 0.), ("set_plane", 1),
                        ("set_feed_rate", 0.)], calls[3:])
    lines = [l[1] for l in log if l[0] == "next_line"]
    check(lines == [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10], lines)
    check([l for l in log if l[0] == "next_line" and l[1] == 2][0][2:] == (10, 254.0), "codes before the line")

    result, log = parse("G1 X1 F5\nG0 X2\nF6\nG1 X3\nG2 X4 I.5\nG4 P1\nT1 M6\nM2\n", Batches)
    rows = [l[1:] for l in log if l[0] == "row"]
    check([r[:3] for r in rows] == [(1, 1, 1), (0, 2, 2), (1, 4, 3), (4, 6, 1), (6, 7, 1)], rows)
    check([r[11] for r in rows] == [5, 5, 6, 6, 6], rows)
    names = [l[0] for l in log if l[0] != "next_line"]
    check(names.index("arc_feed") > names.index("row") and names.count("set_feed_rate") == 3, names)

    result, log = parse("G0 X1\nG1 X2 F1\nX[#<nope>]\nM2\n")
    check(result == (5, 3) and gcode.strerror(5) == "Named parameter #<nope> not defined", (result, gcode.strerror(5)))
    check(parse("G0 X1\n")[0][0] == 5 and "File ended" in gcode.strerror(5), "no end")
    check(parse("%\nG0 X1\n%\n")[0] == (3, 4), parse("%\nG0 X1\n%\n")[0])
    check(gcode.parse(d + "/nothere", Canon(d), ["G20"])[0] == 4 and gcode.strerror(4) == "File not open", "no file")

    check(parse("")[0][0] == 5 and gcode.strerror(5).startswith("File ended with no percent"), "an empty file is open")
    result, log = parse("%\n#1=2\nG1 X1 F1\n(none)\nX[#<nope>]\n%\n", codes=["G21", "G90", "G17"])
    lines = [l[1] for l in log if l[0] == "next_line"]
    check(lines == [0, 1, 3, 4, 5] and result == (5, 5),
          f"lines of a % file after init codes, and the one with the error: {lines} {result}")

    arcs = Canon(d)         # answers every name, also length_units
    arcs.lo, arcs.plane, arcs.rotation_cos, arcs.rotation_sin = (1.,) + (0.,) * 8, 1, 1., 0.
    for letter in "xyzabcuvw":
        setattr(arcs, "g5x_offset_" + letter, 1.)
        setattr(arcs, "g92_offset_" + letter, -1.)
    points = gcode.arc_to_segments(arcs, 0., 1., 0., 0., 1, 2., *(0.,) * 6, 64)
    check(len(points) == 32 and points[-1] == (0., 1., 2.) + (0.,) * 6 and points[15][2] == 1., points)

    open(d + "/mm.ini", "w").write("[TRAJ]\nLINEAR_UNITS = mm\n")
    os.environ["INI_FILE_NAME"] = d + "/mm.ini"
    heights = [round(25.4 * l[3], 6)
               for l in parse("G0 Z9\nG83 X1 Z-5 R2 Q4 F9\nM2\n", codes=["G21"])[1] if l[0] == "straight_traverse"]
    del os.environ["INI_FILE_NAME"]
    check(heights == [9, 9, 2, 2, -1, 2], f"the peck goes back as far as the machine's does: {heights}")

    class Raises(Canon):
        def straight_feed(self, *a): raise ValueError("x")
    try:
        parse("G1 X1 F1\nM2\n", Raises)
        check(False, "nothing raised")
    except RuntimeError as e:
        check(str(e) == "parse_file interp_error", e)

    class Stops(Canon):
        def comment(self, text): raise KeyboardInterrupt
    try:
        parse("(AXIS,stop)\nM2\n", Stops)
        check(False, "nothing raised")
    except KeyboardInterrupt:
        pass

    # arrays
    open(d + "/t.ngc", "w").write("G21 G90 F254\nG0 X25.4\nG1 Y25.4\nG2 X50.8 Y50.8 I25.4 J0\nG10 L2 P1 X25.4 R90\n"
                                  "G0 X0 Y0\n(AXIS,hide)\nG1 X99\n(AXIS,show)\nG4 P2\nM101\n"
                                  "T1 M6\nG43 H1\nG0 X2\nG1 X3\nM2\n")
    tools = [Canon(d).get_tool(i) for i in range(3)]
    p = gcode.load(d + "/t.ngc", tools=tools, initcodes=["G21"])
    check(p.result == 1 and p.error == "" and p.last_line == 16, (p.error, p.last_line))
    points, lines, kinds = p.positions.tolist(), p.lines.tolist(), p.kinds.tolist()
    check(len(points) == len(lines) == len(kinds) == p.n_vertices, "lengths")
    check([row[:3] for row in points] == p.points.tolist() and p.positions.shape[1] == 9,
          "three columns hold what only X, Y and Z fill")
    check(kinds[0] == 3 and kinds[1] == 1 and near(points[1][:3], [1, 1, 0]), points[:2])
    arc = [n for n, k in enumerate(kinds) if k == 2]
    check(len(arc) == 32 and all(abs(math.hypot(points[n][0] - 2, points[n][1] - 1) - 1) < 1e-6 for n in arc), len(arc))
    traverse = [points[n][:2] for n, k in enumerate(kinds) if k == 0]
    check(near(traverse[0], [1, 0], 1e-6), f"rotated system: {traverse}")
    check(abs(p.cutting_length - (1 + 32 * 2 * math.sin(math.pi / 128) + 1 / 25.4)) < 1e-5 and p.dwell_time == 2,
          p.cutting_length)
    check(abs(p.cutting_time(5) - p.cutting_length / 5 * 60) < 1e-6
          and abs(p.cutting_time(1000) - p.cutting_length / 10 * 60) < 1e-6, "times")
    check(p.tools == [(len([k for n, k in enumerate(kinds) if lines[n] <= 12]), 1)] and len(p.marks) == 2,
          (p.tools, p.marks))
    check(near(p.extents[0], [1 - 3 / 25.4 * 0, 0, 0], 2), p.extents)
    open(d + "/turns.ngc", "w").write("G20 F9\nG1 X1 A0\nG1 X2 A5 Y1\nG1 X3 A0\nG1 U2\nM2\n")
    for last, columns in ((4, 4), (5, 7)):
        open(d + "/part.ngc", "w").write("".join(open(d + "/turns.ngc").readlines()[:last]) + "M2\n")
        turns = gcode.load(d + "/part.ngc")
        check(turns.points.shape[1] == columns
              and turns.points.tolist() == [row[:columns] for row in turns.positions.tolist()], turns.points.shape)
        check(turns.positions.tolist()[2][:4] == [2, 1, 0, 5]
              and turns.positions.tolist()[-1][6] == (2 if columns == 7 else 0), turns.positions.tolist())
    # The tool that is in the spindle is the one that was changed to, and what G10 sets lasts.
    inch = [Canon(d).get_tool(9)] + [(n, 0., 0., n * 25.4) + (0.,) * 6 + (n * 5.08, 0., 0., 0) for n in (1, 2, 3)]
    for lines, length in (("T2 M6\nG43", 2), ("T2 M6\nG43\nT3 M6\nG43", 3), ("G10 L1 P2 Z9\nT2 M6\nG43", 9),
                          ("T2 M6\nG43 H3", 3), ("T2 M6\nM61 Q1\nG43", 1), ("T2 M6\nG43\nT0 M6\nG43", 0)):
        open(d + "/tool.ngc", "w").write(lines + "\nG0 Z1\nG1 X1 F9\nM2\n")
        p2 = gcode.load(d + "/tool.ngc", tools=inch, initcodes=["G20"])
        check(near(p2.extents_tool[1], [1, 0, 1 + length], 1e-5) and near(p2.extents[1], [1, 0, 1]),
              f"{lines}: {p2.extents_tool} {p2.error}")
    open(d + "/comp.ngc", "w").write("T2 M6\nG42\nG1 X2 Y2 F9\nX9\nM2\n")
    compensated = gcode.load(d + "/comp.ngc", tools=inch, initcodes=["G20"]).extents[1][1]
    check(near([compensated], [1.8]), f"the radius of the tool that was changed to: {compensated}")
    # What is read back after a tool change is where the machine is, in the offsets of now.
    open(d + "/back.ngc", "w").write("G0 X5\nT1 M6\nG43.1 X1\nG10 L11 P2 Z1\nG91 G1 Y1 F9\nM2\n")
    back = gcode.load(d + "/back.ngc", tools=inch, initcodes=["G20"])
    check(near(back.points.tolist()[-1], [4, 1, 0]),
          f"the tool's offset stays in the place that is read back: {back.points.tolist()}")
    # What a subroutine's file does belongs to the line that calls it.
    open(d + "/sub.ini", "w").write(f"[RS274NGC]\nSUBROUTINE_PATH = {d}\n")
    open(d + "/helper.ngc", "w").write("o<helper> sub\n" + "\n" * 9 + "G1 X3\nG4 P1\nY2\no<helper> endsub\nM2\n")
    open(d + "/call.ngc", "w").write("G20 F9\nG1 X1\no<helper> call\no9 sub\nG1 Y5\no9 endsub\no9 call\nG1 X0\nM2\n")
    calls = gcode.load(d + "/call.ngc", ini=d + "/sub.ini")
    check(calls.lines.tolist() == [2, 2, 3, 3, 5, 8] and calls.marks[0][0] == 3,
          f"{calls.lines.tolist()} {calls.error}")
    circles = "".join(f"G10 L2 P1 X{n * .37:.3f} Y{n * -.61:.3f} R{n * 7}\nG0 X{n * .1:.2f}\n"
                      f"G{2 + n % 2} I.3 J{n * .1 - 1:.1f} P{1 + n % 3}\n"
                      for n in range(40))
    open(d + "/circles.ngc", "w").write("G20 F9\nG1 X0\n" + circles + "M2\n")
    length = sum(2 * math.pi * math.hypot(.3, n * .1 - 1) * (1 + n % 3) for n in range(40))
    turned = gcode.load(d + "/circles.ngc", arc_division=500).cutting_length
    check(abs(turned - length) < .01, f"circles are gone around as often as they say: {turned}, not {length}")
    stop = gcode.load(d + "/t.ngc", tools=tools, progress=lambda line: True)
    check(stop.result in (0, 1), stop.result)
    open(d + "/bad.ngc", "w").write("G0 X1\nG0 X1 X2\nM2\n")
    bad = gcode.load(d + "/bad.ngc")
    check(bad.fault["line"] == 2 and bad.fault["column"] == 7 and bad.fault["what"] == "Multiple x words on one line",
          bad.fault)

    # Compensation holds moves back: each is told with its own line.
    open(d + "/comp.ngc", "w").write("G21 F100\nG41.1 D2\nG1 X10\nX20\nY20\nG40\nM2\n")
    c = Canon(d)
    gcode.parse(d + "/comp.ngc", c, "", "")
    told = [(e[0], e[1]) for e in c.log if e[0] in ("next_line", "straight_feed")]
    feeds = [told[n - 1][1] for n, e in enumerate(told) if e[0] == "straight_feed"]
    check(feeds == [3, 4, 5], told)

    # Ctrl-C ends what does not end by itself.
    def interrupt(*_):
        raise KeyboardInterrupt
    signal.signal(signal.SIGALRM, interrupt)
    open(d + "/endless.ngc", "w").write("o1 while [1]\n#1=[#1+1]\no1 endwhile\nM2\n")
    for endless in (lambda: gcode.load(d + "/endless.ngc"), lambda: gcode.parse(d + "/endless.ngc", Canon(d), "", "")):
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        try:
            check(False, f"an endless program ended: {endless()}")
        except KeyboardInterrupt:
            pass

    check(gcode.calc_extents([(1, (0,) * 9, (5,) + (0,) * 8, (0, 0, 1))],
                             [(2, (1, 2, 3) + (0,) * 6, (4, 4, 4) + (0,) * 6, 10., (1, 1, 1))]) ==
          ([0, 0, 0], [5, 4, 4], [0, 0, 1], [5, 5, 5]), "extents")
    check(gcode.MIN_ERROR == 3 and gcode.MAX_ERROR == -1, "constants")
done()
