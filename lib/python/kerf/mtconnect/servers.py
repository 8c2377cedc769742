# SPDX-License-Identifier: GPL-2.0-or-later
"""The ways out: HTTP, SHDR and MQTT. Each runs in threads of its own and never holds the agent up."""

import http.server
import queue
import socket
import socketserver
import sys
import threading
import time
import traceback
import urllib.parse
from pathlib import Path

from .. import mqtt
from .documents import SCHEMA
from .observations import timestamp

XML = "application/xml; charset=utf-8"
RECONNECT_S = 5.0
MAX_LINE = 1000       # bytes that a client of SHDR may send
SENDING_S = 5.0       # a client that takes nothing for so long is dropped


class HttpServer(http.server.ThreadingHTTPServer):
    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, bind, port, agent):
        self.agent = agent
        if ":" in bind:
            self.address_family = socket.AF_INET6
        super().__init__((bind, port), Request)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def handle_error(self, request, client_address):
        if not isinstance(sys.exc_info()[1], OSError):  # a client that went away is no error
            traceback.print_exc()


class Request(http.server.BaseHTTPRequestHandler):
    server_version, sys_version = "linuxcnc-mtconnect/0.1", ""
    timeout = SENDING_S

    def log_message(self, *_):
        pass

    def answer(self, status, body, kind=XML):
        data = body if isinstance(body, bytes) else body.encode()
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def refuse(self, status, code, text):
        self.answer(status, self.server.agent.documents.error(code, text))

    def do_GET(self):
        try:
            self.get()
        except OSError:
            raise
        except Exception:  # whatever it is, the client gets a document
            traceback.print_exc()
            self.refuse(500, "INTERNAL_ERROR", "internal error")

    def get(self):
        agent = self.server.agent
        url = urllib.parse.urlsplit(self.path)
        path, query = urllib.parse.unquote(url.path).rstrip("/"), urllib.parse.parse_qs(url.query)
        if path in ("", "/probe"):
            self.answer(200, agent.documents.probe(len(agent.tools)))
        elif path == "/current":
            observations, numbers = agent.observations.current()
            self.answer(200, agent.documents.streams(observations, *numbers))
        elif path == "/sample":
            self.sample(query)
        elif path == "/assets":
            self.answer(200, agent.documents.assets(agent.tools))
        elif path in (f"/{SCHEMA}", f"/schemas/{SCHEMA}"):
            self.answer(200, (Path(__file__).parent / SCHEMA).read_bytes())
        elif path.startswith("/models/"):
            content = agent.meshes.content(path.removeprefix("/models/"))
            if content:
                self.answer(200, content[1], content[0])
            else:
                self.refuse(404, "NOT_FOUND", f"there is no model {path.removeprefix('/models/')}")
        else:
            self.refuse(404, "UNSUPPORTED",
                        f"{url.path} is not supported; there are /probe, /current, /sample and /assets")

    def sample(self, query):
        agent = self.server.agent
        try:
            start = int(query["from"][0]) if "from" in query else None
            count = int(query["count"][0]) if "count" in query else 100
            found = agent.observations.sample(start, count) if count > 0 else None
        except ValueError:
            found = None
        if found is None:
            first, _, following = agent.observations.range()
            return self.refuse(406, "OUT_OF_RANGE",
                               f"from must be a number from {first} to {following}, count one from 1")
        observations, numbers = found
        self.answer(200, agent.documents.streams(observations, *numbers))


def shdr_text(value):
    return "".join(" " if c in "|\t\r\n" else c for c in value)


def shdr_line(observations):
    """One line with all scalar observations, or b''."""
    words = [word for seen in observations if not seen.item.table for word in (seen.item.id, shdr_text(seen.value))]
    return ("|".join([timestamp(), *words]) + "\n").encode(errors="replace") if words else b""


class ShdrServer(socketserver.ThreadingTCPServer):
    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, bind, port, agent):
        self.agent, self.clients, self.guard = agent, set(), threading.Lock()
        super().__init__((bind, port), ShdrClient)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def send(self, observations):
        line = shdr_line(observations)
        if not line:
            return
        with self.guard:
            clients = list(self.clients)
        for client in clients:
            client.give(line)

    def handle_error(self, request, client_address):
        pass


class ShdrClient(socketserver.StreamRequestHandler):
    """Lines to the client wait in a queue, so that one that does not read holds nobody up."""

    def handle(self):
        self.lines = queue.Queue(1000)
        self.connection.settimeout(None)
        observations, _ = self.server.agent.observations.current()
        self.give(shdr_line([seen
                             for seen in observations
                             if seen.item.component in self.server.agent.device_components]))
        with self.server.guard:
            self.server.clients.add(self)
        threading.Thread(target=self.write, daemon=True).start()
        try:
            while (line := self.rfile.readline(MAX_LINE)).endswith(b"\n"):
                if line.strip() == b"* PING":
                    self.give(b"* PONG 10000\n")
        finally:
            with self.server.guard:
                self.server.clients.discard(self)
            self.give(b"")

    def give(self, line):
        try:
            self.lines.put_nowait(line)
        except queue.Full:
            try:
                self.connection.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def write(self):
        try:
            while line := self.lines.get():
                self.connection.sendall(line)
        except OSError:
            pass


class MqttSender:
    """Keeps a connection to the broker and publishes what is put into its queue."""

    def __init__(self, agent):
        self.agent, self.connected, self.told = agent, False, ""
        self.messages = queue.Queue(1000)
        threading.Thread(target=self.run, daemon=True).start()

    def publish(self, kind, payload, name="", retain=False):
        topic = f"{self.agent.settings.mqtt_prefix}/{kind}/{self.agent.settings.uuid}" + (f"/{name}" if name else "")
        if self.connected:
            try:
                self.messages.put_nowait((topic, payload, retain))
            except queue.Full:
                pass  # the broker is too slow; the next values follow

    def run(self):
        pause = threading.Event()
        while True:
            try:
                self.serve()
            except OSError as error:
                self.connected = False
                if str(error) != self.told:
                    self.told = str(error)
                    print(f"mtconnect-agent: MQTT broker {self.agent.settings.broker}: {error}",
                          file=sys.stderr, flush=True)
            pause.wait(RECONNECT_S)

    def serve(self):
        s = self.agent.settings
        link = mqtt.Connection(s.broker, s.mqtt_port, "linuxcnc-mtconnect", s.mqtt_user, s.mqtt_password)
        try:
            while not self.messages.empty():
                self.messages.get_nowait()
            self.connected, self.told = True, ""
            self.publish("Probe", self.agent.documents.probe(len(self.agent.tools)), retain=True)
            self.agent.send_assets = True
            pinged = time.monotonic()
            while True:
                try:
                    topic, payload, retain = self.messages.get(timeout=1.0)
                    link.publish(topic, payload, retain)
                except queue.Empty:
                    pass
                if time.monotonic() - pinged > mqtt.KEEPALIVE_S / 4:
                    pinged = time.monotonic()
                    link.ping()
        finally:
            self.connected = False
            link.link.close()
