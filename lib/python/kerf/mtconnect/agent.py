# SPDX-License-Identifier: GPL-2.0-or-later
"""mtconnect-agent [INI] [--dump-probe] [--port N]

Publishes what the controller does as MTConnect 1.7, reading only: XML over HTTP, MQTT and SHDR, as [MTCONNECT]
of the INI file says. With HAL it is the component mtconnect-agent.
"""

import argparse
import os
import signal
import sys
import time

import linuxcnc

from .. import clock
from . import settings as ini_settings
from .documents import Documents
from .items import Reader, all_items
from .models import Meshes
from .observations import Observations
from .servers import HttpServer, MqttSender, ShdrServer

NAME = "mtconnect-agent"
DISABLED_S = 0.1
MAX_HZ = 1000.0


class Agent:
    """Takes the values and hands them to the servers."""

    def __init__(self, settings, ini, hal):
        self.settings, self.meshes = settings, Meshes(settings, ini)
        self.documents = Documents(settings, self.meshes, int(time.time()))
        self.observations = Observations(self.documents.agent_items + self.documents.device_items)
        self.device_components = {item.component for item in self.documents.device_items}
        self.agent_values = {"agent_avail": "AVAILABLE", "agent_device_added": settings.uuid}
        self.reader, self.tools, self.send_assets = Reader(settings, hal), [], True
        self.shdr = self.mqtt = None

    def serve(self, port):
        """Starts the servers; texts of those that cannot."""
        s, problems = self.settings, []
        port = s.http_port if port is None else port
        if "http" in s.transports:
            try:
                HttpServer(s.http_bind, port, self)
            except (OSError, OverflowError) as error:
                problems.append(f"HTTP, {s.http_bind}:{port}: {error}; see [MTCONNECT]HTTP_PORT and HTTP_BIND")
        if "shdr" in s.transports:
            try:
                self.shdr = ShdrServer(s.shdr_bind, s.shdr_port, self)
            except (OSError, OverflowError) as error:
                problems.append(f"SHDR, {s.shdr_bind}:{s.shdr_port}: {error}; see [MTCONNECT]SHDR_PORT and SHDR_BIND")
        if "mqtt" in s.transports:
            self.mqtt = MqttSender(self)
        return problems

    def poll(self):
        values = self.agent_values | self.reader.values()
        new = self.observations.take(values, once=("assetchg",) if "avail" in values else ())
        old, self.tools = self.tools, self.reader.tools() if "avail" in values else []
        if self.shdr:
            self.shdr.send([seen for seen in new if seen.item.component in self.device_components])
        if self.mqtt and self.mqtt.connected:
            self.publish(new, old)

    def publish(self, new, old_tools):
        observations, numbers = self.observations.current()
        self.mqtt.publish("Current", self.documents.streams(observations, *numbers))
        if new:
            self.mqtt.publish("Sample",
                              self.documents.streams(new, new[0].sequence, new[-1].sequence, new[-1].sequence + 1))
        everything, self.send_assets = self.send_assets, False
        for tool in self.tools:
            if everything or tool not in old_tools:
                self.mqtt.publish("Asset", self.documents.asset(tool), f"tool-{tool['toolno']}", retain=True)


def hal_component():
    """(module hal, component) or (None, None) where there is no HAL."""
    try:
        import hal
    except ImportError:
        return None, None
    try:
        component = hal.component(NAME)
    except (hal.error, RuntimeError):  # no HAL, or another agent has the pins
        return None, None
    component.newpin("enable", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("sample-hz", hal.HAL_U32, hal.HAL_IN)
    component.newpin("active", hal.HAL_BIT, hal.HAL_OUT)
    component.newpin("connected", hal.HAL_BIT, hal.HAL_OUT)
    component.newpin("heartbeat", hal.HAL_U32, hal.HAL_OUT)
    component["enable"] = True
    return hal, component


def run(agent, pins):
    pins = pins if pins is not None else {"enable": True, "sample-hz": 0, "heartbeat": 0}
    while True:
        if pins["enable"]:
            agent.poll()
            pins["heartbeat"] = (pins["heartbeat"] + 1) & 0xFFFFFFFF
        pins["active"] = pins["enable"]
        pins["connected"] = bool(agent.mqtt and agent.mqtt.connected)
        hz = pins["sample-hz"] or agent.settings.sample_hz
        clock.sleep(1 / min(hz, MAX_HZ) if pins["enable"] and hz > 0 else DISABLED_S)


def main(words):
    parser = argparse.ArgumentParser(prog=NAME,
                                     description="Publishes what the controller does as MTConnect, reading only.")
    parser.add_argument("ini", nargs="?", default=os.environ.get("INI_FILE_NAME"),
                        help="INI file (default: INI_FILE_NAME of the environment)")
    parser.add_argument("--dump-probe", action="store_true", help="print the probe document and end")
    parser.add_argument("--port", type=int, help="port for HTTP instead of [MTCONNECT]HTTP_PORT")
    options = parser.parse_args(words)
    if not options.ini:
        parser.error("an INI file is needed")
    try:
        settings, ini = ini_settings.read(options.ini)
    except linuxcnc.error as error:
        sys.exit(f"{NAME}: {error}")
    if nmlfile := ini.find("EMC", "NML_FILE"):
        linuxcnc.nmlfile = nmlfile
    taken = {item.id for item in all_items(settings)}
    for line in ini.findall("MTCONNECT", "HAL_ITEM"):
        if item := ini_settings.hal_item(line, taken, settings.axes):
            settings.hal_items.append(item)
            taken.add(item.id)
    if options.dump_probe:
        print(Documents(settings, Meshes(settings, ini), int(time.time())).probe(), end="")
        return 0
    hal, component = hal_component()
    if not settings.enable:
        print(f"info: [MTCONNECT]ENABLE is off; {NAME} exiting.", flush=True)
        if component:
            component.ready()  # loadusr -W goes on
        return 0
    agent = Agent(settings, ini, hal)
    problems = agent.serve(options.port)
    for problem in problems:
        print(f"{NAME}: {problem}", file=sys.stderr, flush=True)
    if problems and not component:
        return 1
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    if component:
        component.ready()  # a machine starts also where a port is taken
    clock.join(NAME, 500)
    try:
        run(agent, component)
    except KeyboardInterrupt:
        return 0
