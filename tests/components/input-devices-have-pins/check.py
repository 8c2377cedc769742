#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""hal_input with a device made up here: pins and their first values, events, choosing a device, losing it (FP-156)."""

from __future__ import annotations

import contextlib
import errno
import io
import sys
from pathlib import Path

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import hal_input  # noqa: E402

mistakes: list[str] = []


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


class Pins(dict):
    """In place of a component."""

    def newpin(self, name: str, *_: object) -> None:
        assert name not in self
        self[name] = None

    newparam = newpin


class Pad:
    """A game pad with a wheel and a LED."""

    def __init__(self, path: str):
        if path == "locked":
            raise PermissionError(13, "Permission denied")
        self.path, self.phys = path, "usb-1/input0"
        self.name = {"a": "Pad of A", "b": "Pad of B", "c": "Keyboard"}.get(path, "none")
        self.id, self.numbers = "Bus=0003 Vendor=046d Product=c21%s Version=0110" % path, f"046d:c21{path}"
        self.queue: list[tuple[int, int, int]] = []
        self.leds: list[tuple[int, bool]] = []
        self.grabbed = self.closed = False
        self.down: set[int] = set()
        self.gone = 0

    def codes(self, kind: str) -> list[int]:
        return {"K": [0x130, 0x120, 30, 760], "R": [8], "A": [0], "L": [1]}[kind]

    def axis(self, code: int) -> tuple[int, ...]:
        return 128, 0, 255, 2, 15

    def events(self) -> list[tuple[int, int, int]]:
        if self.gone:
            raise OSError(self.gone, "No such device")
        found, self.queue = self.queue, []
        return found

    def pressed(self) -> set[int]:
        return self.down

    def set_led(self, code: int, on: bool) -> None:
        self.leds.append((code, on))

    def grab(self) -> None:
        self.grabbed = True

    def close(self) -> None:
        self.closed = True


def pins() -> None:
    pad, p = Pad("a"), Pins()
    one = hal_input.Input(p, 0, pad, "KRAL")
    for name in ("btn-south", "btn-a", "btn-trigger", "key-a", "key-760"):
        check(name, (p["0." + name], p[f"0.{name}-not"]), (False, True))
    check("axis", [p["0.abs-x-" + n] for n in ("counts", "scale", "offset", "fuzz", "flat", "min", "max")],
          [128, 127.5, 127.5, 2, 15, 0, 255])
    check("wheel", [p["0.rel-wheel-" + n] for n in ("counts", "position", "reset", "scale")], [0, 0.0, False, 1.0])
    check("only keys", sorted(n for n in one_of("K") if "key-a" not in n)[:1], ["1.btn-a"])
    check("no axes", [n for n in one_of("K") if "abs" in n or "rel" in n or "led" in n], [])
    one.step()
    check("at rest", (p["0.abs-x-position"], pad.leds), (0.5 / 127.5, [(1, False)]))
    pad.queue = [(1, 0x130, 1), (1, 30, 2), (2, 8, -1), (2, 8, -2), (3, 0, 255), (0, 0, 0), (1, 999, 1)]
    p["0.led-capsl"], p["0.rel-wheel-scale"] = True, 2.0
    one.step()
    check("pressed", [p["0." + n] for n in ("btn-a", "btn-south", "btn-south-not", "key-a")], [True, True, False, True])
    check("turned", (p["0.rel-wheel-counts"], p["0.rel-wheel-position"]), (-3, -1.5))
    check("right", (p["0.abs-x-counts"], p["0.abs-x-position"], p["0.abs-x-is-pos"], p["0.abs-x-is-neg"]),
          (255, 1.0, True, False))
    pad.queue = [(3, 0, 253), (1, 0x130, 0)]
    p["0.rel-wheel-reset"], p["0.led-capsl-invert"], p["0.abs-x-scale"] = True, True, -127.5
    one.step()
    check("within fuzz", (p["0.abs-x-counts"], p["0.abs-x-is-neg"]), (255, True))
    check("reset", p["0.rel-wheel-position"], 0.0)
    check("released", p["0.btn-a"], False)
    pad.queue = [(3, 0, 140)]
    one.step()
    check("flat", (p["0.abs-x-counts"], p["0.abs-x-position"]), (127, 0.5 / 127.5))
    check("led", pad.leds, [(1, False), (1, True), (1, False)])


