#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Vismach: every transform and primitive, files, texts, the trace of the tool, mouse, and a program of a user."""

from __future__ import annotations

import math
import os
import struct
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "../../components")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("vismach")
os.environ.update(session.env)
sys.path.insert(0, str(TOP / "lib/python"))
import numpy as np  # noqa: E402
import vismach as v  # noqa: E402
from OpenGL import GL  # noqa: E402
from vismach import parts  # noqa: E402
from vismach.view import MAX_TRACE, View  # noqa: E402

mistakes: list[str] = []


def check(what: str, got: object, want: object) -> None:
    same = np.allclose(got, want, atol=2e-4) if isinstance(want, np.ndarray) else got == want
    if not same:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def turn(th: float, axis: int) -> np.ndarray:
    c, s = math.cos(math.radians(th)), math.sin(math.radians(th))
    m = np.identity(4)
    a, b = [n for n in range(3) if n != axis]
    m[a, a] = m[b, b] = c
    m[a, b], m[b, a] = (-s, s) if axis != 1 else (s, -s)
    return m


def move(x: float, y: float, z: float) -> np.ndarray:
    m = np.identity(4)
    m[:3, 3] = x, y, z
    return m


def size(x: float, y: float, z: float) -> np.ndarray:
    return np.diag((x, y, z, 1.0))


class Bench:
    """A view of whatever model a check puts in."""

    def __init__(self) -> None:
        self.comp = v.hal.component("vm")
        for name in ("x", "y", "z", "a", "b", "c"):
            self.comp.newpin(name, v.hal.HAL_FLOAT, v.hal.HAL_IN)
        self.comp.newpin("order", v.hal.HAL_S32, v.hal.HAL_IN)
        self.comp.newpin("on", v.hal.HAL_BIT, v.hal.HAL_IN)
        self.comp.ready()
        self.root = v.tkinter.Tk()
        self.root.geometry("400x400+0+0")
        self.base = v.Capture()
        self.view = View(self.root, v.Collection([]), v.Capture(), v.Capture(), 10, v.Hud(), -90, 0)
        self.root.update()

    def draw(self, *parts) -> None:
        self.view.model = v.Collection([self.base, *parts])
        self.root.update()
        self.view.redraw()

    @staticmethod
    def view_errors() -> str:
        """What was told of parts that failed, since the last look."""
        told = "; ".join(sorted(parts.told))
        parts.told.clear()
        return told

    def where(self, make) -> np.ndarray:
        """The matrix inside a transform, made by make([part])."""
        inner = v.Capture()
        self.draw(make([inner]))
        return np.linalg.inv(self.base.t) @ inner.t

    def pixels(self, x: int, y: int, width: int, height: int) -> bytes:
        """Of the buffer that was drawn before; from the lower left."""
        self.view.paint(400, 400)
        v.glFinish()
        return bytes(v.glReadPixels(x, y, width, height, v.GL_RGB, v.GL_UNSIGNED_BYTE))

    def pixel(self, x: int, y: int) -> tuple[int, int, int]:
        return tuple(self.pixels(x, y, 1, 1))


