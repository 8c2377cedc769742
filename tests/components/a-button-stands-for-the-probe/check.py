#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""simulate_probe: the button, the pulse, and its refusals. A component made here owns motion.probe-input."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("probe")
os.environ.update(session.env)
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import tkinter as tk  # noqa: E402

import hal  # noqa: E402
import simulate_probe  # noqa: E402

mistakes: list[str] = []
PIN = "motion.probe-input"


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def refused(folder: str, what: str, part: str) -> None:
    status, out, errors = session.command(folder, "simulate_probe")
    if status != 1 or part not in out + errors:
        mistakes.append(f"{what}: {status} {out} {errors}")


def window(motion: object) -> None:
    motion["probe-input"] = True
    root = tk.Tk()
    item = simulate_probe.find()
    check("start", hal.get_p(PIN), False)
    probe = simulate_probe.Probe(item)
    window = simulate_probe.Window(root, probe)
    root.update()

    def button(event: str) -> tuple[object, str, str]:
        window.button.event_generate(event)
        root.update()
        return hal.get_p(PIN), window.button["text"], window.button["bg"]
    grey = window.color
    for _ in range(2):
        check("pressed", button("<ButtonPress-1>"), (True, "ProbeON", "red"))
        check("released", button("<ButtonRelease-1>"), (False, "ProbeOFF", grey))
    window.check.invoke()
    written = []
    put, item.set = item.set, lambda value: (written.append(value), put(value))
    check("pulse", button("<ButtonPress-1>"), (False, "ProbeON", "red"))
    check("edges", written, [True, False])
    while window.button["text"] != "ProbeOFF":      # after a while
        root.update()
    button("<ButtonRelease-1>")
    window.check.invoke()
    check("pressed again", button("<ButtonPress-1>")[0], True)
    window.close()
    check("closed", hal.get_p(PIN), False)
    root = tk.Tk()
    simulate_probe.Window(root, probe)
    motion.exit()
    root.after(30_000, lambda: (mistakes.append("the window stays open"), root.destroy()))
    root.mainloop()         # closes itself: the pin is gone


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            refused(folder, "no controller", "Is LinuxCNC running?")
            motion = hal.component("motion")
            motion.newpin("probe-input", hal.HAL_BIT, hal.HAL_IN)
            motion.ready()
            session.command(folder, "halcmd", "net", "touch", PIN)
            refused(folder, "connected", f"The pin {PIN} is currently connected to a signal")
            session.command(folder, "halcmd", "unlinkp", PIN)
            screen = session.env.pop("DISPLAY")
            refused(folder, "no display", "no display")
            session.env["DISPLAY"] = screen
            sys.stdout = open(os.devnull, "w")
            window(motion)
            sys.stdout = sys.__stdout__
        finally:
            session.command(folder, "realtime", "stop")
    print("\n".join(mistakes) or "touched, released, refused")
    sys.exit(bool(mistakes))
