#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""axis_bench.py: the AXIS screen in real time, on a display of its own.

Prints the time from the release of a jog key (as the X server tells it) to the stop command, and what the idle screen
and that of a running program take of a processor. Called without arguments it starts the simulated mill with itself as
the display program. PRESSES: how many keys.
"""
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import tkinter as tk
from pathlib import Path

TOP = Path(__file__).resolve().parents[4]
PRESSES, CPU_S = int(os.environ.get("PRESSES", "60")), 10.0


def outside():
    with tempfile.TemporaryDirectory() as folder:
        machine = shutil.copytree(TOP / "configs/sim/mill", f"{folder}/machine")
        Path(folder, "part.ngc").write_text("G21 G90 F2000\n"
                                            + "".join(f"G1 X{n % 50} Y{n % 7}\n" for n in range(4000)) + "M2\n")
        env = os.environ | {"HOME": folder}
        return subprocess.run([TOP / "tests/lib/with-display", "1280x1024", "linuxcnc", "-r", "-D",
                               f"{__file__} {folder}/part.ngc", f"{machine}/mill.ini"], env=env,
                               stdin=subprocess.DEVNULL).returncode


def key(what, name):
    return subprocess.run(["xdotool", what, name], check=True)


def cpu():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


class Bench:
    def __init__(self, root, app):
        self.root, self.app = root, app
        self.released, self.delays = 0.0, []
        root.bind("<KeyRelease>", self.release, add="+")
        real = app.command.jog
        command = app.command

        class Command:
            def __getattr__(self, name):
                return getattr(command, name)

            def jog(_, kind, *args):
                real(kind, *args)
                if kind == 0 and self.released:
                    self.delays.append(time.monotonic() - self.released)
                    self.released = 0.0
        app.command = Command()

    def release(self, event):
        self.released = event.time / 1000        # the server's clock is the monotonic one, in ms

    def jogs(self):
        self.delays.clear()
        for n in range(PRESSES):
            name = ("Right", "Left")[n % 2]
            key("keydown", name)
            yield 0.15
            key("keyup", name)
            yield 0.15 + (n % 10) * 0.007
        d = sorted(self.delays)
        print(f"key release to stop command: {len(d)} of {PRESSES}, median {1000 * statistics.median(d):.1f} ms, "
              f"worst {1000 * d[-1]:.1f} ms", flush=True)

    def share(self, what):
        begin, used = time.monotonic(), cpu()
        yield CPU_S
        print(f"processor, {what}: {100 * (cpu() - used) / (time.monotonic() - begin):.1f} %", flush=True)

    def steps(self):
        app, c = self.app, self.app.command
        yield 3.0
        print("preview by", type(app.preview.picture).__name__, "cycle", app.settings.cycle_ms, "ms", flush=True)
        for name in ("F1", "F2", "ctrl+Home"):
            key("key", name)
            yield 1.0
        while not app.all_homed():
            yield 0.1
        app.estimate.wait()
        self.root.focus_force()
        yield 1.0
        yield from self.share("idle")
        yield from self.jogs()
        key("key", "r")
        yield 1.0
        yield from self.share("program runs")
        c.abort()
        self.root.destroy()


def main():
    from axis.app import App
    ini = sys.argv[sys.argv.index("-ini") + 1]
    root = tk.Tk(className="Axis")
    app = App(root, os.path.abspath(ini))
    app.start([a for a in sys.argv[1:] if a.endswith(".ngc")][0])
    steps = Bench(root, app).steps()

    def go_on():
        wait = next(steps, None)
        if wait is not None:
            root.after(round(1000 * wait), go_on)
    root.after(100, go_on)
    root.mainloop()
    app.close()
    os._exit(0)


if __name__ == "__main__":
    if "-ini" in sys.argv:
        main()
    else:
        sys.exit(outside())
