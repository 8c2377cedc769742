# SPDX-License-Identifier: GPL-2.0-or-later
"""What is drawn: name: (machine, program, view, status, options), or a list of such for one picture of many tiles."""
from types import SimpleNamespace

SHOWN = dict(show_program=True, show_rapids=True, program_alpha=False, show_live_plot=False, show_tool=True,
             show_extents=True, show_offsets=True, show_machine_limits=True, grid_size=0.0, highlight_line=-1, metric=1,
             coord_type=1, display_type=0, dro_large_font=False, cone_size=0.5, cone_scaling=True,
             min_tool_diameter=0.0)
BARE = dict(show_extents=False, show_machine_limits=False, show_offsets=False)
ARCS = """G21 G90 F1000
G0 X0 Y0 Z0
G17 G2 X20 Y0 I10 J0
G18 G3 X40 Z0 I10 K0
G19 G2 Y20 Z0 J10 K0
G4 P1
M2
"""
SQUARE = "G21 G90 F1000\nG0 X0 Y0\nG1 X30\nY20\nG0 X0\nG1 Y0\nM2\n"
MARKS = "G21 G90 F1000\nG1 X1 Y1 Z1\nG4 P1\nX2\nM101\nG18\nX3\nG4 P1\nX4\nM102\nG19\nX5\nG4 P1\nX6\nM103\nM2\n"
TURNED = "G21 G90 F1000\nG0 X0 Y10 Z0\nG1 X20\nG1 {0}90 X25\nG1 Z10\nG1 {0}180\nM2\n"
PLANES = "G21 G90 F1000\n(AXIS,XY_Z_POS,-20)\n(AXIS,UV_Z_POS,30)\nG1 X10 U20\nY10 V5\nX0 U0\nY0 V0\nM2\n"
SHIFTED = "G10 L2 P1 X10 Y5 R{1}\nG54\nG0 X0 Y0\nG92 X{0} Y0\n" + SQUARE
NO_TOOL = SimpleNamespace(id=-1, diameter=0.0, frontangle=0.0, backangle=0.0, orientation=0)
AXIS_LIMITS = dict(min_position_limit=-100.0, max_position_limit=100.0)


def status(limits=100.0, **other):
    axis = dict(min_position_limit=-limits, max_position_limit=limits)
    values = dict(axis=[axis] * 9, tool_offset=[0.0] * 9, g5x_offset=[0.0] * 9, g92_offset=[0.0] * 9, g5x_index=1,
                  rotation_xy=0.0, position=[0.0] * 9, actual_position=[0.0] * 9, tool_in_spindle=0,
                  tool_table=[NO_TOOL])
    return SimpleNamespace(**values | other)


def pose(*values):
    return [float(v) for v in values] + [0.0] * (9 - len(values))


def tool(diameter, **other):
    """Status with a tool in the spindle."""
    entry = SimpleNamespace(id=3, diameter=diameter, **dict(frontangle=95.0, backangle=155.0, orientation=0) | other)
    return dict(tool_in_spindle=3, tool_table=[entry])


def shifted(x, degrees):
    """A work offset, G92 and a rotation."""
    offsets = status(g5x_offset=pose(10, 5), g92_offset=pose(-x, 0), rotation_xy=degrees)
    return "mill", SHIFTED.format(x, degrees), "z", offsets, dict(show_machine_limits=False, show_tool=False)


def limits(*pairs):
    return [dict(min_position_limit=a, max_position_limit=b) for a, b in pairs] + [AXIS_LIMITS] * 6


def lathe_tool(orientation, size=0.9, **other):
    return "lathe", "M2\n", "y", status(**tool(4.0, orientation=orientation, **other)), dict(BARE, size=size)


def cone(program="M2\n", machine="mill", size=6.0, stat=status(), **options):
    return machine, program, "y", stat, dict(BARE, size=size, **options)


def boxed(z, length):
    stat = status(axis=limits((-10, 40), (-20, 30), z), tool_offset=pose(0, 0, length))
    return "mill", SQUARE, "p", stat, dict(BARE, show_machine_limits=True)


def turning(axis, geometry):
    return "xyza", TURNED.format(axis), "p", status(), dict(BARE, geometry=geometry, coordinates="XYZABC")


