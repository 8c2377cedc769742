#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""hal_bridge: requests of its inputs, pins set by messages, and the program in a HAL with an INI file."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
sys.path[:0] = [str(TOP / "src/hal/user_comps"), str(TOP / "lib/python")]
import hal_bridge  # noqa: E402

mistakes: list[str] = []
INI = """[TRAJ]
COORDINATES = X Y Y C
[MDI_COMMAND_LIST]
MDI_COMMAND_HOME = G0 X0,Home
MDI_COMMAND_1 = G0 Y0
[MACROS]
MACRO = other a
MACRO_COMMAND_7 = probe
"""


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


class Pins(dict):
    def newpin(self, name: str, kind: int, direction: int) -> None:
        self[name] = 0


def requests() -> None:
    sent: list[tuple[str, object]] = []
    pins = Pins()
    bridge = hal_bridge.Bridge(pins, "xc", ["ini-mdi-cmd-1", "ini-macro-cmd-load"], lambda *a: sent.append(a))
    for pin, value, want in (
            ("axis-c-select", 1, [("set_selected_axis", "C")]), ("axis-c-select", 0, []),
            ("cycle-start-in", 1, [("request_cycle_start", True)]), ("cycle-start-in", 0, []),
            ("cycle-pause-in", 1, [("request_cycle_pause", 1)]), ("cycle-pause-in", 0, [("request_cycle_pause", 0)]),
            ("jog-rate-in", 12.5, [("set_jograte", 12.5)]),
            ("jog-rate-angular-in", 3.0, [("set_jograte_angular", 3.0)]),
            ("ok-in", 1, [("request_ok", True)]), ("cancel-in", 1, [("request_cancel", True)]),
            ("shutdown-in", 1, [("request_shutdown", True)]),
            ("reload-display-in", 1, [("request_reload_display", True)]),
            ("ini-mdi-cmd-1", 1, [("request_macro_call", "ini-mdi-cmd-1")]),
            # characters of "macro-cmd-" go at both ends: "oad" of load
            ("ini-macro-cmd-load", 1, [("request_macro_call", "ini-macro-cmd-l")])):
        sent.clear()
        pins[pin] = value
        bridge.step()
        check(f"{pin}={value}", sent, want)
        bridge.step()
        check(f"{pin} unchanged", sent, want)
    for name, arguments, pin, want in (
            ("jograte-changed", [55], "jog-rate", 55.0), ("jograte-angular-changed", [5.5], "jog-rate-angular", 5.5),
            ("jogincrements-changed", [[0.1, "0.1 mm"]], "jog-increment", 0.1),
            ("jogincrement-angular-changed", [[2, "2"]], "jog-increment-angular", 2.0),
            ("joint-selection-changed", [2], "joint-selected", 2),
            ("axis-selection-changed", ["C"], "axis-c-is-selected", True),
            ("axis-selection-changed", ["X"], "axis-c-is-selected", False), ("unknown", [1], "jog-rate", 55.0)):
        bridge.receive(json.dumps({"MESSAGE": name, "ARGS": arguments}).encode())
        check(name, pins[pin], want)
    for bad in (b"{", b"[]", b'{"MESSAGE": "jograte-changed"}', b'{"MESSAGE": "jograte-changed", "ARGS": ["fast"]}'):
        try:
            bridge.receive(bad)
            mistakes.append(f"{bad!r} accepted")
        except ValueError:
            pass


