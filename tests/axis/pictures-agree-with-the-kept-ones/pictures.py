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
from PIL import Image
from axis import drawn, reading, settings
from axis.compose import Composer
from kerf import gl
from kerf.glpath import Renderer
from scenes import SCENES, SHOWN, WRONG

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent.parent
SIZE, TILE = (360, 270), (180, 135)
TEXT_PX = 11
BESIDE_PX, LIKE = 2, 48          # how far a line may be drawn beside, how much its colour may differ
MOST_PX, MOST_DRAWN_PX = 20, 200     # pixels that may differ; without OpenGL lines lie one over the other as they come


def composed(name, scene, size):
    """A composer with the scene, and the matrix."""
    machine, program, view, stat, options = scene
    ini = str(TOP / "configs/sim" / machine / f"{machine}.ini")
    s = settings.read(linuxcnc.ini(ini))
    s.geometry, s.coordinates = options.get("geometry", s.geometry), options.get("coordinates", s.coordinates)
    composer = Composer(s, SimpleNamespace(**SHOWN | options), text_px=TEXT_PX)
    composer.stat = stat
    composer.colours.update(options.get("colours", {}))
    with tempfile.TemporaryDirectory() as folder:
        path = TOP / "nc_files" / program
        if "\n" in program:
            path = Path(folder) / "program.ngc"
            path.write_text(program)
        tools = [(n, *[0.0] * 9, 6.0, 0.0, 0.0, 0) for n in range(20)]
        loaded = gcode.load(str(path), folder + "/var", ["G21", "G90"], tools=tools, linear_units=s.units_per_mm,
                            axis_mask=0x1ff if "coordinates" in options else s.axis_mask)
        if loaded.error:
            print(name, loaded.error)
        drawings = [reading.drawing(loaded, *place) for place in composer.places()]
        composer.set_program(reading.Program.of(loaded, 60.0), drawings)
    composer.camera.set_view("lathe" if s.lathe else view)
    composer.camera.fit(*composer.shown_box())
    if "size" in options:
        composer.camera.size = options["size"]
        if composer.program.n_moves == 0:
            composer.camera.centre = [0.0, 0.0, 0.0]
    if size == SIZE:
        composer.readout_lines, composer.marks = ["     X:   0.000", "     Y:   1.500"], [(True, False), (False, True)]
        overlaps(name, composer)
    matrix = composer.camera.matrix(*size)
    composer.compose(*size, matrix)
    composer.compose_live(*size, matrix)
    return composer, matrix


def draw(gl_library, name, scene):
    if isinstance(scene, list):
        tiles = [draw_one(gl_library, f"{name}, {n}", tile, TILE) for n, tile in enumerate(scene)]
        columns = min(3, len(tiles))
        picture = Image.new("RGB", (TILE[0] * columns, TILE[1] * -(-len(tiles) // columns)))
        for n, tile in enumerate(tiles):
            picture.paste(tile, (n % columns * TILE[0], n // columns * TILE[1]))
        return picture
    return draw_one(gl_library, name, scene, SIZE)


def draw_one(gl_library, name, scene, size):
    composer, matrix = composed(name, scene, size)
    renderer = Renderer(gl_library)
    renderer.resize(*size)
    renderer.draw_still(composer.scene, matrix, TEXT_PX, exact=True)
    renderer.draw_frame(composer.scene, matrix)
    shown = Image.fromarray(renderer.pixels())
    in_memory(name, composer.scene, matrix, renderer, size)
    return shown


def in_memory(name, scene, matrix, renderer, size):
    """The lines of the scene as they are drawn without OpenGL, beside the same ones with it."""
    scene.labels, scene.texts, scene.panels = [], [], []
    scene.live = [i for i in scene.live if not i.triangles]
    renderer.draw_still(scene, matrix, TEXT_PX, exact=True)
    renderer.draw_frame(scene, matrix)
    raster = kerf_raster.Raster(*size)
    drawn.paint_still(raster, scene, matrix)
    drawn.paint(raster, scene.live, matrix)
    picture = Image.open(io.BytesIO(bytes(raster.ppm())))
    count = difference(picture, Image.fromarray(renderer.pixels()))
    if count > MOST_DRAWN_PX:
        print(f"{name}: {count} pixels differ between OpenGL and the picture drawn in memory")
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
                wide = 0.6 * composer.text_px * (len(text) + len(other)) / 2
                if abs(x - ox) < wide and abs(y - oy) < composer.text_px - 1:
                    print(f"{name}, turn {turn}: {text} lies on {other}")
    vars(camera).update(before)


def difference(a, b):
    """Pixels of each picture that have none of about their colour in the other one, two pixels around: a driver may
    draw a line a little beside."""
    a, b = (np.asarray(x.convert("RGB"), int) for x in (a, b))
    return max(int(unmatched(a, b).sum()), int(unmatched(b, a).sum()))


def unmatched(a, b):
    """Where a pixel of a has nothing like it in b."""
    h, w, _ = a.shape
    around = np.pad(b, ((BESIDE_PX, BESIDE_PX), (BESIDE_PX, BESIDE_PX), (0, 0)), mode="edge")
    least = np.full((h, w), 255)
    for y in range(2 * BESIDE_PX + 1):
        for x in range(2 * BESIDE_PX + 1):
            least = np.minimum(least, np.abs(a - around[y:y + h, x:x + w]).max(axis=2))
    return least > LIKE


def main(write):
    with gl.OffScreen(*SIZE) as off:
        for name, scene in SCENES.items():
            picture = draw(off.gl, name, scene)
            kept = HERE / "kept" / (name.replace(" ", "-") + ".png")
            if write:
                picture.quantize(128).save(kept, optimize=True)
                continue
            count = difference(picture, Image.open(kept))
            print(f"{name}: {'agrees' if count <= MOST_PX else f'{count} pixels differ from {kept}'}")
            if count > MOST_PX:
                picture.save("differs-" + kept.name)
        for what, name, scene in [] if write else WRONG:
            count = difference(draw(off.gl, what, scene), Image.open(HERE / "kept" / (name.replace(" ", "-") + ".png")))
            print(f"{what}: {'is seen' if count > 2 * MOST_PX else f'only {count} pixels differ'}")


main(sys.argv[1:] == ["write"])
os._exit(0)
