#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The program pyvcp: mistakes in its file, options, exit status, names, and a panel that lives until it is ended."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, "../../components")
from harness import Session  # noqa: E402

mistakes: list[str] = []
session = Session("pyvcpbad")
CASES = (
    ("<pyvcp>\n<led>\n</pyvcp>", 1, ["Error: could not open bad.xml !", "bad.xml:3:3: mismatched tag"]),
    ("<panel><led/></panel>", 0, ["Error: no pyvcp element in file!"]),
    ("<panels><pyvcp><led/></pyvcp></panels>", 0, ["Error: no pyvcp element in file!"]),
    ("", 1, ["bad.xml:1:1: no element found"]),
    ("<pyvcp>\n<label>\n<text>Hello</text></label></pyvcp>", 1,
     ["Error evaluating xml file:\nWidget label, Property text\nNameError: name 'Hello' is not defined\nbad.xml:2"]),
    ("<pyvcp><vbox>\n<bar><max_>1 +</max_></bar></vbox></pyvcp>", 1,
     ["Widget bar, Property max_\nSyntaxError:", "bad.xml:2"]),
    ("<pyvcp><label text=\"('a'\"/></pyvcp>", 1, ["Widget label, Property text\nSyntaxError:", "bad.xml:1"]),
    ("<pyvcp>\n\n<button><color>'red'</color></button></pyvcp>", 1,
     ["Error constructing button({'color': 'red'}):\nunknown option \"-color\"", "bad.xml:3"]),
    ("<pyvcp><bar><min_>5</min_><max_>5</max_></bar></pyvcp>", 1,
     ["Error constructing bar({'min_': 5, 'max_': 5}):\nmin_ and max_ are both 5"]),
    ("<pyvcp><label>\n<led/></label></pyvcp>", 1, ["bad.xml:2: <led> cannot stand in <label>"]),
    ("<pyvcp><vbox><led><halpin>'a'</halpin></led>\n<button><halpin>'a'</halpin></button></vbox></pyvcp>", 1,
     ["Error constructing button({'halpin': 'a'}):", "bad.xml:2"]),
    ("<pyvcp><multilabel/></pyvcp>", 1, ["legends = [...] is needed"]),
    ("<pyvcp><radiobutton/></pyvcp>", 1, ["choices = [...] is needed"]),
    ("<pyvcp><image_bit><images>'none'</images></image_bit></pyvcp>", 1, ["no image 'none'"]),
    ("<pyvcp><number><format>'q'</format></number></pyvcp>", 1, ["Error constructing number({'format': 'q'}):"]),
    ("<pyvcp>\n<led><on_color>'sunny'</on_color></led></pyvcp>", 1, ["unknown color name \"sunny\"", "bad.xml:2"]),
    ("<pyvcp>\n<include src=\"bad.xml\"/></pyvcp>", 1, ["bad.xml: includes itself"]),
    ("<pyvcp>\n<include src=\"none.xml\"/></pyvcp>", 1, ["none.xml: No such file or directory", "bad.xml:2"]),
    ("<pyvcp><vbox><boxfill fill=\"wide\"/>\n<led/></vbox></pyvcp>", 1,
     ["Error constructing led({}):\nbad fill style", "bad.xml:2"]),
    ("<pyvcp><vbox><tablerow/></vbox></pyvcp>", 1, ["<tablerow> stands outside of a table"]),
)


def expect(what: str, got: tuple[int, str, str], status: int, parts: list[str]) -> None:
    text = got[1] + got[2]
    if got[0] != status or any(part not in text for part in parts) or "Traceback" in text:
        mistakes.append(f"{what}: status {got[0]}, {text}, expected {status} {parts}")


def main(folder: str) -> None:
    def pyvcp(*words: str) -> tuple[int, str, str]:
        return session.command(folder, "env", "-C", folder, "pyvcp", *words)
    path = Path(folder, "bad.xml")
    for text, status, parts in CASES:
        path.write_text(text)
        expect(repr(text), pyvcp("bad.xml"), status, parts)
    for words in ([], ["-x", "a.xml"], ["a.xml", "b.xml"], ["-c"]):
        expect(f"pyvcp {words}", pyvcp(*words), 1, ["Usage: pyvcp [-g"])
    expect("no file", pyvcp("nothing.xml"), 1, ["pyvcp: nothing.xml: No such file"])
    expect("no display", session.command(folder, "env", "-C", folder, "DISPLAY=", "pyvcp", "good.xml"), 1,
           ["good.xml: No such file"])
    good = Path(folder, "good.xml")
    good.write_text("<pyvcp><lamp><led/></lamp><vbox><led><on_colour>'blue'</on_colour></led>\n"
                    "<radiobutton><choices>[1]</choices>"
                    "<width>9</width><size>3</size></radiobutton><tabs><names>['a']</names><led/><led/></tabs></vbox></pyvcp>")
    expect("no display", session.command(folder, "env", "-C", folder, "DISPLAY=", "pyvcp", "good.xml"), 1, ["pyvcp: "])
    expect("geometry", pyvcp("-g", "wide", "good.xml"), 1, ["-g wide: bad geometry specifier"])
    commands = Path(folder, "commands.hal")
    commands.write_text("loadusr -Wn good pyvcp -g 300x200+10+20 good.xml\nloadusr -Wn other pyvcp -c other good.xml\n")
    # what others pass over is passed over here, with a word
    expect("two panels", session.command(folder, "env", "-C", folder, "halcmd", "-f", str(commands)), 0,
           ["good.xml:1: <lamp> is no element of panels", "good.xml:1: <led> has no option on_colour",
            "good.xml:2: <radiobutton> has no option size"])
    shown = session.command(folder, "halcmd", "-s", "show", "pin")[1]
    for pin in ("good.led.0", "good.led.2", "other.led.1"):
        if pin not in shown:
            mistakes.append(f"no pin {pin}: {shown}")
    expect("same name", pyvcp("good.xml"), 0, ["Error: Multiple components with the same name."])
    window = subprocess.run(["xdotool", "search", "--sync", "--name", "^good$", "getwindowgeometry"],
                            capture_output=True, text=True, timeout=60).stdout
    if "Geometry: 300x200" not in window:
        mistakes.append(f"window: {window}")
    for name in ("good", "other"):
        expect(f"end of {name}", session.command(folder, "halcmd", "unloadusr", name), 0, [])
        session.command(folder, "halcmd", "waitusr", "-i", name)
    end = time.monotonic() + 30
    while "good" in session.command(folder, "halcmd", "-s", "show", "comp")[1] and time.monotonic() < end:
        pass
    if "good" in session.command(folder, "halcmd", "-s", "show", "comp")[1]:
        mistakes.append("the component outlives its window")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        try:
            session.command(scratch, "realtime", "start")
            main(scratch)
        finally:
            session.command(scratch, "realtime", "stop")
    print("\n".join(mistakes) or "told, lived")
    sys.exit(bool(mistakes))
