#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Every widget of PyVCP: its pins by name, type and direction, what they show, and what clicks, drags and keys set."""

from __future__ import annotations

import math
import os
import sys
import tempfile
import tkinter as tk
from pathlib import Path

sys.path.insert(0, "../../components")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("pyvcp")
os.environ.update(session.env)
sys.path.insert(0, str(TOP / "lib/python"))
import hal  # noqa: E402
import pyvcp_widgets as widgets  # noqa: E402
import vcpparse  # noqa: E402
from hal import query  # noqa: E402

mistakes: list[str] = []
PINS = {
    "bit out": "button.0 go checkbutton.0 coolant checkbutton.2 radiobutton.0.one radiobutton.0.two radiobutton.0.three",
    "bit in": "led.0 my-led my-led.disable led.1 led.1.disable button.0.disable checkbutton.0.changepin "
              "coolant.changepin "
              "checkbutton.2.changepin label.0.disable multilabel.0.legend0 multilabel.0.legend1 multilabel.0.legend2 "
              "number.0 timer.0.reset timer.0.run jogwheel.0.reset",
    "u32 in": "number.1 number.3", "s32 in": "number.4", "s32 out": "scale.0-i level-i",
    "float in": "number.2 speed bar.0 meter.0.value spinbox.0.param_pin scale.0.param_pin level-in dial.0.param_pin "
                "jogwheel.0.scale",
    "float out": "spinbox.0 scale.0-f level-f dial.0.out jogwheel.0.count mpg",
}


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


class Bench:
    def __init__(self) -> None:
        self.root = tk.Tk()
        self.root.geometry("+0+0")
        self.component = hal.component("panel")
        vcpparse.filename = "panel.xml"
        vcpparse.create_vcp(self.root, self.component)
        self.component.ready()
        self.book = self.root.winfo_children()[0]

    def page(self, number: int) -> None:
        self.root.tk.call(self.book._w, "raise", f"p{number}")
        self.settle()

    def settle(self) -> None:
        for _ in range(3):
            self.root.update()

    def all(self, kind: str) -> list:
        def walk(w):
            for child in w.winfo_children():
                yield child
                yield from walk(child)
        return [w for w in walk(self.book) if type(w) is widgets.ELEMENTS[kind]]

    def put(self, widget, values: dict[str, object]) -> None:
        for name, value in values.items():
            hal.set_p(f"panel.{name}", value)
        widget.follow()
        self.settle()

    def event(self, widget, *events: str, x: int = 5, y: int = 5, **more: object) -> None:
        for event in events:
            widget.event_generate(event, x=x, y=y, **more)
        self.settle()

    def get(self, name: str) -> object:
        return hal.get_p(f"panel.{name}")


def pins() -> None:
    got: dict[str, set[str]] = {}
    for pin in query.pins().values():
        if pin["name"].startswith("panel."):
            kind = {hal.HAL_BIT: "bit", hal.HAL_FLOAT: "float", hal.HAL_S32: "s32", hal.HAL_U32: "u32"}[pin["type"]]
            got.setdefault(f"{kind} {'in' if pin['dir'] == hal.HAL_IN else 'out'}", set()).add(pin["name"][6:])
    for kind in got.keys() | PINS.keys():
        # an included panel goes on counting; images take a number each
        check(f"{kind} pins", got.get(kind, set()) ^ set(PINS.get(kind, "").split()), set())
    check("prefix of the included panel", sorted(n for n in query.pins() if n.startswith("inner.")),
          ["inner.button.1", "inner.led.2"])


