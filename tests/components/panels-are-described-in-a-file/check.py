#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""panelui: its file and the mistakes in it, scan codes, pins, commands, the program with a sampler, and ZeroMQ."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
session = Session("panel")
os.environ.update(session.env)
sys.path[:0] = [str(TOP / "lib/python")]
from panelui import config, keys, panel  # noqa: E402

mistakes: list[str] = []
NAMES = {"increment", "increment-not", "small-state", "small-state-not", "large", "large-not", "gear",
         "gear-not", "second", "second-not", "light", "light-not", "left-state", "left-state-not", "right", "right-not",
         "horn", "horn-not", "unused", "unused-not"}


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


class Pins(dict):
    def newpin(self, name: str, kind: int, direction: int) -> None:
        self[name] = 0


def file_is_read() -> config.Config:
    settings = config.load("_panelui.ini")
    check("prefix", (settings.prefix, settings.topic, settings.socket, settings.zmq),
          ("desk", "SCREEN", "tcp://127.0.0.1:5690", False))
    first = next(b for b in settings.buttons if b.name == "first")
    check("command", first.commands, (None, ("Shift", ["1", "a, b"])))
    check("metadata", first.metadata["TRUE_COMMAND"], 'Shift, 1, "a, b"')
    for text, part in (
            ("x = 1", ":1: x: stands in no section"), ("[WRONG]", ":1: [WRONG]: unknown; known: HAL_PREFIX"),
            ("[TOGGLE_BUTTONS", ":1: [TOGGLE_BUTTONS: [SECTION]"),
            ("[TOGGLE_BUTTONS]\n[[[a]]]", ":2: [[[a]]]: stands in no"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nKEY = R8C0", ":3: KEY = R8C0: R0C0 to R7C7"),
            ("[TOGGLE_BUTTONS]\n[[a]]\n[[a]]", ":3: [[a]]: the name is there twice (line 2)"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nKEY=R1C1\n[[b]]\nKEY=r1c1", ":5: KEY = R1C1: is taken in line 3"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nCOLOR = red", ":3: COLOR: unknown in [a]; known: KEY"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nOUTPUT = REAL", ":3: OUTPUT = REAL: S32 or U32"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nOUTPUT = U32\nTRUE_STATE = -1", ":4: TRUE_STATE = -1: 0 to 4294967295"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nOUTPUT = S32\nTRUE_STATE = 1.5", ":4: TRUE_STATE = 1.5: a number"),
            ("[TOGGLE_BUTTONS]\n[[a b]]", ":2: a b: the name becomes a pin"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nSTATUS_PIN = maybe", ":3: STATUS_PIN = maybe: True or False"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nthis", ":3: this: NAME = VALUE"),
            ("[TOGGLE_BUTTONS]\n[[a]]\nKEY = NONE\nKEY = NONE", ":4: KEY: is there twice (line 3)"),
            ("[RADIO_BUTTONS]\n[[g]]\nOUTPUT = S32", ":2: g: needs DEFAULT"),
            ("[RADIO_BUTTONS]\n[[g]]\nDEFAULT = a\n[[[a]]]", ":2: g: needs OUTPUT = S32 or U32 or FLOAT"),
            ("[RADIO_BUTTONS]\n[[g]]\nOUTPUT = BIT\nDEFAULT = a\n[[[a]]]", ":3: OUTPUT = BIT: S32 or U32 or FLOAT"),
            ("[RADIO_BUTTONS]\n[[g]]\nOUTPUT = S32\nDEFAULT = b\n[[[a]]]", ":4: DEFAULT = b: one of a is"),
            ("[MOMENTARY_BUTTONS]\n[[a]]\n[[[b]]]", ":3: [b]: nothing is expected inside"),
            ("[HAL_PREFIX]\nNAME = a b", ":2: NAME = a b: letters")):
        try:
            config.Reader("f").read(config.parse("f", text))
            mistakes.append(f"accepted: {text!r}")
        except config.ConfigError as error:
            if part not in str(error):
                mistakes.append(f"{text!r}: {error}")
    return settings


def codes() -> None:
    pad = keys.Keypad()
    for code, want in ((0x40, None), (0, None), (0xC0, (0, 0, True)), (0xC0, None), (0xFF, (7, 7, True)),
                       (0xC8, "more than 2"), (0x88, None), (0xBF, (7, 7, False)), (0xC8, (1, 0, True)),
                       (0x80, (0, 0, False)), (0x1C0, "rows and"), (0x3F, "rows and")):
        try:
            got = pad.take(code)
        except keys.CodeError as error:
            got = str(error)
        if isinstance(want, str) and isinstance(got, str):
            want = got if want in got else want
        check(f"code {code:#x}", got, want)


def buttons(settings: config.Config) -> None:
    pins, called = Pins(), []
    panel.make_pins(pins, settings)
    board = panel.Panel(pins, settings, lambda button, name, argument: called.append((button.name, name, argument)))
    check("pins", set(pins) ^ NAMES, set())

    def press(row: int, column: int, *names: str) -> list[object]:
        board.key(row, column, True)
        now = [pins[n] for n in names]
        board.key(row, column, False)
        return now
    check("start", [pins[n] for n in ("increment", "increment-not", "small-state", "large", "large-not",
                                      "gear", "gear-not", "light", "light-not", "left-state-not", "right", "right-not",
                                      "horn", "horn-not")],
          [0.01, -0.01, True, -3, 16, 2, 2**32 - 2, True, False, True, 0, 7, -1.5, 1.5])
    check("radio", press(0, 1, "increment", "increment-not", "small-state", "large", "large-not"),
          [2.5, -2.5, False, 16, -3])
    check("again", press(0, 1, "increment"), [2.5])
    check("gear", (press(0, 2, "gear", "second", "second-not"), called),
          ([1, False, True], [("first", "shift", ["1", "a, b"])]))
    check("and back", (press(0, 3, "gear", "second"), len(called)), ([2, True], 1))
    called.clear()
    check("toggle", press(7, 7, "light", "light-not") + press(7, 7, "light"), [False, True, True])
    check("left", press(1, 0, "left-state", "right"), [True, 0])
    check("right excludes left", press(1, 1, "left-state", "right", "right-not"), [False, 7, 0])
    check("calls", called, [("left", "left_on", None), ("left", "left_off", None)])
    check("momentary", (press(2, 0, "horn", "horn-not"), pins["horn"], pins["horn-not"]), ([1.5, -1.5], -1.5, 1.5))
    check("no such key", press(6, 6, "horn"), [-1.5])


def zeromq() -> None:
    try:
        import zmq
    except ImportError:
        return
    text = "[ZMQ_SETUP]\nENABLE=1\n[TOGGLE_BUTTONS]\n[[a]]\nKEY=R0C0\nOUTPUT=ZMQ\nTRUE_FUNCTION=set_it, 5, x\nFALSE_FUNCTION=clear_it\n"
    settings = config.Reader("f").read(config.parse("f", text))
    with tempfile.TemporaryDirectory() as folder:
        publisher = panel.Zmq(settings.topic, f"ipc://{folder}/z")
        reader = zmq.Context.instance().socket(zmq.SUB)
        reader.setsockopt(zmq.SUBSCRIBE, b"QTVCP")
        reader.setsockopt(zmq.RCVTIMEO, 20000)
        reader.connect(f"ipc://{folder}/z")
        while not reader.poll(20):      # until the subscription has arrived
            publisher.send("hello", [])
        board = panel.Panel(Pins(), settings, None, publisher)
        board.key(0, 0, True)
        board.key(0, 0, False)
        board.key(0, 0, True)
        got = []
        while len(got) < 2:
            topic, text = reader.recv_multipart()
            if json.loads(text)["FUNCTION"] != "hello":
                got.append((topic, json.loads(text)))
        check("published", got,
              [(b"QTVCP", {"FUNCTION": "set_it", "ARGS": ["5", "x"]}),
               (b"QTVCP", {"FUNCTION": "clear_it", "ARGS": []})])
        reader.close()
        publisher.socket.close()


HANDLER = """
def get_handlers(stat, cmd, commands, master):
    return [Handler(commands)]
class Handler:
    def __init__(self, commands):
        self.parent, self.cycles = commands, 0
    def shift(self, button, argument):
        print("shift", argument, button.metadata["KEY"])
    def left_on(self, button, argument):
        raise RuntimeError("broken lamp")
    def LEFT_OFF(self, button, argument):
        print("left off", argument)
    def periodic(self):
        self.cycles += 1
        if self.cycles == 1:
            print("periodic")
"""


def program() -> None:
    with tempfile.TemporaryDirectory() as folder:
        def run(*words: str, feed: str | None = None) -> tuple[int, str, str]:
            return session.command(folder, *words, feed=feed)
        conf = Path(folder, "conf")
        conf.mkdir()
        session.env["CONFIG_DIR"] = str(conf)
        for words, part in ((["-c", "8"], "ERROR: -c 8: a channel"), (["-n", "0"], "ERROR: -n 0"),
                            (["-x"], "ERROR: unknown option"), (["a", "b"], "one output file"),
                            ([], "no _panelui.ini in")):
            session.env["HOME"] = str(conf)
            status, _, errors = run("env", "-C", str(conf), "panelui", *words)
            if status != 1 or part not in errors:
                mistakes.append(f"panelui {words}: {status} {errors}")
        conf.joinpath("_panelui.ini").write_text(Path("_panelui.ini").read_text())
        status, _, errors = run("panelui")
        if status != 1 or "button left: there is no command LEFT_ON" not in errors and "no command Shift" not in errors:
            mistakes.append(f"unknown command: {status} {errors}")
        conf.joinpath("panelui_handler.py").write_text(HANDLER)
        try:
            run("realtime", "start")
            status, _, errors = run("panelui")
            if status != 1 or "sampler" not in errors:
                mistakes.append(f"no sampler: {status} {errors}")
            commands = Path(folder, "commands.hal")
            commands.write_text("loadrt threads name1=thread period1=1000000\nloadrt streamer depth=100 cfg=u\n"
                                "loadrt sampler depth=1000 cfg=u\nnet code streamer.0.pin.0 sampler.0.pin.0\n"
                                "addf streamer.0 thread\naddf sampler.0 thread\n"
                                f"loadusr -W panelui -d {folder}/log\n")
            status, _, errors = run("halcmd", "-f", str(commands))
            if status:
                mistakes.append(errors)
            codes = [0x40] * 5 + [0xC1, 0x40, 0x81, 0xC2, 0x82, 0xC8, 0x88, 0x40, 0xC8, 0xD0, 0xFF, 0x90,
                                  0x88] + [0x40] * 300
            run("halstreamer", feed="".join(f"{c}\n" for c in codes[:60]))
            run("halcmd", "start")
            run("kerf-clock", "sleep", "0.5")
            shown = run("halcmd", "-s", "show", "pin")[1]
            check("pins", {w[5:] for w in shown.split() if w.startswith("desk.")} ^ NAMES, set())
            check("owner", {line.split()[0] for line in shown.splitlines() if "desk." in line}, {"_panel_ui_py_"})
            check("values", [run("halcmd", "getp", f"desk.{n}")[1].strip() for n in
                             ("increment", "large", "gear", "left-state", "horn", "light")],
                             ["2.5", "16", "1", "FALSE", "-1.5", "TRUE"])
            if run("halcmd", "unloadusr", "panelui")[0]:
                mistakes.append("panelui has ended by itself")
            run("halcmd", "waitusr", "-i", "panelui")
            log = Path(folder, "log").read_text()
            for part in ("shift ['1', 'a, b'] R0C2\n", "left off None\n", "panelui: left: left_on", "periodic\n"):
                if part not in log:
                    mistakes.append(f"log without {part!r}: {log}")
            status, _, errors = run("panelui", "-n", "5", "-t", "-v", f"{folder}/log2")
            check("ends after five samples", (status, errors), (0, ""))
        finally:
            run("realtime", "stop")
        for text, status, part in ((Path("_panelui.ini").read_text(), 0, "9 buttons, 2 groups"),
                                   ("[X]", 1, ":1: [X]: unknown")):
            conf.joinpath("_panelui.ini").write_text(text)
            got = run("pyui", f"{conf}/_panelui.ini")
            if got[0] != status or part not in got[1] + got[2]:
                mistakes.append(f"pyui: {got}")


if __name__ == "__main__":
    buttons(file_is_read())
    codes()
    zeromq()
    program()
    print("\n".join(mistakes) or "read, pressed, refused")
    sys.exit(bool(mistakes))