def screen(session: Session, folder: str) -> None:
    """What a screen does: reads requests, tells what was chosen on it."""
    try:
        import zmq
    except ImportError:
        print("python3-zmq is not installed", file=sys.stderr)
        return
    read, write = zmq.Context.instance().socket(zmq.SUB), zmq.Context.instance().socket(zmq.PUB)
    read.setsockopt(zmq.SUBSCRIBE, b"STATUSREQUEST")
    read.setsockopt(zmq.RCVTIMEO, 20000)
    read.connect(f"ipc://{folder}/w")
    write.bind(f"ipc://{folder}/r")

    def hal(*words: str) -> str:
        return session.command(folder, "halcmd", *words)[1].strip()

    def tell(name: str, *arguments: object) -> None:
        write.send_multipart([b"QTVCP", json.dumps({"MESSAGE": name, "ARGS": arguments}).encode()])

    def told(pin: str, want: str, name: str, *arguments: object) -> None:
        """A message is lost while the other side is still connecting: it is said again."""
        for _ in range(2000):
            tell(name, *arguments)
            session.command(folder, "kerf-clock", "sleep", "0.1")
            if hal("getp", pin) == want:
                return
        mistakes.append(f"{pin} is {hal('getp', pin)}, told {name} {arguments}")
    told("bridge.jog-rate", "120", "jograte-changed", 120)
    told("bridge.jog-increment", "0.1", "jogincrements-changed", [0.1, "0.1 mm"])
    told("bridge.joint-selected", "2", "joint-selection-changed", 2)
    told("bridge.axis-y-is-selected", "TRUE", "axis-selection-changed", "Y")
    told("bridge.axis-y-is-selected", "FALSE", "axis-selection-changed", "X")
    while not read.poll(20):        # until the subscription has arrived
        hal("setp", "bridge.ok-in", "0")
        session.command(folder, "kerf-clock", "sleep", "0.2")
        hal("setp", "bridge.ok-in", "1")
        session.command(folder, "kerf-clock", "sleep", "0.2")
    got = []
    for pin, value in (("cycle-start-in", "1"), ("cycle-pause-in", "1"), ("cycle-pause-in", "0"),
                       ("jog-rate-in", "77.5"), ("axis-c-select", "1"), ("ini-mdi-cmd-HOME", "1")):
        hal("setp", f"bridge.{pin}", value)
        session.command(folder, "kerf-clock", "sleep", "0.2")
    while len(got) < 6:
        topic, text = read.recv_multipart()
        message = json.loads(text)
        if message["FUNCTION"] != "request_ok":
            got.append((topic, message["FUNCTION"], message["ARGS"]))
    check("requests", got, [(b"STATUSREQUEST", name, value) for name, value in (
        ("request_cycle_start", True), ("request_cycle_pause", True), ("request_cycle_pause", False),
        ("set_jograte", 77.5), ("set_selected_axis", "C"), ("request_macro_call", "ini-mdi-cmd-HOME"))])
    read.close()
    write.close()


def program() -> None:
    session = Session("bridge")
    with tempfile.TemporaryDirectory() as folder:
        try:
            session.command(folder, "realtime", "start")
            ini = Path(folder, "machine.ini")
            ini.write_text(INI)
            session.env["INI_FILE_NAME"] = str(ini)
            status, _, errors = session.command(folder, "halcmd", "loadusr", "-Wn", "bridge", "hal_bridge",
                                                f"--readport=ipc://{folder}/r", f"--writeport=ipc://{folder}/w")
            if status:
                mistakes.append(errors)
            shown = session.command(folder, "halcmd", "-s", "show", "pin")[1].split()
            names = {w.removeprefix("bridge.") for w in shown if w.startswith("bridge.")}
            wanted = {*hal_bridge.PLAIN_INPUTS, *hal_bridge.BOTH_EDGES, *hal_bridge.VALUES,
                      *hal_bridge.MESSAGES.values(), "ini-mdi-cmd-HOME", "ini-mdi-cmd-1", "ini-macro-cmd-7"}
            wanted |= {f"axis-{a}-{what}" for a in "xyc" for what in ("select", "is-selected")}
            check("pins", names ^ wanted, set())
            session.command(folder, "kerf-clock", "sleep", "0.3")
            screen(session, folder)
            if session.command(folder, "halcmd", "unloadusr", "bridge")[0]:
                mistakes.append("bridge has ended by itself")
            session.command(folder, "halcmd", "waitusr", "-i", "bridge")
        finally:
            session.command(folder, "realtime", "stop")


if __name__ == "__main__":
    requests()
    program()
    print("\n".join(mistakes) or "requested, shown, lives")
    sys.exit(bool(mistakes))
