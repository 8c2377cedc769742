# SPDX-License-Identifier: GPL-2.0-or-later
"""halreport: the running HAL as a text for people.

For every signal its pins, each with its component and the place of the function that
handles it (thread.order); then what is left open: signals without writer or reader,
functions in no thread, pins that nobody handles.
"""

import datetime
import json
import os
import platform
import signal
import sys

from .session import ToolError, halcmd


class Netlist:
    """HAL as lists and dicts (halcmd show --json), with what the report needs to look up."""

    def __init__(self, data: dict):
        self.pins = {p["name"]: p for p in data["pins"]}
        self.signals = data["signals"]
        self.functions = data["functions"]
        self.threads = sorted(data["threads"], key=lambda t: t["period"])
        self.order = {}
        for thread in self.threads:
            for number, funct in enumerate(thread["functions"], 1):
                self.order.setdefault(funct, f"{thread['name']}.{number:03d}")

    @classmethod
    def running(cls):
        return cls(json.loads(halcmd("show", "--json")))

    def function_of(self, pin: dict) -> str | None:
        """The function that handles a pin: of its component, with the longest beginning of the
        name in common; a component with one function handles all its pins by it."""
        own = [f["name"] for f in self.functions if f["component"] == pin["component"]]
        fitting = [f for f in own if pin["name"].startswith(f + ".")]
        if not fitting and own:
            # joint.0.x and motion-controller: no common name; parts like motion-command-handler
            instance = pin["name"].rsplit(".", 1)[0]
            fitting = [f for f in own if f.startswith(instance + ".") or instance.startswith(f)]
            fitting = fitting or (own if len(own) == 1 else [])
        return max(fitting, key=len) if fitting else None

    def place(self, pin: dict) -> str:
        """'thread.order' of a pin's function, or why there is none."""
        function = self.function_of(pin)
        if function is None:
            return "user" if not any(f["component"] == pin["component"] for f in self.functions) else "?"
        return self.order.get(function, "not added")


def signal_lines(net: Netlist) -> list[str]:
    lines = []
    for signal in net.signals:
        lines.append(f"SIG: {signal['name']} ({signal['type']}) = {signal['value']}")
        groups = (("OUT", [signal["writer"]] if signal["writer"] else []), ("IO ", signal["bidirs"]),
                  ("IN ", signal["readers"]))
        for word, names in groups:
            for name in names:
                pin = net.pins[name]
                function = net.function_of(pin)
                lines.append(f"  {word}: {name:<40} {pin['component']:<20} {net.place(pin)}"
                             + (f" {function}" if function else ""))
        lines.append("")
    return lines


def named_list(title: str, names: list[str]) -> list[str]:
    return [title] + [f"  {name}" for name in names or ["none"]] + [""]


def report(net: Netlist) -> str:
    """The whole text."""
    lines = [
        f"HAL report            {datetime.datetime.now():%Y-%m-%d %H:%M:%S}",
        f"Version:              {os.environ.get('LINUXCNCVERSION', 'unknown')}",
        f"Machine:              {' '.join(platform.uname()[i] for i in (0, 1, 2, 4))}",
        f"INI file:             {os.environ.get('INI_FILE_NAME', 'none')}",
        "",
    ]
    lines += signal_lines(net)
    lines += named_list("Signals with no outputs (no out pin, no io pins):",
                        [s["name"] for s in net.signals if not s["writer"] and not s["bidirs"]])
    lines += named_list("Signals with no inputs (no in pins, no io pins):",
                        [s["name"] for s in net.signals if not s["readers"] and not s["bidirs"]])
    lines.append("Function ordering by thread:")
    for thread in net.threads:
        lines.append(f"  {thread['name']} (period {thread['period']} ns)")
        lines += [f"    {number:03d} {name}" for number, name in enumerate(thread["functions"], 1)]
    lines.append("")
    lines += named_list("Functions not added to a thread:",
                        [f["name"] for f in net.functions if f["name"] not in net.order])
    open_pins = [p for p in net.pins.values() if not p["signal"]]
    lines += named_list("Unconnected pins:", [f"{p['dir']:<3} {p['name']}" for p in open_pins])
    unhandled = [p for p in net.pins.values() if p["signal"] and net.place(p) in ("not added", "?")]
    lines += named_list("Connected pins that no function in a thread handles:",
                        [f"{p['dir']:<3} {p['name']} ({p['signal']})" for p in unhandled])
    return "\n".join(lines)


def main(arguments: list[str]) -> int:
    if len(arguments) > 1 or (arguments and arguments[0] in ("-h", "--help")):
        print("Usage: halreport [outfile]\nWrites a report on the running HAL (standard output without a file).")
        return 0 if arguments[0] in ("-h", "--help") else 1
    try:
        text = report(Netlist.running())
    except ToolError as problem:
        print(f"halreport: {problem}", file=sys.stderr)
        return 1
    if not arguments:
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)   # halreport | head
        sys.stdout.write(text)
        return 0
    try:
        with open(arguments[0], "w") as out:
            out.write(text)
    except OSError as problem:
        print(f"halreport: {problem}", file=sys.stderr)
        return 1
    print(f"halreport: file={os.path.abspath(arguments[0])}")
    return 0