def one_of(kinds: str) -> list[str]:
    p = Pins()
    hal_input.Input(p, 1, Pad("a"), kinds)
    return sorted(p)


def refusal(call: object, *words: object) -> str:
    try:
        call(*words)
    except SystemExit as end:
        return str(end.code).split("\n")[0]
    return "nothing refused"


def choice() -> None:
    paths = ["locked", "c", "a", "b"]
    for spec, path in (("Pad", "a"), ("Pad:1", "b"), ("*of B", "b"), ("046d:c21b", "b"), ("Product=c21c", "c"),
                       ("usb-1/input0:2", "b"), ("Keyboard", "c")):
        check(spec, hal_input.find(spec, Pad, paths).path, path)
    check("number", hal_input.find("7", Pad).path, "/dev/input/event7")
    check("exclusive", hal_input.find("+Pad", Pad, paths).grabbed, True)
    check("none", refusal(hal_input.find, "Mouse", Pad, paths),
          "hal_input: No input device matching 'Mouse' was found (4 devices checked)")
    check("not allowed", refusal(hal_input.find, "Pad", Pad, ["locked"]),
          "hal_input: none of 1 input devices can be opened: may this user read /dev/input/event*?")
    check("words", hal_input.arguments(["-KA", "Pad", "3", "-L", "+x"]), [("Pad", "KA"), ("3", "KRAL"), ("+x", "L")])
    check("letters", refusal(hal_input.arguments, ["-X", "Pad"]), "hal_input: -X: letters out of KRAL are expected")


def losses() -> None:
    """A hundred times: unplugged with a key down and a stick held, and back, sometimes at another place."""
    hal_input.SEARCH_S = 0.0
    present: list[Pad] = [Pad("a")]
    pad, p = present[0], Pins()
    taken: set[str] = set()
    one = hal_input.Input(p, 0, pad, "KRAL", exclusive=True, taken=taken,
                          again=lambda lost, taken: present[0] if present else None)
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        for n in range(100):
            pad.queue = [(1, 30, 1), (3, 0, 255), (2, 8, 1)]
            one.step()
            check(f"moving {n}", (p["0.key-a"], p["0.abs-x-is-pos"], p["0.connected"]), (True, True, True))
            pad.gone = [errno.ENODEV, errno.EIO, errno.EPROTO][n % 3]
            present.clear()
            for _ in range(3):
                one.step()
                check(f"at rest {n}", (p["0.key-a"], p["0.key-a-not"], p["0.abs-x-is-pos"], p["0.abs-x-position"],
                                       p["0.rel-wheel-counts"], p["0.connected"], taken, pad.closed),
                      (False, True, False, 0.0, n + 1, False, set(), True))
            pad = Pad("a")
            present.append(pad)
            one.step()
            check(f"back {n}", (p["0.key-a"], p["0.abs-x-is-pos"], p["0.connected"], taken, pad.grabbed, pad.leds),
                  (False, False, True, {"a"}, True, [(1, False)]))
        pad.queue = [(1, 30, 1), (1, 0x130, 1)]
        one.step()
        pad.down, pad.queue = {0x130}, [(0, 3, 0)]  # the kernel lost events: a release among them
        one.step()
        check("after lost events", (p["0.key-a"], p["0.btn-a"]), (False, True))
        pad.queue = [(1, 999, 1), (1, 999, 0), (4, 4, 5)]
        one.step()
    lines = said.getvalue().splitlines()
    check("said", (lines[:2], lines[200:]), (["hal_input: Pad of A (a) is lost: No such device",
                                              "hal_input: Pad of A (a) is back"],
                                             ["hal_input: Pad of A: Unexpected event 1 999"]))
    lost = Pad("a")
    check("another one of its kind", hal_input.find_again(lost, {"a"}, Pad, ["a", "b", "c"]), None)
    check("itself", hal_input.find_again(lost, set(), Pad, ["locked", "b", "c", "a"]).path, "a")

    class Moved(Pad):
        def __init__(self, path: str):
            super().__init__("a")
            self.path, self.phys = path, f"usb-{path}/input0"

    check("at another place", hal_input.find_again(lost, set(), Moved, ["7", "8"]).path, "7")
    check("at its own place first", hal_input.find_again(lost, set(), Moved, ["7", "1"]).path, "1")


if __name__ == "__main__":
    pins()
    choice()
    losses()
    print("\n".join(mistakes) or "all pins right")
    sys.exit(bool(mistakes))
