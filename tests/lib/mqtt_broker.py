# SPDX-License-Identifier: GPL-2.0-or-later
"""An MQTT broker for tests: takes one connection and keeps its packets."""
from __future__ import annotations

import socket
import threading


def take(link: socket.socket) -> tuple[int, bytes]:
    """One packet: kind, body."""
    def exactly(n: int) -> bytes:
        data = b""
        while len(data) < n:
            more = link.recv(n - len(data))
            if not more:
                raise OSError("closed")
            data += more
        return data
    kind, size, shift = exactly(1)[0], 0, 0
    while True:
        byte = exactly(1)[0]
        size |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return kind, exactly(size)


class Broker:
    """Its thread ends with the connection."""

    def __init__(self) -> None:
        self.server, self.packets = socket.create_server(("127.0.0.1", 0)), []
        self.port = self.server.getsockname()[1]
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self) -> None:
        link, _ = self.server.accept()
        with link:
            try:
                self.packets.append(take(link))
                link.sendall(b"\x20\x02\x00\x00")
                while True:
                    self.packets.append(take(link))
            except OSError:
                pass

    def published(self) -> list[tuple[int, str, str]]:
        """(first byte, topic, payload) of each message so far."""
        found = []
        for kind, body in list(self.packets):
            if kind & 0xF0 == 0x30:
                size = int.from_bytes(body[:2], "big")
                found.append((kind, body[2:2 + size].decode(), body[2 + size:].decode()))
        return found
