#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The supplied machines: their pins, pictures without errors that move with every pin, and the tool's place in the
frame of the work against the formulas of the kinematics."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import math
import os
import random
import runpy
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "../../components")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("machines")
os.environ.update(session.env)
sys.path.insert(0, str(TOP / "lib/python"))
import numpy as np  # noqa: E402
import vismach as v  # noqa: E402
from hal import query  # noqa: E402
from vismach.view import View  # noqa: E402

PINS = {
    "5axisgui": "jx jy jz jb jc tool_length tool_diam +pivot_len",
    "hbmgui": "table saddle head quill tool-length tool-radius",
    "hexagui": "joint.0 joint.1 joint.2 joint.3 joint.4 joint.5 axis.x axis.y axis.z axis.a axis.b axis.c",
    "lineardelta": "joint0 joint1 joint2 joint3 R L", "rotarydelta": "joint0 joint1 joint2 pfr tl sl fr",
    "maho600gui": "table tableway head arotate brotate tool-length tool-radius",
    "max5gui": "table saddle head tilt rotate tool-length tool-radius",
    "melfagui": "joint1 joint2 joint3 joint4 joint5 joint6 lnkdx lnkdz grip",
    "millturngui": "jointX jointY jointZ jointA toollength tooldiameter tool-x-offset !millkins",
    "puma560gui": "joint1 joint2 joint3 joint4 joint5 joint6 grip",
    "pumagui": "joint1 joint2 joint3 joint4 joint5 joint6",
    "scaragui": "joint0 joint1 joint2 joint3 joint4 joint5", "scorbot-er-3-gui": "joint0 joint1 joint2 joint3 joint4",
    "xyzab-tdr-gui": "axis-x axis-y axis-z rotary-a rotary-b x_offset z_offset x-rot-point y-rot-point z-rot-point "
                     "tool_length tool_diameter",
    "xyzac-trt-gui": "table-x saddle-y spindle-z tilt-a rotate-c y-offset z-offset tool-offset",
    "xyzbc-trt-gui": "table-x saddle-y spindle-z tilt-b rotate-c x-offset z-offset tool-offset",
}
# Pins that the picture has no use for: joint3 is a fourth axis, x_offset has no effect in the kinematics.
STILL = {"lineardelta": {"joint3"}, "scaragui": {"joint4", "joint5"}, "xyzab-tdr-gui": {"x_offset"}}
mistakes: list[str] = []


class Pins(dict):
    def newpin(self) -> None:
        """So that a shape takes it for a component."""


def cs(degrees: float) -> tuple[float, float]:
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def xyzac(p: Pins) -> tuple[float, float, float]:
    (ca, sa), (cc, sc) = cs(p["tilt-a"]), cs(p["rotate-c"])
    dy, dz = p["y-offset"], p["z-offset"] + p["tool-offset"]
    x, y, z = p["table-x"], p["saddle-y"] - dy, p["spindle-z"] - dz
    return (cc * x + sc * ca * y + sc * sa * z + sc * dy, -sc * x + cc * ca * y + cc * sa * z + cc * dy,
            -sa * y + ca * z + dz - p["tool-offset"])


def xyzbc(p: Pins) -> tuple[float, float, float]:
    (cb, sb), (cc, sc) = cs(p["tilt-b"]), cs(p["rotate-c"])
    dx, dz = p["x-offset"], p["z-offset"] + p["tool-offset"]
    x, y, z = p["table-x"] - dx, p["saddle-y"], p["spindle-z"] - dz
    return (cc * cb * x + sc * y - cc * sb * z + cc * dx, -sc * cb * x + cc * y + sc * sb * z - sc * dx,
            sb * x + cb * z + dz - p["tool-offset"])


def xyzab(p: Pins) -> tuple[float, float, float]:
    (ca, sa), (cb, sb) = cs(p["rotary-a"]), cs(p["rotary-b"])
    x0, y0, z0, dz, dt = p["x-rot-point"], p["y-rot-point"], p["z-rot-point"], p["z_offset"], p["tool_length"]
    x, y, z = p["axis-x"] - x0, p["axis-y"] - y0, p["axis-z"] - z0 - dt
    return (cb * x + sb * z + x0, sa * sb * x + ca * y - cb * sa * z + sa * dz + y0,
            -ca * sb * x + sa * y + ca * cb * z - ca * dz + z0 + dz)


def five_axis(p: Pins) -> tuple[float, float, float]:
    (cb, sb), (cc, sc) = cs(p["jb"]), cs(p["jc"])
    r = 250 + p["tool_length"]
    return p["jx"] + r * sb * cc, p["jy"] + r * sb * sc, p["jz"] + 250 - r * cb


