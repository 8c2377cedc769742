# SPDX-License-Identifier: GPL-2.0-or-later
"""The component `lat` of latency-test: shows intervals and jitter, offers a reset.

Its maxima never go down but by reset. Times are ns.
"""

import argparse
import sys
from pathlib import Path

from .. import clock, tkstyle
from ..language import _
from .session import Platform, each_second, facts

PERIOD_MS = 100
ROWS = (("servo", "s"), ("base", "b"))


class Worst:
    """Largest interval and jitter seen of each thread. path: a file that has the largest jitter at any moment."""

    def __init__(self, letters: str, path: Path | None = None):
        self.letters, self.path, self.kept = letters, path, -1
        self.reset()

    def reset(self):
        self.interval = dict.fromkeys(self.letters, 0)
        self.jitter = dict.fromkeys(self.letters, 0)

    def update(self, component):
        for letter in self.letters:
            self.interval[letter] = max(self.interval[letter], component[letter + "l"])
            self.jitter[letter] = max(self.jitter[letter], component[letter + "j"])
        largest = max(self.jitter.values())
        if self.path and largest > self.kept:
            self.path.write_text(f"{largest}\n")
            self.kept = largest


def make_component(hal):
    component = hal.component("lat")
    for _name, letter in ROWS:
        for kind in "ljt":
            component.newpin(letter + kind, hal.HAL_S32, hal.HAL_IN)
    component.newpin("reset", hal.HAL_BIT, hal.HAL_OUT)
    component.ready()
    return component


def run_lines(component, worst: Worst, names: dict, seconds: int):
    def lines(elapsed):
        worst.update(component)
        for letter in worst.letters:
            yield (f"{elapsed:5d} s {names[letter]:>5s} max interval: {worst.interval[letter]:>10d} ns "
                   f"max jitter: {worst.jitter[letter]:>10d} ns last: {component[letter + 't']:>10d} ns")
    each_second(lines, seconds)


class Window:
    """component: the pins, by name."""

    def __init__(self, root, component, worst: Worst, names: dict, periods: dict, platform: Platform):
        from tkinter import ttk
        self.root, self.component, self.worst, self.cells = root, component, worst, {}
        style = tkstyle.apply(root)
        px = style.px
        root.title("HAL Latency Test")
        box = ttk.Frame(root, padding=px(10))
        box.pack(fill="both", expand=True)
        ttk.Label(box, text=_("Let this test run for some minutes while the computer works as hard as it will:\n"
                              "windows are moved, files copied, graphics drawn."), justify="left").grid(row=0, columnspan=4, sticky="w", pady=(0, px(8)))
        for column, text in enumerate(("", _("Max Interval (ns)"), _("Max Jitter (ns)"), _("Last interval (ns)"))):
            ttk.Label(box, text=text, anchor="e").grid(row=1, column=column, padx=px(6), sticky="e")
            box.columnconfigure(column, weight=1)
        for row, letter in enumerate(worst.letters, 2):
            ttk.Label(box, text=_("%s thread (%g µs):")
                      % (names[letter].capitalize(), periods[letter] / 1000)).grid(row=row, column=0, sticky="w")
            for column in (1, 2, 3):
                cell = self.cells[letter, column] = ttk.Label(box, text="0", width=14, relief="sunken", anchor="e",
                                                              style="Value.TLabel", padding=px(4))
                cell.grid(row=row, column=column, padx=px(6), pady=px(2), sticky="ew")
        ttk.Label(box, text="\n".join(facts(platform) + platform.doubts()), justify="left",
                  wraplength=px(560)).grid(row=8, columnspan=4, sticky="w", pady=px(8))
        self.button = ttk.Button(box, text=_("Reset Statistics"), command=self.reset)
        self.button.grid(row=9, columnspan=4)
        root.after(PERIOD_MS, self.tick)

    def reset(self):
        self.component["reset"] = True
        self.worst.reset()
        self.root.after(PERIOD_MS, lambda: self.component.__setitem__("reset", False))

    def tick(self):
        component, worst = self.component, self.worst
        if not component["reset"]:
            worst.update(component)
        for letter in worst.letters:
            for column, value in ((1, worst.interval[letter]), (2, worst.jitter[letter]), (3, component[letter + "t"])):
                self.cells[letter, column]["text"] = str(value)
        self.root.after(PERIOD_MS, self.tick)


def run_window(component, worst: Worst, names: dict, periods: dict, seconds: int):
    root = tkstyle.open_display("latency-test", "Latency-test")
    Window(root, component, worst, names, periods, Platform())
    if seconds:
        root.after(seconds * 1000, root.destroy)
    root.mainloop()


def main(arguments: list[str]) -> int:
    p = argparse.ArgumentParser(prog="latency-panel")
    p.add_argument("--nox", action="store_true")
    p.add_argument("--seconds", type=int, default=0)
    p.add_argument("--worst", type=Path)
    p.add_argument("base_ns", type=int)
    p.add_argument("servo_ns", type=int)
    o = p.parse_args(arguments)
    import hal
    clock.join("lat")
    names, periods = {"s": "servo", "b": "base"}, {"s": o.servo_ns, "b": o.base_ns}
    worst = Worst("bs" if o.base_ns else "s", o.worst)
    component = make_component(hal)
    try:
        if o.nox:
            run_lines(component, worst, names, o.seconds)
        else:
            run_window(component, worst, names, periods, o.seconds)
    except KeyboardInterrupt:
        pass
    finally:
        component.exit()
        clock.leave()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
