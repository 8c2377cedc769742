#!/usr/bin/python3
# Draws each scene and compares it with kept/NAME.png.
import copy
import io
import os
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import gcode
import kerf_raster
import linuxcnc
import numpy as np
from PIL import Image, ImageFilter
from axis import drawn, reading, settings
from axis.compose import Composer
from kerf import gl
from kerf.glpath import Renderer

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent.parent
SIZE = 360, 270
TEXT_PX = 11
SHOWN = dict(show_program=True, show_rapids=True, program_alpha=False, show_live_plot=False, show_tool=True, show_extents=True,
             show_offsets=True, show_machine_limits=True, grid_size=0.0, highlight_line=-1, metric=1, coord_type=1, display_type=0,
             dro_large_font=False, cone_size=0.5, cone_scaling=True, min_tool_diameter=0.0)
ARCS = """G21 G90 F1000
G0 X0 Y0 Z0
G17 G2 X20 Y0 I10 J0
G18 G3 X40 Z0 I10 K0
G19 G2 Y20 Z0 J10 K0
G4 P1
M2
"""
NO_TOOL = SimpleNamespace(id=-1, diameter=0.0, frontangle=0.0, backangle=0.0, orientation=0)


def status(limits=100.0, **other):
    axis = dict(min_position_limit=-limits, max_position_limit=limits)
    values = dict(axis=[axis] * 9, tool_offset=[0.0] * 9, g5x_offset=[0.0] * 9, g92_offset=[0.0] * 9, g5x_index=1, rotation_xy=0.0,
                  position=[0.0] * 9, actual_position=[0.0] * 9, tool_in_spindle=0, tool_table=[NO_TOOL])
    return SimpleNamespace(**values | other)


def pose(*values):
    return [float(v) for v in values] + [0.0] * (9 - len(values))


def turning_tool(orientation):
    return SimpleNamespace(id=3, diameter=4.0, frontangle=95.0, backangle=155.0, orientation=orientation)


ARC_LINE = 3
SCENES = {  # name: (machine, program, view, status, options)
    "mill": ("mill", "bracket.ngc", "p", status(120.0), dict(highlight_line=58)),
    "arcs in every plane": ("mill", ARCS, "p", status(), dict(highlight_line=ARC_LINE, grid_size=10 / 25.4)),
    "from above beyond a limit": ("mill", ARCS, "z", status(30.0, actual_position=pose(10, 10, 5)), {}),
    "offset and rotation": ("mill", "G10 L2 P1 X30 Y10 R30\nG54\n" + ARCS, "z", status(g5x_offset=pose(30, 10), rotation_xy=30.0), dict(show_machine_limits=False)),
    "end mill": ("mill", ARCS, "p", status(tool_in_spindle=2, tool_table=[SimpleNamespace(id=2, diameter=8.0, frontangle=0, backangle=0, orientation=0)],
                                           actual_position=pose(20, 0, 10)), dict(program_alpha=True, show_machine_limits=False)),
    "program hidden": ("mill", ARCS, "p", status(), dict(show_program=False, show_machine_limits=False)),
    "lathe": ("lathe", "lathe_shaft.ngc", "y", status(300.0, tool_in_spindle=3, tool_table=[turning_tool(2)], actual_position=pose(30, 0, 5)),
              dict(show_machine_limits=False)),
    "foam": ("foam", "foam_wing.ngc", "p", status(500.0), dict(show_machine_limits=False)),
    "rotary": ("xyza", "rotary_engraving.ngc", "p", status(500.0, actual_position=pose(0, 0, 30, 45)), dict(show_machine_limits=False, geometry="XYZ!A")),
}


