#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""moveoff_gui: its connections, buttons, states and countdown, with moveoff and pins that
stand for halui and motion."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("moveoff")
os.environ.update(session.env)
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import tkinter as tk  # noqa: E402

import hal  # noqa: E402
import moveoff_gui  # noqa: E402
from hal import query  # noqa: E402
from kerf import clock  # noqa: E402

mistakes: list[str] = []
HAL = """
loadrt threads name1=thread period1=1000000
loadrt moveoff names=mv personality=3
addf mv.read-inputs thread
addf mv.write-outputs thread
net on motion.motion-enabled => mv.power-on
start
"""


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def command(*words: str) -> tuple[int, str]:
    """Runs a program in our place on the clock. (status, what it printed)"""
    with tempfile.TemporaryFile("w+") as file:
        status = clock.run(words, env=session.env, stdout=file, stderr=file).returncode
        file.seek(0)
        return status, file.read()


def refused(what: str, part: str, *words: str) -> None:
    try:
        options = moveoff_gui.parse(list(words))
        moveoff_gui.Offsets(options, moveoff_gui.joint_numbers(options.axes, None))
        mistakes.append(f"{what}: not refused")
    except moveoff_gui.Unusable as error:
        if part not in str(error):
            mistakes.append(f"{what}: {error}")


class Bench:
    """A window, the components that stand for the machine, and the clock."""

    def __init__(self, *words: str):
        self.root = tk.Tk()
        options = moveoff_gui.parse(list(words))
        self.offsets = moveoff_gui.Offsets(options, moveoff_gui.joint_numbers(options.axes, None))
        self.window = moveoff_gui.Window(self.root, self.offsets, options)
        self.root.update()

    def pass_time(self, seconds: float = 0.5) -> None:
        clock.sleep(seconds)
        self.window.look()
        self.root.update()

    def status(self) -> tuple[str, str]:
        return self.window.status["text"], self.window.status["bg"]

    def click(self, widget: tk.Widget) -> None:
        for event in ("<Enter>", "<ButtonPress-1>", "<ButtonRelease-1>"):
            widget.event_generate(event, x=5, y=5)
        self.root.update()

    def buttons(self, text: str) -> list[tk.Button]:
        return [c for c in self.window.controls if isinstance(c, tk.Button) and c["text"] == text]

    def until(self, condition, what: str) -> None:
        """For what the window's own timers do."""
        end = time.monotonic() + 30
        while not condition():
            self.root.update()
            if time.monotonic() > end:
                mistakes.append(what)
                return

    def end(self) -> None:
        self.window.close()