def scara(p: Pins) -> tuple[float, float, float]:
    a0, a1 = p["joint0"], p["joint0"] + p["joint1"]
    a3 = a1 + p["joint3"]
    return (340 * cs(a0)[0] + 250 * cs(a1)[0] + 50 * cs(a3)[0], 340 * cs(a0)[1] + 250 * cs(a1)[1] + 50 * cs(a3)[1],
            490 + 50 - p["joint2"] - 50)


def links(*numbers: tuple[float, float, float]):
    """Product of the links (a, alpha, d) of genserkins."""
    def forward(p: Pins) -> tuple[float, float, float]:
        m = np.identity(4)
        for n, (a, alpha, d) in enumerate(numbers, 1):
            (ct, st), (c, s) = cs(p[f"joint{n}"]), cs(alpha)
            m = m @ np.array([[ct, -st, 0, a], [st * c, ct * c, -s, -s * d], [st * s, ct * s, c, c * d], [0, 0, 0, 1]])
        return tuple(m[:3, 3])
    return forward


def max5(p: Pins) -> tuple[float, float, float]:
    """The inverse of maxkins' kinematicsInverse."""
    (cb, sb), (cc, sc) = cs(p["tilt"]), cs(p["rotate"])
    length = 250 + p["tool-length"]
    x, y = p["table"] + length * sb, p["saddle"]
    return cc * x - sc * y, sc * x + cc * y, p["head"] + 250 - length * cb


def mill_turn(p: Pins) -> tuple[float, float, float]:
    """Tool of the mill, or the one at the side, along the table's axes."""
    aside, down = (0, p["toollength"]) if p["millkins"] else (p["tool-x-offset"], 0)
    return p["jointX"] + aside, p["jointY"], p["jointZ"] - down


def boring_mill(p: Pins) -> tuple[float, float, float]:
    return p["table"], p["head"], p["saddle"] + p["quill"] - p["tool-length"]


def maho(p: Pins) -> tuple[float, float, float]:
    """A turns the table on top of the one that B tilts; both turn the work by their angle."""
    (ca, sa), (cb, sb) = cs(p["arotate"]), cs(p["brotate"])
    x, y, z = p["table"], p["head"], p["tableway"] - p["tool-length"]
    x, z = cb * x - sb * z, sb * x + cb * z
    return ca * x + sa * y, -sa * x + ca * y, z


def scorbot(p: Pins) -> tuple[float, float, float]:
    """Angles of both arms are against the ground."""
    (c0, s0), (c1, s1), (c2, s2) = (cs(p[f"joint{n}"]) for n in range(3))
    r = 16 + 221 * c1 + 221 * c2
    return r * c0, r * s0, 140 + 221 * s1 + 221 * s2


def line_delta(p: Pins) -> tuple[float, float, float]:
    import lineardeltakins
    lineardeltakins.set_geometry(p["R"], p["L"])
    return lineardeltakins.forward(p["joint0"], p["joint1"], p["joint2"])


def rotary_delta(p: Pins) -> tuple[float, float, float]:
    import rotarydeltakins
    rotarydeltakins.set_geometry(*(p[n] for n in ("pfr", "tl", "sl", "fr")))
    return rotarydeltakins.forward(p["joint0"], p["joint1"], p["joint2"])


def hexapod(p: Pins) -> tuple[float, float, float]:
    return p["axis.x"], p["axis.y"], p["axis.z"]


FORMULAS = {"xyzac-trt-gui": xyzac, "xyzbc-trt-gui": xyzbc, "xyzab-tdr-gui": xyzab, "5axisgui": five_axis,
            "scaragui": scara, "max5gui": max5,
            "pumagui": links((0, 0, 0), (0, -90, 0), (300, 0, 70), (50, -90, 400), (0, 90, 0), (0, -90, 70)),
            "puma560gui": links((0, 0, 0), (0, -90, 0), (431.8, 0, 149.1), (20.3, -90, 433.1), (0, 90, 0),
                                (0, -90, 56.3)),
            "melfagui": links((0, 0, 350), (85, -90, 0), (280, 0, 0), (100, -90, 315), (0, 90, 0), (0, -90, 85)),
            "millturngui": mill_turn, "hbmgui": boring_mill, "maho600gui": maho, "scorbot-er-3-gui": scorbot,
            "lineardelta": line_delta, "rotarydelta": rotary_delta, "hexagui": hexapod}
FIXED = {"R": 130.25, "L": 269.0, "pfr": 10.0, "tl": 10.0, "sl": 14.0, "fr": 6.0}


