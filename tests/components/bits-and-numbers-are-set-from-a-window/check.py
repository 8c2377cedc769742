#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""sim_pin: what may be set, the window's buttons and entries, and its complaints."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("simpin")
os.environ.update(session.env)
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import tkinter as tk  # noqa: E402

import hal  # noqa: E402
import sim_pin  # noqa: E402
from kerf.haltools.writable import Item, NotWritable  # noqa: E402

mistakes: list[str] = []
HAL = """
loadrt and2 names=gate
loadrt mux2 names=mux
loadrt conv_s32_u32 names=conv
loadrt conv_u32_s32 names=back
loadrt not names=inv
loadrt siggen num_chan=1
loadrt scale names=scale
loadrt conv_s32_s64 names=wide
net driven inv.out gate.in0
net free gate.in1
newsig lonely float
"""


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def refused(what: str, action, part: str) -> None:
    try:
        action()
        mistakes.append(f"{what}: not refused")
    except (NotWritable, ValueError) as error:
        if part not in str(error):
            mistakes.append(f"{what}: {error}")


def names() -> None:
    for name, kind, what in (("mux.in0", "float", "pin"), ("gate.in1", "bit", "pin"), ("lonely", "float", "signal"),
                             ("conv.in", "s32", "pin"), ("back.in", "u32", "pin"), ("free", "bit", "signal"),
                             ("gate.tmax", "s32", "parameter")):
        item = Item(name)
        check(name, (item.kind, item.what), (kind, what))
    for name, part in (("gate.in0", "connected to the signal driven, which is written by inv.out"),
                       ("driven", "written by inv.out"), ("gate.out", "an output of and2"), ("no.such", "no such pin"),
                       ("wide.out", "output"), ("conv.out", "an output of conv_s32_u32")):
        refused(name, lambda name=name: Item(name), part)
    for word, want in (("a.b", ("a.b", "toggle", True)), ("a/mode=pulse", ("a", "pulse", True)),
                       ("a/mode=Hold", ("a", "hold", False))):
        check(word, sim_pin.split(word), want)
    for word in ("a/mode=press", "a/hold", "a/mode=", "a/mode=HOLD"):
        refused(word, lambda word=word: sim_pin.split(word), "/mode=pulse")


def window(folder: str) -> None:
    root = tk.Tk()
    words = ["gate.in1", "mux.sel/mode=Hold", "inv.in/mode=pulse", "conv.in", "back.in", "mux.in0", "lonely"]
    items = [(Item(name), mode, choice) for name, mode, choice in map(sim_pin.split, words)]
    window = sim_pin.Window(root, "Some pins", items)
    toggle, hold, pulse, s32, u32, real, lonely = window.rows
    root.update()
    press, release = ((lambda row, e=e: (row.button.event_generate(e), root.update())) for e in
                      ("<ButtonPress-1>", "<ButtonRelease-1>"))
    for want in (True, False, True):
        press(toggle)
        check("toggled", (hal.get_p("gate.in1"), toggle.button["text"]), (want, "ON" if want else "OFF"))
        release(toggle)
        check("stays", hal.get_s("free"), want)
    press(hold)
    check("held", hal.get_p("mux.sel"), True)
    release(hold)
    check("let go", hal.get_p("mux.sel"), False)
    check("no choice", hasattr(hold, "mode"), False)
    edges, put = [], hold.item.set
    hold.item.set = lambda value: (edges.append(value), put(value))
    hold.button.focus_force()
    root.update()
    for event in ("<KeyPress-space>", "<KeyRelease-space>") * 3 + ("<KeyPress-space>",):     # a held key repeats
        hold.button.event_generate(event)
    root.update()
    check("held by a key", (hal.get_p("mux.sel"), edges), (True, [True]))
    toggle.button.focus_force()
    while hal.get_p("mux.sel"):
        root.update()
    check("let go with the focus", edges, [True, False])
    press(pulse)
    check("pulse", hal.get_p("inv.in"), True)
    release(pulse)
    while hal.get_p("inv.in"):      # ends by itself
        root.update()
    radios = [w for w in toggle.frame.winfo_children() if w.winfo_class() == "TRadiobutton"]
    check("modes", [w["text"] for w in radios], ["Pulse", "Toggle", "Hold"])
    radios[2].invoke()
    press(toggle)
    release(toggle)
    check("mode chosen", hal.get_p("gate.in1"), False)

    def enter(row, text, button="Set"):
        row.entry.delete(0, "end")
        row.entry.insert(0, text)
        row.buttons[button].invoke()
        root.update()
        return window.status["text"]
    check("expression", (enter(real, "3*25.5"), hal.get_p("mux.in0"), real.value["text"]), ("", 76.5, "76.5"))
    check("decimal comma", (enter(real, "7,5"), hal.get_p("mux.in0")), ("", 7.5))
    enter(real, "76.5")
    check("signal", (enter(lonely, "-1e3"), hal.get_s("lonely")), ("", -1000.0))
    check("s32", (enter(s32, "-5"), hal.get_p("conv.in")), ("", -5))
    check("u32", (enter(u32, "0xFF+1"), hal.get_p("back.in"), u32.value["text"]), ("", 256, "256 (0x00000100)"))
    for _ in range(2):
        u32.buttons["-"].invoke()
    check("less", hal.get_p("back.in"), 254)
    u32.buttons["Reset"].invoke()
    u32.buttons["-"].invoke()
    check("not below 0", hal.get_p("back.in"), 0)
    u32.buttons["+"].invoke()
    check("more", hal.get_p("back.in"), 1)
    for row, text, part in ((u32, "-1", "no u32"), (u32, "1.5", "whole number"), (s32, "2147483648", "no s32"),
                            (real, "3 +", "3 +"), (real, "[exec true]", "invalid command"), (real, "", "''")):
        message = enter(row, text)
        if part not in message:
            mistakes.append(f"{text}: {message!r}")
    check("unchanged", (hal.get_p("conv.in"), hal.get_p("mux.in0"), hal.get_p("back.in")), (-5, 76.5, 1))
    check("complaint goes", enter(real, "1"), "")
    press(hold)
    for row in window.rows:
        row.finish()
    check("a held button ends with the window", hal.get_p("mux.sel"), False)
    hal.set_p("conv.in", 77)
    while s32.value["text"] != "77":        # followed live
        root.update()
    session.command(folder, "halcmd", "unload", "conv_s32_u32")
    root.after(30_000, lambda: (mistakes.append("the window stays open"), root.destroy()))
    root.mainloop()         # closes itself with the first pin that is gone


def program(folder: str) -> None:
    screen = os.environ["DISPLAY"]
    del session.env["DISPLAY"]
    for words, part in ((["gate.in1"], "no display"), (["gate.out"], "an output of and2"), ([], "usage"),
                        (["gate.in1/mode=x"], "/mode=pulse")):
        status, _, errors = session.command(folder, "sim_pin", *words)
        if not status or part not in errors:
            mistakes.append(f"sim_pin {words}: {status} {errors}")
    session.env["DISPLAY"] = screen


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            commands = Path(folder, "commands.hal")
            commands.write_text(HAL)
            status, _, errors = session.command(folder, "halcmd", "-f", str(commands))
            if status:
                mistakes.append(errors)
            names()
            window(folder)
            program(folder)
        finally:
            session.command(folder, "realtime", "stop")
    print("\n".join(mistakes) or "set, followed, refused")
    sys.exit(bool(mistakes))
