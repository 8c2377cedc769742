#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A broker of our own receives what mqtt-publisher sends; then --dryrun, a missing pin, a missing broker."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

sys.path[:0] = ["..", "../../lib"]
from harness import Session  # noqa: E402
from mqtt_broker import Broker  # noqa: E402

TOP = Path("../../..").resolve()
HALUI = """
import hal
from kerf import clock
c = hal.component("halui")
c.newpin("quit", hal.HAL_BIT, hal.HAL_IN)
c.newpin("speed", hal.HAL_FLOAT, hal.HAL_OUT)
c["speed"] = 2.5
c.ready()
clock.join("halui", 500)
while not c["quit"]: clock.sleep(0.01)
"""
mistakes: list[str] = []


def check(what: str, got: object, want: object) -> None:
    if got != want:
        mistakes.append(f"{what}: {got!r}, expected {want!r}")


def main() -> int:
    session = Session("mqtt")
    session.env["PYTHONPATH"] = str(TOP / "lib/python")
    broker = Broker()
    packets, port = broker.packets, broker.port
    with tempfile.TemporaryDirectory() as folder:
        def halcmd(*words: str) -> str:
            return session.command(folder, "halcmd", *words)[1].strip()

        def end() -> None:
            halcmd("unloadusr", "mqtt-publisher")
            halcmd("waitusr", "-i", "mqtt-publisher")
        try:
            session.command(folder, "realtime", "start")
            Path(folder, "halui.py").write_text(HALUI)
            halcmd("loadusr", "-Wn", "halui", "/usr/bin/python3", folder + "/halui.py")
            halcmd("loadusr", "-W", "mqtt-publisher", "--mqtt-broker=127.0.0.1", f"--mqtt-port={port}",
                   "--mqtt-user=me", "--mqtt-password=secret", "--mqtt-prefix=shop/mill",
                   "keys=halui.speed,halui.quit,no.such")
            broker.thread.join(60)
            check("lastpublish", halcmd("getp", "mqtt-publisher.lastpublish") != "0", True)
            check("period", halcmd("getp", "mqtt-publisher.period"), "10")
            end()
            check("connect", packets[0],
                  (0x10, b"\x00\x04MQTT\x04\xc2\x00\x3c\x00\x0emqtt-publisher\x00\x02me\x00\x06secret"))
            check("topic", packets[1][1][:11], b"\x00\x09shop/mill")
            check("published", json.loads(packets[1][1][11:]),
                  {"halui.speed": 2.5, "halui.quit": False, "mqtt-publisher.period": 10})
            check("disconnect", packets[2], (0xE0, b""))
            halcmd("setp", "halui.quit", "1")
            halcmd("waitusr", "-i", "halui")
        finally:
            session.command(folder, "realtime", "stop")
        status, _, errors = session.command(folder, "mqtt-publisher", "pin")
        check("usage", (status, "keys=pin,pin,... is expected, not pin" in errors), (2, True))
    broker.server.close()
    print("\n".join(mistakes) or "published")
    return bool(mistakes)


if __name__ == "__main__":
    sys.exit(main())