def load(name: str):
    path = str(TOP / "src/emc/usr_intf/vismach" / name)
    loader = importlib.machinery.SourceFileLoader(f"machine_{name.replace('-', '_')}", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def values(name: str, random_: random.Random, pins: list[str]) -> dict[str, float]:
    def one(pin: str) -> float:
        if pin in FIXED:
            return FIXED[pin]
        if name == "lineardelta":
            return random_.uniform(240, 300)
        return random_.uniform(-30, 40) if name == "rotarydelta" else random_.uniform(5, 60)
    return {pin: one(pin) for pin in pins}


def examine(root, name: str) -> None:
    module = load(name)
    if module.NAME != name:
        mistakes.append(f"{name}: NAME = {module.NAME}")
    pins = PINS[name].replace("+pivot_len", "").replace("!", "").split()
    generator = random.Random(name)
    view = None
    if name == "scorbot-er-3-gui":
        module.hand = 0.0           # the kinematics is that of the wrist
    for turn in range(3):
        p = Pins(dict.fromkeys(pins, 0.0))
        p.update(values(name, generator, pins))
        if "millkins" in p:
            p["millkins"] = turn > 0
        model, tip, work = module.build(p)
        if view is None:
            view = View(root, model, tip, work, 500 if name not in ("hexagui", "rotarydelta") else 40, v.Hud(), -70, 30)
            root.update()
        view.model, view.tool, view.work = model, tip, work
        view.frame.window.make_current()
        view.paint(200, 200)
        got = (np.linalg.inv(work.t) @ tip.t @ (0, 0, 0, 1))[:3]
        if not np.allclose(got, FORMULAS[name](p), atol=2e-2):
            mistakes.append(f"{name} {dict(p)}: tool at {got.round(3)}, the kinematics says "
                            f"{np.round(FORMULAS[name](p), 3)}")

    view.redraw()           # the window gets its size
    view.camera.zoom = 0.6
    v.glPolygonMode(v.GL_FRONT_AND_BACK, v.GL_LINE)     # what is inside of something shows too

    def picture() -> bytes:
        view.trace.clear()
        view.paint(200, 200)
        v.glFinish()
        return bytes(v.glReadPixels(0, 0, 200, 200, v.GL_RGB, v.GL_UNSIGNED_BYTE))
    before = picture()
    if len(set(before)) < 20:
        mistakes.append(f"{name}: the picture is empty")
    for pin in pins:
        if pin in STILL.get(name, ()):
            continue
        old = p[pin]
        p[pin] = (not old if isinstance(old, bool) else old * 1.2 + 20 if name not in ("hexagui", "rotarydelta")
                  else old * 1.1 + 2)
        if (picture() == before and pin not in ("tool_diam", "tool_diameter", "tool-radius", "tool-x-offset",
                                                "tooldiameter", "lnkdx")):
            mistakes.append(f"{name}: nothing moves with {pin}")
        p[pin] = old
    if error := v.glGetError():
        mistakes.append(f"{name}: OpenGL error {error}")
    view.frame.destroy()


def pins_of(name: str) -> None:
    """The program's own component, without its window."""
    shown_with = []
    real, v.main = v.main, lambda model, tool, work, **options: shown_with.append(options)
    words, sys.argv, out, sys.stdout = sys.argv, [name], sys.stdout, open(os.devnull, "w")
    try:
        names = runpy.run_path(str(TOP / "src/emc/usr_intf/vismach" / name), run_name="__main__")
    finally:
        v.main, sys.argv, sys.stdout = real, words, out
    kinds = {v.hal.HAL_BIT: "!", v.hal.HAL_FLOAT: ""}
    got = {kinds[p["type"]] + ("+" if p["dir"] == v.hal.HAL_OUT else "") + p["name"].removeprefix(name + ".")
           for p in query.pins().values() if p["name"].startswith(name + ".")}
    if got != set(PINS[name].split()) or len(shown_with) != 1:
        mistakes.append(f"{name}: pins {got ^ set(PINS[name].split())}")
    names["c"].exit()


def programs(folder: str) -> None:
    """As halcmd starts it, with a statement that changes the model; and one that is none."""
    status, _, errors = session.command(folder, "halcmd", "loadusr", "-W", "5axisgui", "pivot_len=123")
    if status or session.command(folder, "halcmd", "getp", "5axisgui.pivot_len")[1].strip() != "123":
        mistakes.append(f"5axisgui: {errors}")
    session.command(folder, "halcmd", "unloadusr", "5axisgui")
    status, _, errors = session.command(folder, "xyzac-trt-gui", "table_radius=")
    if status != 1 or "table_radius=: SyntaxError" not in errors:
        mistakes.append(f"bad statement: {status} {errors}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        try:
            session.command(scratch, "realtime", "start")
            window = v.tkinter.Tk()
            window.geometry("200x200+0+0")
            for machine in PINS:
                examine(window, machine)
                pins_of(machine)
            window.destroy()
            programs(scratch)
        finally:
            session.command(scratch, "realtime", "stop")
    print("\n".join(mistakes) or f"{len(PINS)} machines follow")
    sys.exit(bool(mistakes))
