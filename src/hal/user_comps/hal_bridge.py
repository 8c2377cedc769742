#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pins for a screen that is reached by ZeroMQ: HAL component bridge.

hal_bridge [-d] [-h] [--readport=tcp://127.0.0.1:5690] [--writeport=tcp://127.0.0.1:5691]

Messages of the screen set the output pins, changes of the input pins ask it to act. Without the Python
module zmq only the pins exist.
"""

import argparse
import json
import os
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock, instance

POLL_S = 0.1
TOPIC = b"STATUSREQUEST"
PLAIN_INPUTS = {"cycle-start-in": "request_cycle_start", "reload-display-in": "request_reload_display",
                "shutdown-in": "request_shutdown", "ok-in": "request_ok", "cancel-in": "request_cancel"}
BOTH_EDGES = {"cycle-pause-in": "request_cycle_pause"}
VALUES = {"jog-rate-in": "set_jograte", "jog-rate-angular-in": "set_jograte_angular"}
MESSAGES = {"jograte-changed": "jog-rate", "jograte-angular-changed": "jog-rate-angular",
            "jogincrements-changed": "jog-increment", "jogincrement-angular-changed": "jog-increment-angular",
            "jogincrements-angular-changed": "jog-increment-angular",     # as GStat says it
            "joint-selection-changed": "joint-selected"}
COMMANDS = (("MDI_COMMAND_LIST", "MDI_COMMAND_", "ini-mdi-cmd-"), ("MACROS", "MACRO_COMMAND_", "ini-macro-cmd-"))
STRIPPED = "macro-cmd-"     # these characters, at both ends of a pin's name


def settings(ini):
    """Axis letters (lower case) and pins of commands of an INI file (linuxcnc.ini, or None)."""
    if ini is None:
        return "xyz", []
    axes = "".join(dict.fromkeys(c for c in (ini.find("TRAJ", "COORDINATES") or "xyz").lower() if c in "xyzabcuvw"))
    pins = []
    for section, prefix, pin in COMMANDS:
        if ini.hassection(section):
            pins += [pin + name[len(prefix):] for name, _ in ini.getvariables(section) if name.startswith(prefix)]
    return axes, list(dict.fromkeys(pins))


class Bridge:
    """The pins. send: called with a function's name and its value when an input asks for it."""

    def __init__(self, component, axes, commands, send):
        self.pins, self.axes, self.send = component, axes, send
        new = component.newpin
        for name in ("jog-rate", "jog-rate-angular", "jog-increment", "jog-increment-angular"):
            new(name, hal.HAL_FLOAT, hal.HAL_OUT)
        new("jog-rate-in", hal.HAL_FLOAT, hal.HAL_IN)
        new("jog-rate-angular-in", hal.HAL_FLOAT, hal.HAL_OUT)      # as documented, though it is read
        new("joint-selected", hal.HAL_S32, hal.HAL_OUT)
        self.rising = {}
        for axis in axes:
            new(f"axis-{axis}-select", hal.HAL_BIT, hal.HAL_IN)
            new(f"axis-{axis}-is-selected", hal.HAL_BIT, hal.HAL_OUT)
            self.rising[f"axis-{axis}-select"] = ("set_selected_axis", axis.upper())
        for name in (*PLAIN_INPUTS, *BOTH_EDGES, *commands):
            new(name, hal.HAL_BIT, hal.HAL_IN)
        self.rising |= {name: (function, True) for name, function in PLAIN_INPUTS.items()}
        self.rising |= {name: ("request_macro_call", name.strip(STRIPPED)) for name in commands}
        self.seen = {name: component[name] for name in (*self.rising, *BOTH_EDGES, *VALUES)}

    def step(self):
        """Looks at the inputs once."""
        for name, before in self.seen.items():
            now = self.seen[name] = self.pins[name]
            if now == before:
                continue
            if name in self.rising:
                if now:
                    self.send(*self.rising[name])
            else:
                self.send(BOTH_EDGES.get(name) or VALUES[name], now)

    def receive(self, data):
        """One message of the screen; ValueError says what is wrong with it."""
        try:
            message = json.loads(data)
            name, value = message["MESSAGE"], message["ARGS"][0]
            if name == "axis-selection-changed":
                for axis in self.axes:
                    self.pins[f"axis-{axis}-is-selected"] = axis == str(value).lower()
            elif name in MESSAGES:
                if isinstance(value, list):     # an increment and its text
                    value = value[0]
                pin = MESSAGES[name]
                self.pins[pin] = int(value) if pin == "joint-selected" else float(value)
        except (KeyError, IndexError, TypeError, ValueError, OverflowError) as error:
            raise ValueError(f"message {data!r}: {type(error).__name__}: {error}") from None


class Link:
    """Both ZeroMQ sockets."""

    def __init__(self, zmq, readport, writeport):
        self.zmq = zmq
        context = zmq.Context()
        self.read = context.socket(zmq.SUB)
        self.read.setsockopt(zmq.SUBSCRIBE, b"")
        self.read.connect(readport)
        self.write = context.socket(zmq.PUB)
        self.write.bind(writeport)

    def send(self, function, value):
        self.write.send_multipart([TOPIC, json.dumps({"FUNCTION": function, "ARGS": value}).encode()])

    def messages(self):
        """All that have come."""
        while True:
            try:
                yield self.read.recv_multipart(self.zmq.NOBLOCK)[-1]
            except self.zmq.Again:
                return


def open_ini():
    if not os.environ.get("INI_FILE_NAME"):
        return None
    import linuxcnc
    return linuxcnc.ini(os.environ["INI_FILE_NAME"])


def main():
    parser = argparse.ArgumentParser(prog="hal_bridge", description="Pins for a screen that is reached by ZeroMQ.")
    parser.add_argument("-d", action="store_true", help="print what is sent and received")
    parser.add_argument("--readport", default=f"tcp://127.0.0.1:{instance.port(5690)}")
    parser.add_argument("--writeport", default=f"tcp://127.0.0.1:{instance.port(5691)}")
    options = parser.parse_args()
    link = None
    try:
        import zmq
        link = Link(zmq, options.readport, options.writeport)
    except ImportError:
        print("hal_bridge: the Python module zmq is missing (python3-zmq): only the pins exist", file=sys.stderr)
    except zmq.ZMQError as error:
        sys.exit(f"hal_bridge: {options.readport}, {options.writeport}: {error}")

    def send(function, value):
        if options.d:
            print(f"hal_bridge: {function} {value}", flush=True)
        if link:
            link.send(function, value)

    component = hal.component("bridge")
    bridge = Bridge(component, *settings(open_ini()), send)
    component.ready()
    clock.join("hal_bridge", 500)
    while True:
        bridge.step()
        for data in link.messages() if link else ():
            if options.d:
                print(f"hal_bridge: received {data!r}", flush=True)
            try:
                bridge.receive(data)
            except ValueError as error:
                print(f"hal_bridge: {error}", file=sys.stderr, flush=True)
        clock.sleep(POLL_S)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