def transforms(b: Bench) -> None:
    c = b.comp
    for name, value in zip("xyzabc", (2.0, 3.0, -4.0, 30.0, 40.0, 50.0)):
        c[name] = value
    c["order"] = 321
    x, y, z = (turn, 0), (turn, 1), (turn, 2)
    euler = {"1": 0, "2": 1, "3": 2}
    cases = [
        ("Translate", lambda p: v.Translate(p, 1, 2, 3), move(1, 2, 3)),
        ("Rotate", lambda p: v.Rotate(p, 25, 0, 1, 0), turn(25, 1)),
        ("Scale", lambda p: v.Scale(p, 1, 2, 3), size(1, 2, 3)),
        ("HalTranslate", lambda p: v.HalTranslate(p, c, "x", 1, 0, -1), move(2, 0, -2)),
        ("HalRotate", lambda p: v.HalRotate(p, c, "a", 2, 0, 0, 1), turn(60, 2)),
        ("HalVectorTranslate", lambda p: v.HalVectorTranslate(p, c, "x", 0, "z", 10), move(20, 0, -40)),
        ("HalVectorRotate", lambda p: v.HalVectorRotate(p, c, "a", -1, 1, 0, 0), turn(-30, 0)),
        ("HalScale", lambda p: v.HalScale(p, c, 1, 2, 3, "x"), size(2, 4, 6)),
        ("HalShow off", lambda p: v.HalShow(p, c, True, "on", 1, 0.25), size(.25, .25, .25)),
        ("HalShow on", lambda p: v.HalShow(p, c, False, "on", 3, 0), size(3, 3, 3)),
        ("nested", lambda p: v.Translate([v.Rotate(p, 90, 0, 0, 1)], 5, 0, 0), move(5, 0, 0) @ turn(90, 2)),
        ("pin as order", lambda p: v.HalRotateEuler(p, c, "a", 40, "c", "order"),
         turn(30, 2) @ turn(40, 1) @ turn(50, 0))]
    for order in v.HalRotateEuler.ORDERS:
        want = np.identity(4)
        for angle, digit in zip((30, 40, 50), str(order)):
            want = want @ turn(angle, euler[digit])
        cases.append((f"Euler {order}", lambda p, order=order: v.HalRotateEuler(p, c, "a", "b", "c", order), want))
    for what, make, want in cases:
        check(what, b.where(make), want)
    inner, position, target = v.Capture(), v.Capture(), v.Capture()
    tracked = v.Track([inner], position, target, b.base)
    b.draw(v.Translate([position], 1, 2, 3), v.Translate([target], 4, -2, 3 + 12), tracked)
    b.draw(v.Translate([position], 1, 2, 3), v.Translate([target], 4, -2, 3 + 12), tracked)
    m = np.linalg.inv(b.base.t) @ inner.t
    check("Track", np.array([*m[:3, 3], *m[:3, 2]]), np.array([1, 2, 3, 3 / 13, -4 / 13, 12 / 13]))
    check("invert", v.invert(move(1, 2, 3) @ turn(33, 1)) @ move(1, 2, 3) @ turn(33, 1), np.identity(4))

    class Own(v.HalVectorRotate):
        def get_values(self):
            return 1, 0, 1, 0
    check("get_values", b.where(lambda p: Own(p, c, "a", 9, 9, 9, 9)), turn(30, 1))
    calls = []

    class Part:
        def __getattr__(self, name):
            if name.startswith("__"):
                raise AttributeError(name)
            return lambda: calls.append(name)
    parts.visit(Part())
    check("order of a part's methods", calls, ["apply", "capture", "draw", "traverse", "unapply"])