HIDDEN = dict(show_machine_limits=False)
LONG = "G21\nG1 X200 F1\nM2\n"
ROTATED = status(g5x_offset=pose(30, 10), rotation_xy=30.0)
SCENES = {
    "mill": ("mill", "bracket.ngc", "p", status(120.0), dict(highlight_line=58)),
    "arcs in every plane": ("mill", ARCS, "p", status(), dict(highlight_line=3, grid_size=10 / 25.4)),
    "from above beyond a limit": ("mill", ARCS, "z", status(30.0, actual_position=pose(10, 10, 5)), {}),
    "offset and rotation": ("mill", "G10 L2 P1 X30 Y10 R30\nG54\n" + ARCS, "z", ROTATED, HIDDEN),
    "end mill": ("mill", ARCS, "p", status(actual_position=pose(20, 0, 10), **tool(8.0)),
                 dict(program_alpha=True, **HIDDEN)),
    "program hidden": ("mill", ARCS, "p", status(), dict(show_program=False, **HIDDEN)),
    "lathe": ("lathe", "lathe_shaft.ngc", "y", status(actual_position=pose(30, 0, 5), **tool(4.0, orientation=2)),
              HIDDEN),
    "foam": ("foam", "foam_wing.ngc", "p", status(500.0), HIDDEN),
    "rotary": ("xyza", "rotary_engraving.ngc", "p", status(500.0, actual_position=pose(0, 0, 30, 45)),
               dict(geometry="XYZ!A", **HIDDEN)),
    # orientation 0 draws nothing on a lathe
    "lathe tools 1 to 9 and 0": [lathe_tool(n) for n in (*range(1, 10), 0)],
    "angles of a lathe tool": [lathe_tool(2, frontangle=f, backangle=b)
                               for f, b in ((95, 155), (155, 95), (30, 60), (0, 0), (-40, 40))],
    # by the program's size, [DISPLAY]CONE_BASESIZE, without scaling; tools about as thick as the least one; on lathes
    "cones": [cone(), cone(LONG), cone(cone_size=1.5), cone(LONG, cone_scaling=False),
              *(cone(stat=status(**tool(d)), min_tool_diameter=5.0) for d in (5.0, 5.1)),
              *(cone(machine="lathe", size=2.0, stat=status(rotation_xy=r)) for r in (0.0, 180.0))],
    "grid in each view": [("mill", SQUARE, view, status(rotation_xy=20.0 if view == "z" else 0.0),
                           dict(BARE, grid_size=10 / 25.4)) for view in ("z", "z2", "x", "y", "y2", "p")],
    "box of the limits": [boxed((-30, 0), 0), boxed((-30, 0), 20), boxed((-30, 1e99), 0)],
    "labels at each limit": [("mill", SQUARE, "z", status(axis=limits(x, y, (-9, 9))), {}) for x, y in (
        ((0, 30), (0, 20)), ((1, 30), (0, 20)), ((0, 29), (0, 20)), ((0, 30), (0, 19)), ((0, 30), (1, 20)))],
    "offset lines": [shifted(0, 0), shifted(5, 0), shifted(5, 25), shifted(-8, -60)],
    "dwells and user codes": [("mill", MARKS, view, status(), dict(BARE, size=0.2, show_tool=False))
                              for view in ("z", "y", "x", "p")],
    "rotary axes by geometry": [turning(*t) for t in (("A", "XYZA"), ("A", "XYZ!A"), ("A", "XYZ!-A"), ("B", "XYZ!B"),
                                                      ("C", "XYZ!C"), ("A", "-XYZ!A"))],
    "planes of a foam cutter": [("foam", PLANES, view, status(actual_position=[5, 5, 0, 0, 0, 0, 10, 2, 0]),
                                 dict(HIDDEN, program_alpha=alpha))
                                for view, alpha in (("p", False), ("z", True), ("y", False))],
}


def arcs(old="", new="", **colours):
    machine, program, view, stat, options = SCENES["arcs in every plane"]
    return machine, program.replace(old, new), view, stat, dict(options, colours=colours)


def instead(name, n, scene):
    """The tiles of a picture with another n-th one."""
    return [scene if k == n else tile for k, tile in enumerate(SCENES[name])]


# (what is wrong, the picture that must tell it, scene)
WRONG = [
    ("an arc the other way round", "arcs in every plane", arcs("G17 G2", "G17 G3")),
    ("an arc of another plane", "arcs in every plane", arcs("G3 X40", "G2 X40")),
    ("another colour of arcs", "arcs in every plane", arcs(arc_feed="#ffc0ff")),
    ("an offset that is 2 mm beside", "offset lines", instead("offset lines", 0, shifted(2, 0))),
    ("a rotation the other way round", "offset lines", instead("offset lines", 3, shifted(-8, 60))),
    ("another lathe tool", "lathe tools 1 to 9 and 0", instead("lathe tools 1 to 9 and 0", 0, lathe_tool(2))),
    ("a label that is not red", "labels at each limit",
     instead("labels at each limit", 1, SCENES["labels at each limit"][0])),
    ("a rotary axis the other way round", "rotary axes by geometry",
     instead("rotary axes by geometry", 1, turning("A", "XYZ!-A"))),
]
