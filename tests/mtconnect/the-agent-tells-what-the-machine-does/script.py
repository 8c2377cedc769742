# SPDX-License-Identifier: GPL-2.0-or-later
# Documents over HTTP, lines over SHDR and messages over MQTT, while the machine works and after it went off.
import os
import re
import socket
import subprocess
import sys
import urllib.error
import urllib.request
import xml.etree.ElementTree as ET

import hal
from mill import *

tests = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(tests / "linuxcncrsh/lib"), str(tests / "lib")]
from mqtt_broker import Broker
from rsh import free_port

broker, http, shdr = Broker(), free_port(), free_port()
Path("agent.ini").write_text(Path("mill.ini").read_text() + f"""
[MTCONNECT]
DEVICE_NAME = Mill 7/b
UUID = mill-7
TRANSPORT = both, shdr
HTTP_PORT = 1
SHDR_PORT = {shdr}
MQTT_BROKER = 127.0.0.1
MQTT_PORT = {broker.port}
MQTT_PREFIX = shop
SAMPLE_HZ = 20
HAL_ITEM = pin=spindle.0.speed-out, id=out, type=ROTARY_VELOCITY, component=spindle, name=drive
HAL_ITEM = pin=motion.digital-in-00, id=door, type=LOAD
HAL_ITEM = pin=panel.level, id=level, type=FILL_LEVEL
HAL_ITEM = pin=no.such.pin, id=absent, type=LOAD, component=Y
""")
agent = clock.spawn(["mtconnect-agent", "agent.ini", "--port", str(http)], "mtconnect-agent", 500)


def away(work):
    """Something that waits for others, while virtual time goes on."""
    clock.suspend()
    try:
        return work()
    finally:
        clock.resume()


def get(path):
    """(status, body) of a page; waits until the server is there."""
    def ask():
        while True:
            try:
                with urllib.request.urlopen(f"http://127.0.0.1:{http}{path}", timeout=20) as answer:
                    return answer.status, answer.headers["Content-Type"], answer.read().decode()
            except urllib.error.HTTPError as refused:
                return refused.code, refused.headers["Content-Type"], refused.read().decode()
            except urllib.error.URLError:
                pass
    return away(ask)


def local(tag):
    return tag.rsplit("}", 1)[-1]


def values(text):
    """id: text, or {entry: {cell: text}} of a streams document."""
    found = {}
    for element in ET.fromstring(text).iter():
        if "dataItemId" in element.attrib:
            found[element.get("dataItemId")] = ({e.get("key"): {c.get("key"): c.text for c in e} for e in element}
                                                if len(element) else element.text)
    return found


def show(what, *names):
    """The values once the agent has looked again."""
    beats = int(getp("mtconnect-agent.heartbeat"))
    clock.wait_until(lambda: int(getp("mtconnect-agent.heartbeat")) >= beats + 2, 10)
    now = values(get("/current")[2])
    print(what + ":", {n: now[n] for n in names})


class Shdr:
    def __init__(self):
        self.link = away(lambda: socket.create_connection(("127.0.0.1", shdr), 20))
        self.rest = b""

    def line(self):
        while b"\n" not in self.rest:
            self.rest += self.link.recv(4096)
        line, _, self.rest = self.rest.partition(b"\n")
        return line.decode().split("|")

    def until(self, *words):
        """Lines until one has these fields in a row."""
        def read():
            while "|".join(words) not in "|".join(self.line()):
                pass
            return "seen " + "|".join(words)
        return away(read)


print("== documents")
get("/current")
show("off", "avail", "estop", "mode", "execution", "program", "toolnum", "toolasset", "workoffset", "tooloffset",
     "absent", "door", "agent_avail", "assetrm")
for page in ("/", "/probe/", "/current", "/sample", "/assets", "/schemas/mtconnect-linuxcnc-1.xsd",
             "/mtconnect-linuxcnc-1.xsd", "/nothing", "/models/x.stl", "/models/..%2fagent.ini",
             "/sample?from=0", "/sample?from=99999", "/sample?from=x", "/sample?count=0"):
    status, kind, text = get(page)
    root = ET.fromstring(text)
    error = [e.get("errorCode") for e in root.iter() if local(e.tag) == "Error"]
    print(page, status, kind, local(root.tag), *error)