def shapes(b: Bench) -> None:
    c = b.comp
    c["x"], c["y"] = 2.0, 0.5
    pi = math.pi
    for shape, volume in ((v.Box(0, 0, 0, 1, 2, 3), 6), (v.Box(c, 0, 0, 0, "x", 1, -1), 2),
                          (v.BoxCentered(2, 3, 4), 24), (v.BoxCenteredXY(2, 2, 5), 20),
                          (v.CylinderX(0, 1, 3, 1), 3 * pi), (v.CylinderY(0, 1, -3, 1), 3 * pi),
                          (v.CylinderZ(c, 0, "y", "x", 0), pi * .25 * 2 / 3), (v.Sphere(1, 2, 3, 2), 4 / 3 * pi * 8),
                          (v.TriangleXY(0, 0, 2, 0, 0, 2, 0, 3), 6), (v.TriangleXZ(0, 0, 2, 0, 0, 2, 1, 3), 4),
                          (v.TriangleYZ(0, 0, 2, 0, 0, 2, 1, 2), 2), (v.ArcX(0, 1, 1, 2, 0, 90, 64), pi / 4 * 3)):
        name = type(shape).__name__
        check(f"volume() of {name}", round(shape.volume(), 9), round(volume, 9))
        b.draw(shape)
        points, normals = shape.body.arrays
        # the surface is closed and faces outwards: its volume by the divergence theorem
        t = points.reshape(-1, 3, 3)
        solid = np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6
        check(f"surface of {name}", abs(solid - volume) < 0.02 * volume, True)
        check(f"normals of {name}",
              np.allclose(np.linalg.norm(normals, axis=1), 1, atol=0.2 if "Cyl" in name else 1e-6), True)
    group = v.Collection([v.Box(0, 0, 0, 1, 1, 1), v.Capture(), v.Collection([v.Box(0, 0, 0, 2, 1, 1)])])
    check("volume of a group", group.volume(), 3)
    group.set_volume(7)
    check("set_volume", group.volume(), 7)
    for words, part in (((), "were given"), ((1, 2, 3), "were given"),
                        (("x", 0, 0, 1, 1, 1), "names of pins need the component")):
        try:
            v.Box(*words)
            mistakes.append(f"Box{words} accepted")
        except TypeError as error:
            if part not in str(error):
                mistakes.append(str(error))
    class Listed:
        """A user's own display list of our shapes."""
        number = None

        def draw(self):
            if self.number is None:
                self.number = GL.glGenLists(1)
                GL.glNewList(self.number, GL.GL_COMPILE)
                v.Box(-5, -5, -5, 5, 5, 5).draw()
                GL.glEndList()
            GL.glCallList(self.number)
    b.draw()
    ground = b.pixels(200, 200, 1, 1)
    for _ in range(2):
        b.draw(Listed())
        check("a shape in a user's display list is drawn", b.pixels(200, 200, 1, 1) != ground, True)

    class Tool(v.CylinderZ):
        """As scripts of users have it."""

        def __init__(self, comp, *args):
            v.CylinderZ.__init__(self, *args)
            self.comp = comp

        def coords(self):
            return -self.comp["x"], 0, 0, self.comp["y"]
    own = Tool(c)
    b.draw(own)
    check("coords() of a subclass",
          (own.body.arrays[0].min(axis=0).round(6).tolist(), own.body.arrays[0].max(axis=0).round(6).tolist()),
          ([-.5, -.5, -2], [.5, .5, 0]))

    class OtherTool(Tool):
        """The component first, then the shape's own start."""

        def __init__(self, comp):
            self.comp = comp
            v.CylinderZ.__init__(self)
    b.draw(OtherTool(c))
    check("a component that was there before", b.view_errors(), "")
    # a red box in the middle hides what is behind, and moves with its pin
    c["x"] = 0.0
    red = v.HalTranslate([v.Color((1, 0, 0, 1), [v.BoxCentered(4, 4, 4)])], c, "x", 1, 0, 0)
    b.draw(v.Color((0, 1, 0, 1), [v.Translate([v.BoxCentered(4, 4, 4)], 0, 10, 0)]), red,
           v.Translate([v.BoxCentered(1, 1, 1)], 0, 0, -6))
    r, g, _ = b.pixel(200, 200)
    check("red before green", (r > 100, g < 50), (True, True))
    r, g, blue = b.pixel(200, 50)
    check("no colour of another", r == g == blue and r > 60, True)
    c["x"] = 6.0
    r, g, _ = b.pixel(200, 200)
    check("moved away", (r < 50, g > 100), (True, True))
    c["x"] = 0.0