def lamps(b: Bench) -> None:
    b.page(0)
    plain, own = b.all("led")[:2]
    rect = b.all("rectled")[0]

    def color(w):
        return w.itemcget("lamp", "fill")
    check("off", [color(w) for w in (plain, own, rect)], ["red", "#101080", "red"])
    b.put(plain, {"led.0": True})
    b.put(own, {"my-led": True})
    b.put(rect, {"led.1": True})
    check("on", [color(w) for w in (plain, own, rect)], ["green", "yellow", "green"])
    b.put(own, {"my-led.disable": True})
    b.put(rect, {"led.1.disable": True})
    check("disabled", [color(w) for w in (own, rect)], ["gray80", "pink"])
    check("size", (own["width"], rect["width"], rect["height"]), ("30", "50", "14"))
    label = b.all("label")[1]
    b.put(label, {"label.0.disable": True})
    check("label greyed", str(label["state"]), "disabled")
    b.put(label, {"label.0.disable": False})
    check("label back", str(label["state"]), "normal")
    many = b.all("multilabel")[0]
    check("legend at the start", (many["text"], b.get("multilabel.0.legend1")), ("Warm", True))
    b.put(many, {"multilabel.0.legend2": True})
    check("legend", (many["text"], [b.get(f"multilabel.0.legend{n}") for n in range(3)]), ("Hot", [False, False, True]))
    bit, number = b.all("image_bit")[0], b.all("image_u32")[0]
    check("images", (str(bit["image"]), str(number["image"])), ("red", "green"))
    b.put(bit, {"number.0": True})
    b.put(number, {"number.1": 1})
    check("other images", (str(bit["image"]), str(number["image"])), ("green", "red"))
    stderr, sys.stderr = sys.stderr, tempfile.TemporaryFile("w+")
    b.put(number, {"number.1": 7})
    sys.stderr.seek(0)
    told, sys.stderr = sys.stderr.read(), stderr
    check("bad image", (told, str(number["image"])), ("Unknown image #7 on number.1\n", "red"))
    check("title and options", (b.root.title(), str(label["foreground"])), ("All widgets", "navy"))


def buttons(b: Bench) -> None:
    press, go = b.all("button")[:2]
    for n in (1, 2, 3):
        b.event(press, "<Enter>", f"<ButtonPress-{n}>")
        check(f"button {n} pressed", b.get("button.0"), True)
        b.event(press, f"<ButtonRelease-{n}>")
        check(f"button {n} released", b.get("button.0"), False)
    for n in (4, 5):
        b.event(press, f"<ButtonPress-{n}>")
        check("the wheel presses nothing", b.get("button.0"), False)
        b.event(press, f"<ButtonRelease-{n}>")
    b.event(go, "<Enter>", "<ButtonPress-1>")
    check("only its own pin", (b.get("go"), b.get("button.0")), (True, False))
    b.event(go, "<ButtonRelease-1>")
    b.event(press, "<ButtonPress-1>")
    b.put(press, {"button.0.disable": True})
    check("disabled while pressed", (str(press["state"]), b.get("button.0")), ("disabled", False))
    b.event(press, "<ButtonRelease-1>", "<ButtonPress-1>")
    check("dead while disabled", b.get("button.0"), False)
    b.event(press, "<ButtonRelease-1>")
    check_one, coolant, _ = b.all("checkbutton")
    check("initval", (b.get("checkbutton.0"), b.get("coolant")), (True, False))
    b.event(check_one, "<Enter>", "<ButtonPress-1>", "<ButtonRelease-1>")
    check_one.follow()
    check("click", b.get("checkbutton.0"), False)
    for want in (True, False):
        b.put(coolant, {"coolant.changepin": True})
        check("changepin", (b.get("coolant"), b.get("coolant.changepin")), (want, False))
        coolant.follow()
        check("once", b.get("coolant"), want)
    radio = b.all("radiobutton")[0]
    names = ("one", "two", "three")
    check("choice", [b.get(f"radiobutton.0.{n}") for n in names], [False, True, False])
    b.event(radio.buttons[2], "<Enter>", "<ButtonPress-1>", "<ButtonRelease-1>")
    radio.follow()
    check("other choice", [b.get(f"radiobutton.0.{n}") for n in names], [False, False, True])
    check("side by side", radio.buttons[0].winfo_y() == radio.buttons[2].winfo_y(), True)