def on_pause(halui, motion) -> None:
    bench = Bench("-axes", "xyz", "-inc", "0.5", "-inc", "2", "-autoresume", "-delay", "0.2", "-loc", "+20+30")
    window = bench.window
    check("hidden while the program runs", bench.root.state(), "withdrawn")
    check("apply-offsets", query.pin("mv.apply-offsets")["signal"], "mvoff_gui:apply_offsets")
    check("is-paused", query.pin("halui.program.is-paused")["signal"], "mvoff_gui:apply_offsets")
    check("resume-inhibit", query.pin("axisui.resume-inhibit")["signal"], "mvoff_gui:offset_applied")
    check("refused while it runs", (window.enable.set(True), window.switched(), hal.get_p("mv.move-enable"))[2], False)
    halui["program.is-paused"] = True
    bench.pass_time()
    check("shown in a pause", bench.root.state(), "normal")
    check("place", (bench.root.winfo_rootx() >= 20, bench.root.geometry().endswith("+20+30")), (True, True))
    check("status", bench.status(), ("Offsets Disabled", moveoff_gui.COLORS["Offsets Disabled"]))
    check("increments", [r["text"] for r in window.radios], ["0.5", "2"])
    minus, plus, zero = (bench.buttons(t) for t in "-+0")
    bench.click(plus[0])
    check("nothing while off", hal.get_p("mv.offset-in-0"), 0)
    bench.click(window.switch)
    check("on", (hal.get_p("mv.move-enable"), bench.status()), (True, ("Offsets Enabled", "cyan")))
    bench.click(plus[0])
    bench.click(plus[0])
    bench.click(minus[2])
    check("by the increment", [hal.get_p(f"mv.offset-in-{j}") for j in range(3)], [1.0, 0.0, -0.5])
    window.radios[1].invoke()
    bench.click(plus[1])
    check("the other increment", hal.get_p("mv.offset-in-1"), 2.0)
    bench.click(zero[1])
    check("zero", hal.get_p("mv.offset-in-1"), 0.0)
    for text, value, color in (("1.25", 1.25, "ink"), ("1,5", 1.5, "ink"), ("1.5.2", 1.5, "bad"), ("nan", 1.5, "bad"),
                               ("99", 3.0, "ink")):
        entry = window.entries["y"]
        check("as dark as its window while it is locked", entry["disabledbackground"], window.style.colours["face"])
        entry.delete(0, "end")
        entry.insert(0, text)
        entry.focus_force()
        bench.root.update()
        entry.event_generate("<Return>")
        bench.root.update()
        check(f"entry {text}", (hal.get_p("mv.offset-in-1"), entry["fg"]), (value, window.style.colours[color]))
    bench.pass_time(1)
    check("moved", ([round(hal.get_p(f"mv.pos-plusoffset-{j}"), 6) for j in range(3)], bench.status()[0]),
          ([1.0, 3.0, -0.5], "OFFSETS ACTIVE"))
    check("values", [window.values[a]["text"] for a in "xyz"], ["1.0000", "3.0000", "-0.5000"])
    check("no resume from a screen", hal.get_p("axisui.resume-inhibit"), True)
    if picture := os.environ.get("SCREENSHOT"):
        from PIL import ImageGrab
        ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).save(picture)
    window.backtracking.invoke()
    check("backtrack", hal.get_p("mv.backtrack-enable"), False)
    bench.click(window.switch)
    bench.pass_time(0.05)
    check("removing", bench.status(), ("Removing offsets", "yellow"))
    check("no countdown yet", window.countdown, None)
    bench.pass_time(2)
    check("gone", (bench.status()[0], hal.get_p("mv.offset-current-1")), ("Offsets Disabled", 0))
    check("countdown", window.seconds["text"], "The program is resumed in 0 s")
    pulses = []
    bench.until(lambda: pulses.append(hal.get_p("halui.program.resume")) or (pulses[-1]), "no resume")
    bench.until(lambda: not hal.get_p("halui.program.resume"), "the pulse does not end")
    check("countdown gone", window.countdown, None)

    # Cancel, and an offset that is left when the program goes on
    bench.click(window.switch)
    bench.click(plus[0])
    bench.pass_time(1)
    check("again", round(hal.get_p("mv.offset-current-0"), 6), 2.0)
    window.options.delay = 1000
    bench.click(window.switch)
    bench.pass_time(2)
    window.cancel.invoke()
    bench.root.update()
    bench.pass_time()
    check("cancelled", (window.countdown, window.resumer.left, hal.get_p("halui.program.resume")), (None, None, False))
    bench.click(window.switch)
    bench.click(plus[0])
    bench.pass_time(1)
    motion["motion-enabled"] = False
    bench.pass_time(0.01)
    check("motion off", bench.status(), ("Offsets Disabled --- Motion Off", "white"))
    motion["motion-enabled"] = True
    halui["program.is-paused"] = False
    bench.pass_time(1)
    check("disabled when the program goes on", (hal.get_p("mv.move-enable"), bench.root.state()), (False, "withdrawn"))
    check("waypoint usage", window.note["text"], "")
    bench.end()


def always(halui) -> None:
    command("halcmd", "unlinkp", "mv.apply-offsets")
    bench = Bench("-mode", "always", "-noentry", "-no_resume_inhibit", "-no_pause_requirement", "-axes", "z")
    window = bench.window
    check("always shown, set", (bench.root.state(), hal.get_p("mv.apply-offsets")), ("normal", True))
    check("no entry", window.entries, {})
    check("default increments", [r["text"] for r in window.radios], ["0.001", "0.01", "0.1", "1"])
    hal.set_p("mv.dbg-waypoint-limit-test", True)
    hal.set_p("mv.waypoint-threshold", 0.0001)
    hal.set_p("mv.waypoint-sample-secs", 0.0001)
    bench.pass_time(0.1)
    bench.click(window.switch)
    check("without a pause", hal.get_p("mv.move-enable"), True)
    window.radios[3].invoke()
    for _ in range(2):
        bench.click(bench.buttons("+")[0])
    bench.pass_time(0.03)
    check("usage shown", (window.note["text"][:15], window.note["fg"]),
          ("Waypoints used:", window.style.colours["ink"]))
    bench.pass_time(0.014)
    check("usage high", window.note["fg"], window.style.colours["bad"])
    bench.pass_time(0.1)
    check("limit", bench.status(), ("Waypoint limit (Disable required)", "orange"))
    bench.end()
    check("closed", hal.get_p("mv.move-enable"), False)
    clock.sleep(3)
    check("comes back from full speed", (hal.get_p("mv.offset-current-0"), hal.get_p("mv.dbg-state")), (0, 0))