def light(b: Bench) -> None:
    """Every side of a dark part stands out against the background."""
    camera, dark = b.view.camera, v.Color((.2, .3, .4, 1), [v.BoxCentered(6, 6, 6)])
    before = camera.lat, camera.lon
    for camera.lon in range(0, 360, 30):
        for camera.lat in (-150, -120, -60, -30):
            b.draw(dark)
            seen = np.frombuffer(b.pixels(0, 200, 400, 1), dtype=np.uint8).reshape(-1, 3).astype(int)
            away = np.abs(seen - seen[0]).sum(axis=1)[135:266]
            if away.min() < 15:
                mistakes.append(f"lat {camera.lat}, lon {camera.lon}: a side is as dark as the background: {seen[200]}")
    camera.lat, camera.lon = before


def files(b: Bench, folder: str) -> None:
    stl = "solid a\n facet normal 0 0 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\n endfacet\nendsolid\n"
    path = Path(folder, "a.stl")
    path.write_text(stl)
    for part in (v.AsciiSTL(filename=str(path)), v.AsciiSTL(data=stl), v.AsciiSTL(data=stl.splitlines())):
        check("STL", part.body.arrays[1], np.array([[0, 0, 1]] * 3))
        b.draw(part)
    obj = v.AsciiOBJ(data="# x\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvn 0 -1 0\nvt 0 0\nf 1//1 2//1 3//1\nf -3 -2 -1\n")
    check("OBJ", obj.body.arrays[1], np.array([[0, -1, 0]] * 6))
    b.draw(obj)
    square = v.AsciiOBJ(data="v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n")
    check("OBJ: a face of four corners", sorted(map(tuple, square.body.arrays[0][:, :2])),
          [(0, 0), (0, 0), (0, 1), (2, 0), (2, 1), (2, 1)])
    Path(folder, "b.stl").write_bytes(b"solid \0 by a CAD program".ljust(80) + struct.pack("<I12fH", 1, *range(12), 0))
    b.view_errors()
    b.draw(v.AsciiSTL(filename=str(Path(folder, "b.stl"))))
    check("a binary file is told", "b.stl: no triangles" in b.view_errors(), True)
    for kind, text, part in ((v.AsciiSTL, "facet normal 0 0 1\nvertex 0 x 0\n",
                              "data:2: 'vertex 0 x 0' cannot be read"),
                             (v.AsciiSTL, "vertex 0 0 0\n", "no three corners"),
                             (v.AsciiOBJ, "v 0 0 0\nf 1 2 3\n", "data:2")):
        try:
            kind(data=text)
            mistakes.append(f"accepted {text!r}")
        except ValueError as error:
            if part not in str(error):
                mistakes.append(str(error))


def guides(b: Bench) -> None:
    c = b.comp
    c["a"] = c["b"] = 0.0
    for part in (v.HalLine(c, "x", 0, 0, "a", "b", 0, 50), v.HalPlaneFromNormal(c, 0, 0, 0, "a", "b", 0),
                 v.HalGridFromNormal(c, 0, 0, 0, 0, 0, 0),
                 v.HalCoordsFromNormalAndDirection(c, 0, 0, 0, "a", 0, 0, 0, 0, "b", 10),
                 v.HalGridFromNormalAndDirection(c, 0, 0, 0, 1, 0, 0, 1, 0, 0),
                 v.HalGrid(c)):
        b.draw(part)            # vectors without direction draw nothing and do no harm
        c["a"], c["b"] = 1.0, 1.0
        b.draw(part)
        c["a"], c["b"] = 0.0, 0.0
    check("no OpenGL error", v.glGetError(), 0)
    c["a"] = 1.0
    b.draw(v.Color((0, 0, 1, 1), [v.HalPlaneFromNormal(c, 0, 0, 0, 0, "a", 0, 3)]))
    check("plane across the view", b.pixel(200, 200)[2] > 60, True)
    b.draw(v.Color((1, 1, 1, 1), [v.HalLine(c, 0, 0, -2, 0, 0, "a", 4, 1)]))
    check("line", b.pixel(200, 200)[0] > 60, True)


