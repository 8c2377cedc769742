#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A panel larger than the screen, and one larger than its -g: pointer and keyboard of the X server, pins of HAL."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, "../../components")
from harness import Session  # noqa: E402

BUTTONS, COLUMNS = 40, 12
WHEEL_UP, WHEEL_DOWN = 4, 5
mistakes: list[str] = []
session = Session("pyvcplarge")


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def x(*words: object) -> str:
    return subprocess.run(["xdotool", *map(str, words)], check=True, capture_output=True, text=True, timeout=60).stdout


class Panel:
    def __init__(self, folder: str, name: str, *options: str) -> None:
        self.folder, self.name = folder, name
        session.command(folder, "env", "-C", folder, "halcmd", "loadusr", "-Wn", name, "pyvcp", *options, "-c", name,
                        f"{name.rstrip('0123456789')}.xml")
        self.window = x("search", "--sync", "--onlyvisible", "--name", f"^{name}$").split()[0]
        self.settle()
        x("windowfocus", "--sync", self.window)

    def settle(self) -> None:
        """Until the window has its size."""
        told = ""
        while told != (told := x("getwindowgeometry", self.window)):
            time.sleep(0.3)
        place = [int(n) for n in re.findall(r"-?\d+", told.partition("Position")[2])]
        self.x, self.y, self.width, self.height = place[0], place[1], place[-2], place[-1]

    def pins(self) -> dict[str, str]:
        rows = (row.split() for row in session.command(self.folder, "halcmd", "-s", "show", "pin", self.name)[1].splitlines())
        return {row[4].partition(".")[2]: row[3] for row in rows if len(row) > 4}

    def pressed(self) -> list[str]:
        return [name for name, value in self.pins().items() if value == "TRUE"]

    def press(self, at_x: int, at_y: int, want: str) -> None:
        """Holds a button until its pin is seen."""
        x("mousemove", self.x + at_x, self.y + at_y, "mousedown", 1)
        self.see(f"pressed at {at_x},{at_y}", [want])
        x("mouseup", 1)
        self.see("let go", [])

    def see(self, what: str, want: list[str]) -> None:
        end = time.monotonic() + 10
        while self.pressed() != want and time.monotonic() < end:
            time.sleep(0.05)
        check(f"{self.name} {what}", self.pressed(), want)

    def wheel(self, button: int, times: int, *at: int, shift: bool = False) -> None:
        x("mousemove", self.x + at[0], self.y + at[1])
        time.sleep(0.1)
        x(*(["keydown", "shift"] if shift else []), "click", "--repeat", times, "--delay", 5, button,
          *(["keyup", "shift"] if shift else []))
        time.sleep(0.5)         # of the outside world: nothing tells when it has scrolled

    def close(self) -> None:
        session.command(self.folder, "halcmd", "unloadusr", self.name)
        session.command(self.folder, "halcmd", "waitusr", "-i", self.name)


def tall(folder: str) -> None:
    p = Panel(folder, "tall", "-g", "+0+0")
    check("on the screen", p.height <= 400 and p.width < 300, True)
    p.press(p.width // 3, 10, "b0")
    p.wheel(WHEEL_DOWN, 60, p.width // 3, p.height // 2)
    check("the wheel presses nothing and sets nothing", (p.pressed(), float(p.pins()["number"])), ([], 50.0))
    p.press(p.width // 3, p.height - 10, f"b{BUTTONS - 1}")
    p.wheel(WHEEL_UP, 60, p.width // 3, p.height // 2)
    p.press(p.width // 3, 10, "b0")
    # the bar, from its upper end to the lower one
    x("mousemove", p.x + p.width - 7, p.y + 30, "mousedown", 1, "mousemove", p.x + p.width - 7, p.y + p.height - 2, "mouseup", 1)
    time.sleep(0.5)
    p.press(p.width // 3, p.height - 10, f"b{BUTTONS - 1}")
    # the keyboard: Tab goes to the first one, Shift-Tab from there to the last
    x("mousemove", p.x + p.width - 7, p.y + 2)
    x("key", "--delay", 100, "Tab")
    x("keydown", "space")
    p.see("by the keyboard", ["b0"])
    x("keyup", "space")
    x("mousemove", p.x + p.width // 3, p.y + p.height // 2)
    p.press(p.width // 3, 10, "b0")
    x("key", "--delay", 100, "shift+Tab")
    time.sleep(0.3)
    p.press(p.width // 3, p.height - 10, f"b{BUTTONS - 1}")
    p.close()


def wide(folder: str) -> None:
    p = Panel(folder, "wide", "-g", "300x200+0+0")
    check("-g", (p.width, p.height), (300, 200))
    p.press(20, 45, "c0")
    p.wheel(WHEEL_DOWN, 60, 100, 45, shift=True)
    p.press(p.width - 20, 45, f"c{COLUMNS - 1}")
    p.wheel(WHEEL_UP, 60, 100, 45)       # the only way that it scrolls
    p.press(20, 45, "c0")
    # the wheel over a widget that uses it
    p.wheel(WHEEL_UP, 3, 20, 140)
    check("wheel of a spinbox", float(p.pins()["number"]), 3.0)
    p.close()


def ended(folder: str) -> None:
    """Signals, which come between any two steps, end a panel without a word."""
    for number in range(5):
        with open(Path(folder, "told"), "w+") as told:
            panel = subprocess.Popen(["pyvcp", "-c", "ended", "wide.xml"], cwd=folder, env=session.env, stderr=told)
            end = time.monotonic() + 30
            while "c0" not in session.command(folder, "halcmd", "-s", "show", "pin", "ended")[1] and time.monotonic() < end:
                time.sleep(0.05)
            time.sleep(0.3 + 0.03 * number)
            panel.terminate()
            check("status at the end", panel.wait(30), 0)
            told.seek(0)
            check("told at the end", told.read(), "")


def main(folder: str) -> None:
    rows = "".join(f"<button><halpin>'b{n}'</halpin><text>'Button {n}'</text></button>"
                   + ("<spinbox><halpin>'number'</halpin><initval>50</initval></spinbox>" if n == 20 else "")
                   for n in range(BUTTONS))
    Path(folder, "tall.xml").write_text(f"<pyvcp><vbox>{rows}</vbox></pyvcp>")
    columns = "".join(f"<button><halpin>'c{n}'</halpin><text>'Button {n}'</text></button>" for n in range(COLUMNS))
    Path(folder, "wide.xml").write_text(f"<pyvcp><vbox><hbox>{columns}</hbox><spinbox><halpin>'number'</halpin></spinbox>"
                                        "</vbox></pyvcp>")
    tall(folder)
    wide(folder)
    ended(folder)


if __name__ == "__main__":
    os.environ.update(KERF_SCALE="1", KERF_TOUCH="0")
    with tempfile.TemporaryDirectory() as scratch:
        try:
            session.command(scratch, "realtime", "start")
            main(scratch)
        finally:
            session.command(scratch, "realtime", "stop")
    print("\n".join(mistakes) or "reached")
    sys.exit(bool(mistakes))