def draw(gl_library, name):
    machine, program, view, stat, options = SCENES[name]
    ini = str(TOP / "configs/sim" / machine / f"{machine}.ini")
    s = settings.read(linuxcnc.ini(ini))
    s.geometry = options.get("geometry", s.geometry)
    composer = Composer(s, SimpleNamespace(**SHOWN | options), text_px=TEXT_PX)
    composer.stat = stat
    with tempfile.TemporaryDirectory() as folder:
        path = TOP / "nc_files" / program
        if "\n" in program:
            path = Path(folder) / "program.ngc"
            path.write_text(program)
        tools = [(n, *[0.0] * 9, 6.0, 0.0, 0.0, 0) for n in range(20)]
        loaded = gcode.load(str(path), folder + "/var", ["G21", "G90"], tools=tools, axis_mask=s.axis_mask, linear_units=s.units_per_mm)
        if loaded.error:
            print(name, loaded.error)
        composer.set_program(reading.Program.of(loaded, 60.0), [reading.drawing(loaded, *place) for place in composer.places()])
    composer.camera.set_view("lathe" if s.lathe else view)
    composer.camera.fit(*composer.shown_box())
    composer.readout_lines, composer.marks = ["     X:   0.000", "     Y:   1.500"], [(True, False), (False, True)]
    overlaps(name, composer)
    matrix = composer.camera.matrix(*SIZE)
    composer.compose(*SIZE, matrix)
    composer.compose_live(*SIZE, matrix)
    renderer = Renderer(gl_library)
    renderer.resize(*SIZE)
    renderer.draw_still(composer.scene, matrix, TEXT_PX, exact=True)
    renderer.draw_frame(composer.scene, matrix)
    shown = Image.fromarray(renderer.pixels())
    in_memory(name, composer.scene, matrix, renderer)
    return shown


def in_memory(name, scene, matrix, renderer):
    """The lines of the scene as they are drawn without OpenGL, beside the same ones with it."""
    scene.labels, scene.texts, scene.panels, scene.live = [], [], [], [i for i in scene.live if not i.triangles]
    renderer.draw_still(scene, matrix, TEXT_PX, exact=True)
    renderer.draw_frame(scene, matrix)
    raster = kerf_raster.Raster(*SIZE)
    drawn.paint_still(raster, scene, matrix)
    drawn.paint(raster, scene.live, matrix)
    picture = Image.open(io.BytesIO(bytes(raster.ppm())))
    share = difference(picture, Image.fromarray(renderer.pixels()))
    if share >= 0.01:
        print(f"{name}: {100 * share:.2f} % of the pixels differ between OpenGL and the picture drawn in memory")
        picture.save("differs-drawn-" + name.replace(" ", "-") + ".png")


def overlaps(name, composer):
    """From all sides, also from far away: no label lies on another."""
    camera, (w, h) = composer.camera, SIZE
    before = copy.deepcopy(vars(camera))
    for turn in range(0 if composer.s.lathe else 24):
        camera.rotate(37, 11 if turn % 2 else -9)
        camera.size = before["size"] * (1 + turn % 3)
        composer.compose(w, h, camera.matrix(w, h))
        placed = [(x, y, text) for x, y, text, *_ in composer.scene.labels]
        for n, (x, y, text) in enumerate(placed):
            for ox, oy, other in placed[:n]:
                if abs(x - ox) < 0.6 * composer.text_px * (len(text) + len(other)) / 2 and abs(y - oy) < composer.text_px - 1:
                    print(f"{name}, turn {turn}: {text} lies on {other}")
    vars(camera).update(before)


def difference(a, b):
    """Part of the pixels that differ visibly after a slight blur: a line may lie a pixel beside."""
    a, b = (np.asarray(x.convert("RGB").filter(ImageFilter.GaussianBlur(2)), int) for x in (a, b))
    return float((np.abs(a - b).max(axis=2) > 24).mean())


def main(write):
    with gl.OffScreen(*SIZE) as off:
        for name in SCENES:
            picture = draw(off.gl, name)
            kept = HERE / "kept" / (name.replace(" ", "-") + ".png")
            if write:
                picture.quantize(64).save(kept, optimize=True)
                continue
            share = difference(picture, Image.open(kept))
            print(f"{name}: {'agrees' if share < 0.01 else f'{100 * share:.2f} % of the pixels differ from {kept}'}")
            if share >= 0.01:
                picture.save("differs-" + kept.name)


main(sys.argv[1:] == ["write"])
os._exit(0)