def numbers(b: Bench) -> None:
    b.page(1)
    plain, speed = b.all("number")
    b.put(plain, {"number.2": -12.345})
    b.put(speed, {"speed": 99.96})
    u32, s32 = b.all("u32")[0], b.all("s32")[0]
    b.put(u32, {"number.3": 4294967295})
    b.put(s32, {"number.4": -42})
    check("numbers", [w["text"] for w in (plain, speed, u32, s32)], ["-12.35", "100.0", "4294967295", "-0042"])
    timer = b.all("timer")[0]
    now = [1000.0]
    timer.now = lambda: now[0]
    b.put(timer, {"timer.0.run": True})
    now[0] += 3725
    b.put(timer, {})
    check("timer", timer["text"], "01:02:05")
    b.put(timer, {"timer.0.run": False})
    now[0] += 100
    b.put(timer, {})
    check("timer stands", timer["text"], "01:02:05")
    b.put(timer, {"timer.0.reset": True})
    check("timer reset", timer["text"], "00:00:00")
    b.put(timer, {"timer.0.run": True})
    now[0] += 5
    b.put(timer, {})
    check("resets with the edge only", timer["text"], "00:00:05")
    bar = b.all("bar")[0]
    for value, color, left, right in ((-50, "green", -50, 0), (-25, "blue", -25, 0), (0, "blue", 0, 0),
                                      (0.5, "green", 0, 0.5), (100, "green", 0, 100), (150, "red", 0, 150),
                                      (500, "green", 0, 150), (-500, "green", -50, 0)):
        b.put(bar, {"bar.0": value})
        x = bar.coords("bar")
        want = [bar.position(left), bar.position(right)]
        got = (bar.itemcget("bar", "fill"), bar.itemcget("number", "text"), [round(v, 3) for v in (x[0], x[2])])
        check(f"bar {value}", got, (color, f"{value:3.1f}", [round(v, 3) for v in want]))
    meter = b.all("meter")[0]
    for value, turn in ((0, -2.5), (1500, 0), (3000, 2.5), (4000, 2.5), (-9, -2.5), (float("nan"), -2.5)):
        b.put(meter, {"meter.0.value": value})
        x0, y0, x1, y1 = meter.coords("needle")
        check(f"meter {value}", round(math.atan2(x1 - x0, y0 - y1), 6), turn)
    check("marks", sorted(meter.itemcget(i, "text")
                          for i in meter.find_all() if meter.type(i) == "text" and meter.itemcget(i, "text").isdigit()),
          ["0", "1000", "1500", "2000", "2500", "3000", "500"])


def controls(b: Bench) -> None:
    b.page(2)
    spin = b.all("spinbox")[0]
    check("spinbox", (b.get("spinbox.0"), spin.get()), (2.0, "2.00"))
    for text, value in (("3.5", 3.5), ("99", 10), ("-99", -10), ("junk", -10), ("nan", -10), ("1", 1)):
        spin.delete(0, "end")
        spin.insert(0, text)
        spin.focus_force()
        b.settle()
        b.event(spin, "<Return>")
        spin.follow()
        check(f"spinbox {text}", b.get("spinbox.0"), value)
    b.event(spin, "<Button-4>")
    b.event(spin, "<Button-4>")
    b.event(spin, "<Button-5>")
    spin.follow()
    check("wheel", b.get("spinbox.0"), 1.5)
    b.put(spin, {"spinbox.0.param_pin": 4.0})
    check("param_pin", (b.get("spinbox.0"), spin.get()), (4.0, "4.00"))
    spin.invoke("buttonup")
    spin.follow()
    check("not again", b.get("spinbox.0"), 4.5)
    scale, level = b.all("scale")
    check("scale", (b.get("scale.0-f"), b.get("scale.0-i")), (7.25, 7))
    b.put(scale, {"scale.0.param_pin": -3.75})
    check("param_pin of scale", (b.get("scale.0-f"), b.get("scale.0-i"), scale.get()), (-3.75, -3, -3.75))
    b.event(scale, "<Button-4>")
    scale.follow()
    check("wheel of scale", b.get("scale.0-f"), -3.5)
    b.put(level, {"level-in": 4})
    check("halparam", (b.get("level-f"), b.get("level-i")), (4.0, 4))
    dial = b.all("dial")[0]
    middle = int(dial.middle)
    check("dial", b.get("dial.0.out"), 1.0)
    b.event(dial, "<Button-4>")
    check("wheel of dial", b.get("dial.0.out"), 1.5)
    top, right = (middle, 15), (2 * middle - 15, middle)
    b.event(dial, "<ButtonPress-1>", x=top[0], y=top[1])
    b.event(dial, "<B1-Motion>", x=right[0], y=right[1])
    b.event(dial, "<ButtonRelease-1>", x=right[0], y=right[1])
    check("a quarter turn", b.get("dial.0.out"), 4.0)
    for _ in range(9):
        b.event(dial, "<Button-4>")
    check("max_", b.get("dial.0.out"), 5.0)
    for button, step in ((3, 5.0), (1, 0.5), (3, 5.0), (2, 0.5)):
        b.event(dial, *[f"<ButtonPress-{button}>", f"<ButtonRelease-{button}>"] * 2, x=middle, y=middle)
        check(f"step after double click {button}", round(dial.step, 6), step)
    dial.event_generate("<ButtonPress-1>", x=middle, y=middle, state=1)
    dial.event_generate("<ButtonRelease-1>", x=middle, y=middle, state=1)
    b.settle()
    check("Shift-click", b.get("dial.0.out"), 1.0)
    b.put(dial, {"dial.0.param_pin": -7})
    check("param_pin of dial, min_", b.get("dial.0.out"), -3.0)
    wheel, mpg = b.all("jogwheel")
    b.put(wheel, {"jogwheel.0.scale": 0.25})
    for event in ("<Button-4>", "<Button-4>", "<Button-4>", "<Button-5>"):
        b.event(wheel, event)
    check("jogwheel", (b.get("jogwheel.0.count"), wheel.itemcget("number", "text")), (2.0, "0.5000"))
    b.event(wheel, "<Enter>")
    check("fillcolor", wheel.itemcget("face", "fill"), "yellow")
    b.event(wheel, "<Leave>")
    check("bgcolor", wheel.itemcget("face", "fill"), "lightgrey")
    b.put(wheel, {"jogwheel.0.reset": True})
    check("reset", (b.get("jogwheel.0.count"), wheel.itemcget("number", "text")), (2.0, "0.0000"))
    middle = int(mpg.middle)
    b.event(mpg, "<ButtonPress-1>", x=middle + 30, y=middle)
    for n in range(1, 41):
        angle = 2 * math.pi * n / 40
        b.event(mpg, "<B1-Motion>", x=round(middle + 30 * math.cos(angle)), y=round(middle - 30 * math.sin(angle)))
    check("a turn against the clock", abs(b.get("mpg") + 40) <= 1, True)