def display() -> None:
    hal.set_p("mv.dbg-waypoint-limit-test", False)
    command("halcmd", "net", "mine", "mv.move-enable")
    command("halcmd", "setp", "mv.offset-in-0", "0.75")
    bench = Bench("-mode", "always", "-size", "20")
    check("only values", (hasattr(bench.window, "switch"), bench.window.controls), (False, []))
    command("halcmd", "sets", "mine", "1")
    bench.pass_time(1)
    check("followed", (bench.window.values["x"]["text"], bench.status()[0]), ("0.7500", "OFFSETS ACTIVE"))
    bench.end()
    check("stays", hal.get_p("mv.move-enable"), True)
    command("halcmd", "sets", "mine", "0")
    clock.sleep(2)
    bench = Bench("-no_display", "-mode", "always")
    check("no window", bench.root.state(), "withdrawn")
    bench.end()
    command("halcmd", "unlinkp", "mv.move-enable")


def refusals() -> None:
    refused("connected offset", "mv.offset-in-1 is connected to taken", "-axes", "xy")
    command("halcmd", "unlinkp", "mv.offset-in-1")
    refused("fourth joint", "personality=4", "-axes", "xyza")
    command("halcmd", "net", "pressed", "mv.apply-offsets")
    refused("connected apply-offsets", "mv.apply-offsets is connected")
    command("halcmd", "unlinkp", "mv.apply-offsets")
    command("halcmd", "net", "pressed", "halui.program.resume")
    refused("connected resume", "halui.program.resume is connected to pressed", "-autoresume")
    command("halcmd", "unlinkp", "halui.program.resume")
    command("halcmd", "unlinkp", "mv.apply-offsets")
    for axes, kinematics, want in (("xyz", None, {"x": 0, "y": 1, "z": 2}), ("xz", None, {"x": 0, "z": 1}),
                                   ("xz", "trivkins", {"x": 0, "z": 2}),
                                   ("zx", "trivkins coordinates=XYYZ kinstype=BOTH", {"z": 3, "x": 0})):
        check(f"{axes} {kinematics}", moveoff_gui.joint_numbers(axes, kinematics), want)
    for axes, kinematics, part in (("xy", "trivkins coordinates=XZ", "y is not among"), ("x", "5axiskins", "trivkins")):
        try:
            moveoff_gui.joint_numbers(axes, kinematics)
            mistakes.append(f"{kinematics}: accepted")
        except moveoff_gui.Unusable as error:
            if part not in str(error):
                mistakes.append(str(error))
    for words, part in ((["-axes", "xxy"], "different letters"), (["-inc", "0"], "above 0"),
                        (["-mode", "never"], "onpause"), (["-inc", "1"] * 5, "at most 4"), (["-size", "2"], "-size"),
                        (["-no"], "-no")):
        status, errors = command("moveoff_gui", *words)
        if not status or part not in errors:
            mistakes.append(f"moveoff_gui {words}: {status} {errors}")
    screen = session.env.pop("DISPLAY")
    status, errors = command("moveoff_gui")
    if status != 1 or "no display" not in errors:
        mistakes.append(f"no display: {errors}")
    session.env["DISPLAY"] = screen


def main() -> None:
    refused("nothing loaded", "mv.move-enable")
    motion, halui, axisui = (hal.component(n) for n in ("motion", "halui", "axisui"))
    motion.newpin("motion-enabled", hal.HAL_BIT, hal.HAL_OUT)
    halui.newpin("program.is-paused", hal.HAL_BIT, hal.HAL_OUT)
    halui.newpin("program.resume", hal.HAL_BIT, hal.HAL_IN)
    axisui.newpin("resume-inhibit", hal.HAL_BIT, hal.HAL_IN)
    for component in (motion, halui, axisui):
        component.ready()
    clock.join("operator", 500)
    motion["motion-enabled"] = True
    commands = Path(folder, "commands.hal")
    commands.write_text(HAL + "setp mv.offset-max-1 3\nnet taken mv.offset-in-1\n")
    status, errors = command("halcmd", "-f", str(commands))
    if status:
        mistakes.append(errors)
    refusals()
    on_pause(halui, motion)
    always(halui)
    display()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            main()
        finally:
            session.command(folder, "realtime", "stop")
    print("\n".join(mistakes) or "offset, removed, resumed")
    sys.exit(bool(mistakes))