def texts(b: Bench) -> None:
    c, hud = b.comp, v.Hud()
    c["x"], c["order"], c["on"] = 12.5, 1, False
    hud.strs.append("first")
    hud.show("always\non two lines")
    hud.add_pin("X {:.2f}", "vm.x")
    hud.add_txt("one", 1)
    hud.add_txt("two", [2, 3])
    hud.add_txt("lamp", "lamp")
    hud.show_tags_in_pin("vm.order", 0)
    hud.show_tag_if_same("lamp", "vm.on")
    check("texts", hud.texts(), ["first", "always", "on two lines", "X 12.50", "one"])
    c["order"], c["on"] = 3, True
    check("tags", hud.texts(), ["first", "always", "on two lines", "X 12.50", "two", "lamp"])
    hud.hide_all("vm.on", True)
    check("hidden", hud.texts(), [])
    c["on"] = False
    hud.set_hud_rgba(1, 0, 0, 1)
    hud.set_hud_text_rgb(1, 1, 1)
    b.view.hud = hud
    b.draw()
    check("box at the upper left", b.pixel(2, 398), (255, 0, 0))
    hud.add_pin("{:d} of a float", "vm.x")
    b.draw(v.Color((0, 0, 1, 1), [v.BoxCentered(4, 4, 4)]))
    check("a format that does not fit its pin", (hud.texts()[-1], b.pixel(200, 200)[2] > 60), ("{:d} of a float", True))
    check("is told", "{:d} of a float" in b.view_errors(), True)
    few = b.pixels(0, 360, 100, 40)
    hud.add_txt("\n".join("more" for _ in range(100)))
    check("the first lines of more than the window has room for", b.pixels(0, 360, 100, 40) == few, True)
    hud.hide()
    check("hide", (hud.texts(), b.pixel(2, 398) == (255, 0, 0)), ([], False))
    b.view.hud = v.Hud()


def trace(b: Bench) -> None:
    c, view = b.comp, b.view
    view.trace.clear()
    view.tool, view.work = v.Capture(), v.Capture()
    for n in range(5):
        c["x"], c["a"] = n / 2, 30.0 * n
        b.draw(v.HalTranslate([view.tool], c, "x", 1, 0, 0),
               v.HalRotate([v.Translate([view.work], 0, 1, 0)], c, "a", 1, 0, 0, 1))
        b.draw(*view.model.parts[1:])
    want = [(move(0, -1, 0) @ turn(-30.0 * n, 2) @ (n / 2, 0, 0, 1))[:3] for n in range(5)]
    check("trace in the frame of the work", np.array(view.trace.points), np.array(want))
    count = len(view.trace.points)
    b.view.camera.rotate(40, 15)
    b.draw(*view.model.parts[1:])
    check("a turn of the view is no motion", len(view.trace.points), count)
    for n in range(MAX_TRACE + 10):
        view.tool.t = move(n * 0.01, 0, 0)
        view.work.t = np.identity(4)
        view.trace.add(view.tool, view.work)
    check("the oldest points go", (len(view.trace.points) <= MAX_TRACE, round(view.trace.points[-1][0], 2)),
          (True, round((MAX_TRACE + 9) * .01, 2)))


def directions(b: Bench) -> None:
    """What lat and lon of main() show: 0 looks down along z, x to the right; lat -90 has z up; lon turns about z."""
    camera = b.view.camera
    before = camera.lat, camera.lon
    for lat, lon, place, x, y in ((0, 0, (4, 0, 0), 300, 200), (0, 0, (0, 4, 0), 200, 300),
                                  (-90, 0, (0, 0, 4), 200, 300), (-90, 0, (4, 0, 0), 300, 200),
                                  (0, 90, (4, 0, 0), 200, 300), (-90, 90, (0, -4, 0), 300, 200)):
        camera.lat, camera.lon = lat, lon
        b.draw(v.Translate([v.BoxCentered(1, 1, 1)], *place))
        check(f"{place} at lat {lat}, lon {lon} is seen", max(b.pixel(x, y)) > 60, True)
    camera.lat, camera.lon = before


