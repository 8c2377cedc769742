#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Publishes HAL pins over MQTT: HAL component mqtt-publisher.

mqtt-publisher [--dryrun] [--mqtt-broker=localhost] [--mqtt-port=1883] [--mqtt-user=NAME] [--mqtt-password=WORD]
               [--mqtt-prefix=devices/linuxcnc/machine] keys=pin,pin,...

Every `period` seconds, while `enable` is TRUE and halui exists, one JSON object of all pins goes to the topic of
the prefix. --dryrun prints it instead.
"""

import argparse
import json
import sys
import time
from pathlib import Path

here = Path(__file__).resolve().parent
if (here.parent / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parent / "lib/python"))

import hal
from kerf import clock, mqtt

NAME = "mqtt-publisher"
POLL_S = 0.1


def publish(options, payload):
    """One message on a connection of its own. Raises OSError."""
    link = mqtt.Connection(options.mqtt_broker, options.mqtt_port, NAME, options.mqtt_user, options.mqtt_password)
    link.publish(options.mqtt_prefix, payload)
    link.close()


class Publisher:
    def __init__(self, pins, options, keys):
        self.pins, self.options, self.keys = pins, options, keys
        self.told = set()
        self.due = 0.0

    def tell(self, message):
        """Once for each message."""
        if message not in self.told:
            self.told.add(message)
            print(f"{NAME}: {message}", file=sys.stderr, flush=True)

    def values(self):
        found = {}
        for key in self.keys:
            try:
                found[key] = hal.get_value(key)
            except RuntimeError:
                self.tell(f"there is no pin {key}")
        found[f"{NAME}.period"] = self.pins["period"]
        return found

    def step(self, now):
        if now < self.due or not self.pins["enable"] or not hal.component_exists("halui"):
            return
        self.due = now + self.pins["period"]
        payload = json.dumps(self.values())
        if self.options.dryrun:
            print(f"{self.options.mqtt_prefix} {payload}", flush=True)
        else:
            try:
                publish(self.options, payload)
            except OSError as error:
                self.tell(f"{self.options.mqtt_broker}:{self.options.mqtt_port}: {error}")
                return
        self.pins["lastpublish"] = int(time.time())


def arguments(words):
    parser = argparse.ArgumentParser(prog=NAME, description="Publishes HAL pins over MQTT.")
    parser.add_argument("--dryrun", action="store_true", help="print instead of publishing")
    parser.add_argument("--mqtt-broker", default="localhost")
    parser.add_argument("--mqtt-port", type=int, default=1883)
    parser.add_argument("--mqtt-user", default="")
    parser.add_argument("--mqtt-password", default="")
    parser.add_argument("--mqtt-prefix", default="devices/linuxcnc/machine", help="topic")
    parser.add_argument("keys", help="keys=pin,pin,...")
    options = parser.parse_args(words)
    if not options.keys.startswith("keys="):
        parser.error(f"keys=pin,pin,... is expected, not {options.keys}")
    return options, [key for key in options.keys[len("keys="):].split(",") if key]


def main():
    options, keys = arguments(sys.argv[1:])
    component = hal.component(NAME)
    component.newpin("enable", hal.HAL_BIT, hal.HAL_IN)
    component.newpin("period", hal.HAL_U32, hal.HAL_IN)
    component.newpin("lastpublish", hal.HAL_U32, hal.HAL_OUT)
    component["enable"] = True
    component["period"] = 10
    component.ready()
    clock.join(NAME, 500)
    publisher = Publisher(component, options, keys)
    while True:
        publisher.step(clock.now())
        clock.sleep(POLL_S)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        pass