def layout(b: Bench) -> None:
    b.page(3)
    table = b.all("table")[0]
    places = {w["text"]: (w.grid_info()["row"], w.grid_info()["column"], w.grid_info()["rowspan"],
                          w.grid_info()["columnspan"], w.grid_info()["sticky"])
                          for w in table.winfo_children() if type(w) is widgets.ELEMENTS["label"]}
    check("table", places, {"A": (1, 1, 1, 1, "new"), "B": (1, 2, 1, 1, "new"), "wide": (1, 3, 2, 2, "new"),
                            "C": (2, 1, 1, 1, "new"), "D": (2, 2, 1, 1, "nesw"), "E": (2, 5, 1, 1, "nesw")})
    check("flexible", (table.rowconfigure(2)["weight"], table.columnconfigure(4)["weight"],
                       table.columnconfigure(2)["weight"]), (1, 1, 0))
    check("uniform", (str(table.columnconfigure(1)["uniform"]), str(table.columnconfigure(3)["uniform"])), ("a", "a"))
    first = b.all("vbox")[0]
    check("vbox", (first["relief"], first["bd"], first.winfo_children()[0].pack_info()["fill"]), ("raised", 2, "x"))
    lamps = b.all("hbox")[0].winfo_children()[0].pack_info()
    check("hbox", (lamps["side"], lamps["fill"], lamps["anchor"]), ("left", "y", "n"))
    later = b.all("label")[0].pack_info()
    check("boxfill, boxexpand, boxanchor", (later["fill"], later["expand"], later["anchor"]), ("none", 0, "w"))
    check("axisoptions", str(b.all("label")[0]["padx"]), "0")
    inner = b.all("include")[0]
    check("include", [type(w).__name__ for w in inner.winfo_children()], ["Led", "Vbox"])


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            bench = Bench()
            for part in (lamps, buttons, numbers, controls, layout):
                part(bench)
            pins()
        finally:
            session.command(folder, "realtime", "stop")
    print("\n".join(mistakes) or "shown, set, followed")
    sys.exit(bool(mistakes))