head = ET.fromstring(get("/current")[2])[0].attrib
print({k: head[k] for k in ("sender", "version", "bufferSize", "assetBufferSize", "firstSequence")},
      int(head["nextSequence"]) == int(head["lastSequence"]) + 1,
      re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z", head["creationTime"]) is not None)
components = [(local(e.tag), e.get("id"))
              for e in ET.fromstring(get("/probe")[2]).iter()
              if e.get("id") and local(e.tag) not in ("DataItem", "Specification", "Motion", "CoordinateSystem")]
print(components)
print("assets:", [(t.get("assetId"),
                   {local(e.tag): (e.text or "").strip() or e.attrib
                    for e in t.iter() if local(e.tag) in ("Status", "Location", "CuttingDiameter", "FunctionalLength",
                                                          "Description")})
                  for t in ET.fromstring(get("/assets")[2])[1]][:1])

print("== lines")
client = Shdr()
first = away(client.line)
pairs = dict(zip(first[1::2], first[2::2]))
print({k: pairs[k] for k in ("estop", "mode", "pos_x", "absent")}, "workoffset" in pairs, len(first) % 2)
away(lambda: client.link.sendall(b"* PING\n"))
print(client.until("* PONG 10000"))

print("== work")
on()
print(client.until("estop", "ARMED"))
start = int(ET.fromstring(get("/current")[2])[0].get("nextSequence"))
mdi("G21 G90 G0 X25.4 Y2")
mdi("G10 L20 P2 X0 G55")
mdi("G92 Y5")
mdi("T1 M6 G43")
mdi("S1000 M4")
mdi("M8")
c.spindleoverride(0.5)
show("on", "estop", "mode", "execution", "pos_x", "poscmd_y", "workoffset", "toolnum", "toolasset", "assetchg",
     "tooloffset", "spdl_speed", "spdl_speed_cmd", "spdl_dir", "coolant_flood",
     "coolant_mist", "xyrotation", "feedovr", "out")
print(client.until("coolant_flood", "ON"))
seen = ET.fromstring(get(f"/sample?from={start}&count=5")[2])
numbers = [int(e.get("sequence")) for e in seen.iter() if "sequence" in e.attrib]
print("sample:", sorted(numbers) == list(range(start, start + 5)), int(seen[0].get("nextSequence")) == start + 5)
print("used:", [e.text for e in ET.fromstring(get("/assets")[2]).iter() if local(e.tag) == "Status"])
mdi("G92.1 G49 G54")
mdi("M5 M9")
program("G1 F1200 X20\nX40\nM2\n")
c.auto(AUTO_RUN, 0)
until(lambda s: s.motion_line == 1 and s.current_vel > 19, 10, 0.01)
show("runs", "execution", "program", "line", "mode", "spdl_dir", "pathfeed")
c.auto(AUTO_PAUSE)
until(lambda s: s.task_paused, 10)
show("paused", "execution")
c.abort()

print("== values that no document may hold")
panel = hal.component("panel")
panel.newpin("level", hal.HAL_FLOAT, hal.HAL_OUT)
panel.ready()
panel["level"] = 2.5
show("a number", "level")
panel["level"] = float("nan")
show("none", "level")
for name in ("a\x01b<&>.ngc", "no\udcffutf8.ngc"):
    program("M2\n", name)
    show("a name", "program")
    print(client.until("program", name.replace("\udcff", "?")))
flood = Shdr()
away(flood.line)
away(lambda: flood.link.sendall(b"x" * 5000))
print("endless line:", away(lambda: flood.link.recv(1)))

print("== messages")
clock.wait_until(lambda: any("Sample" in t for _, t, _ in broker.published())
                 and getp("mtconnect-agent.connected") == "TRUE", 600, 0.05)
topics = {}
for kind, topic, text in broker.published():
    topics.setdefault(topic, (kind, local(ET.fromstring(text).tag)))
print(broker.packets[0][1][:26], sorted(topics.items()))

print("== pins")
print(getp("mtconnect-agent.active"), getp("mtconnect-agent.enable"), getp("mtconnect-agent.sample-hz"))
setp("mtconnect-agent.enable", 0)
clock.wait_until(lambda: getp("mtconnect-agent.active") == "FALSE", 10)
beats = getp("mtconnect-agent.heartbeat")
sleep(1)
print("held:", getp("mtconnect-agent.heartbeat") == beats, getp("mtconnect-agent.active"))
setp("mtconnect-agent.sample-hz", 2)
setp("mtconnect-agent.enable", 1)
clock.wait_until(lambda: getp("mtconnect-agent.active") == "TRUE", 10)
beats = int(getp("mtconnect-agent.heartbeat"))
sleep(5)
print("twice a second:", 9 <= int(getp("mtconnect-agent.heartbeat")) - beats <= 11)
agent.terminate()
print("ends with", away(lambda: agent.wait(20)))

print("== a port that is taken, and the INI file of the environment")
clock.wait_until(lambda: "mtconnect-agent" not in halcmd("list", "comp").split(), 10)
taken = socket.create_server(("127.0.0.1", http))
agent = clock.spawn(["mtconnect-agent", "--port", str(http)], "mtconnect-agent", 500,
                    env=dict(os.environ, INI_FILE_NAME="agent.ini"), stderr=open("told", "w"))
clock.wait_until(lambda: "mtconnect-agent" in halcmd("list", "comp").split()
                 and getp("mtconnect-agent.heartbeat") not in ("", "0"), 10)
print("works on:", getp("mtconnect-agent.active"), Path("told").read_text().replace(str(http), "PORT").strip())
second = away(lambda: subprocess.run(["mtconnect-agent", "agent.ini", "--port", str(http)], stderr=subprocess.PIPE,
                                     text=True, timeout=30, env={k: v
                                                                 for k, v in os.environ.items()
                                                                 if not k.startswith("KERF_CLOCK")}))
print("beside it:", second.returncode, second.stderr.replace(str(http), "PORT").replace(str(shdr), "SHDR").strip())
agent.terminate()
away(lambda: agent.wait(20))