def mouse(b: Bench) -> None:
    camera, frame = b.view.camera, b.view.frame

    def drag(button: int, state: int = 0) -> None:
        frame.event_generate(f"<ButtonPress-{button}>", x=100, y=100)
        frame.event_generate("<Motion>", x=140, y=80, state=state | 128 << button)
        frame.event_generate(f"<ButtonRelease-{button}>", x=140, y=80)
        b.root.update()

    def now() -> tuple:
        return (round(camera.lat, 3), round(camera.lon, 3), round(camera.pan_x, 3), round(camera.pan_y, 3),
                round(camera.zoom, 4))
    camera.lat = camera.lon = 0
    drag(1)
    check("left drag pans", (now()[:2], camera.pan_x > 0, camera.pan_y > 0), ((0, 0), True, True))
    drag(2)
    check("middle drag rotates", now()[:2], (-10.0, 20.0))
    drag(1, 1)
    check("shift and left rotate", now()[:2], (-20.0, 40.0))
    drag(3)
    check("right drag zooms", camera.zoom > 1, True)
    zoom = camera.zoom
    drag(1, 4)
    check("control and left zoom", camera.zoom > zoom, True)
    zoom = camera.zoom
    frame.event_generate("<Button-5>")
    b.root.update()
    check("wheel", camera.zoom < zoom, True)
    for _ in range(200):
        camera.rotate(0, 100)
        camera.change_zoom(2)
    check("limits", (camera.lat, camera.zoom <= 50), (180, True))


SCRIPT = """#!/usr/bin/python3
from vismach import *
c = hal.component("mine")
c.newpin("x", hal.HAL_FLOAT, hal.HAL_IN)
c.ready()
tool, work = Capture(), Capture()
model = Collection([HalTranslate([Color([1, 0, 0, 1], [CylinderZ(0, 1, 3, 1)]), tool], c, "x", 1, 0, 0), work])
main(model, tool, work, size=10, hud=Hud(), lat=-75, lon=215)
"""


def program(folder: str) -> None:
    path = Path(folder, "mine")
    path.write_text(SCRIPT)
    path.chmod(0o755)
    session.env["PYTHONPATH"] = str(TOP / "lib/python")
    commands = Path(folder, "commands.hal")
    commands.write_text(f"loadusr -W {path}\n")
    status, _, errors = session.command(folder, "halcmd", "-f", str(commands))
    if status:
        mistakes.append(errors)
    for _ in range(600):
        if "vismach.plotclear" in session.command(folder, "halcmd", "-s", "show", "pin")[1]:
            break
    else:
        mistakes.append("no pin vismach.plotclear")
    session.command(folder, "halcmd", "setp", "vismach.plotclear", "1")
    other = Path(folder, "mine2")
    other.write_text(SCRIPT.replace('"mine"', '"mine2"'))
    other.chmod(0o755)
    status, _, errors = session.command(folder, str(other))
    if status != 1 or "only one can" not in errors:
        mistakes.append(f"two programs: {status} {errors}")
    session.command(folder, "halcmd", "unloadusr", "mine")
    for _ in range(600):
        if "vismach" not in session.command(folder, "halcmd", "-s", "show", "comp")[1]:
            break
    else:
        mistakes.append("the component vismach stays")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        try:
            session.command(scratch, "realtime", "start")
            bench = Bench()
            transforms(bench)
            shapes(bench)
            light(bench)
            files(bench, scratch)
            guides(bench)
            texts(bench)
            trace(bench)
            directions(bench)
            mouse(bench)
            program(scratch)
        finally:
            session.command(scratch, "realtime", "stop")
    print("\n".join(mistakes) or "moved, drawn, traced")
    sys.exit(bool(mistakes))
