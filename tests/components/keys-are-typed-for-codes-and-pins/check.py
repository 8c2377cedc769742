#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""sendkeys with a keyboard made up here; then the program and its pins."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import sendkeys  # noqa: E402

mistakes: list[str] = []
typed: list[tuple[int, bool]] = []
keyboards: list[set[int]] = []


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


class Pins(dict):
    """In place of a component."""

    def newpin(self, name: str, *_: object) -> None:
        assert name not in self
        self[name] = 0

    newparam = newpin


class Keyboard:
    def __init__(self, keys: set[int]):
        keyboards.append(keys)

    def send(self, key: int, pressed: bool) -> None:
        typed.append((key, bool(pressed)))


def keys() -> None:
    p = Pins()
    one = sendkeys.Keys(p, 0, 4, 2, Keyboard)
    p |= {"0.scan-event-01": 30, "0.scan-event-02": 31, "0.pin-event-01": 57, "0.keycode": 0xC1}
    one.step()
    check("not before init", (typed, keyboards, p["0.current-event"]), ([], [], -1))
    p["0.init"] = True
    one.step()
    one.step()
    check("one keyboard", keyboards, [{30, 31, 57}])
    for code, event in ((0x40, -1), (0x81, 1), (0xC2, -1), (0x82, 2), (0xC0, -1), (0x80, 0), (0xCF, -1), (0x8F, 15)):
        p["0.keycode"] = code
        one.step()
        check(f"event of {code:#x}", p["0.current-event"], event)
    check("typed", typed, [(30, True), (30, False), (31, True), (31, False)])
    typed.clear()
    for on in (1, 1, 0):
        p["0.trigger-01"] = p["0.trigger-00"] = on
        one.step()
    check("triggered", typed, [(57, True), (57, False)])
    p["0.init"], p["0.trigger-01"] = False, 1
    one.step()
    check("nothing without init", typed, [(57, True), (57, False)])


def refusal(*words: str) -> str:
    try:
        sendkeys.arguments(list(words))
    except SystemExit as end:
        return str(end.code)
    return "nothing refused"


def program() -> None:
    session = Session("keys")
    with tempfile.TemporaryDirectory() as folder:
        def halcmd(*words: str) -> str:
            return session.command(folder, "halcmd", *words)[1].strip()
        try:
            session.command(folder, "realtime", "start")
            halcmd("loadusr", "-W", "sendkeys", "config=s2t1,1")
            names = [line.split()[-1] for kind in ("pin", "param")
                     for line in halcmd("-s", "show", kind, "sendkeys").splitlines()]
            check("pins", names, [f"sendkeys.{n}" for n in (
                "0.current-event", "0.init", "0.keycode", "0.trigger-00", "1.current-event", "1.init", "1.keycode",
                "0.pin-event-00", "0.scan-event-00", "0.scan-event-01", "1.scan-event-00")])
            halcmd("setp", "sendkeys.0.keycode", "0x85")
            session.command(folder, "kerf-clock", "sleep", "0.01")
            check("current-event", halcmd("getp", "sendkeys.0.current-event"), "5")
            if os.access("/dev/uinput", os.W_OK):
                halcmd("unloadusr", "sendkeys")
            else:
                halcmd("setp", "sendkeys.0.init", "1")      # it says why, and ends
            halcmd("waitusr", "-i", "sendkeys")
        finally:
            session.command(folder, "realtime", "stop")


if __name__ == "__main__":
    keys()
    check("config", sendkeys.arguments(["config=s8t5,16,t12"]), [(8, 5), (16, 0), (0, 12)])
    check("bad config", refusal("config=s8x5"),
          "sendkeys: 's8x5' in config=s8x5: sN (scan codes) and tN (triggers) are expected")
    check("too many", refusal("config=65"), "sendkeys: '65' in config=65: at most 64 scan codes")
    check("no config", refusal() == sendkeys.__doc__, True)
    program()
    print("\n".join(mistakes) or "all typed")
    sys.exit(bool(mistakes))
