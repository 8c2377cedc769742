# SPDX-License-Identifier: GPL-2.0-or-later
"""MQTT 3.1.1 as far as publishing at quality 0 needs it."""

import socket

CONNECT, CONNACK, PUBLISH, PINGREQ, DISCONNECT = 0x10, 0x20, 0x30, 0xC0, 0xE0
RETAIN = 0x01
KEEPALIVE_S = 60
TIMEOUT_S = 5


def packet(kind, body):
    length, size = bytearray(), len(body)
    while True:
        size, low = divmod(size, 128)
        length.append(low | (0x80 if size else 0))
        if not size:
            return bytes([kind]) + bytes(length) + body


def text(word):
    data = word.encode()
    return len(data).to_bytes(2, "big") + data


def connect_packet(client, user, password):
    flags = 0x02 | (0x80 if user else 0) | (0x40 if user and password else 0)
    body = text("MQTT") + bytes([4, flags]) + KEEPALIVE_S.to_bytes(2, "big") + text(client)
    return packet(CONNECT, body + (text(user) if user else b"") + (text(password) if user and password else b""))


class Connection:
    """A connection to a broker. Every method raises OSError when it is lost."""

    def __init__(self, broker, port, client, user="", password=""):
        self.link = socket.create_connection((broker, port), TIMEOUT_S)
        try:
            self.link.settimeout(TIMEOUT_S)
            self.link.sendall(connect_packet(client, user, password))
            answer = b""
            while len(answer) < 4:
                data = self.link.recv(4 - len(answer))
                if not data:
                    raise OSError("the broker closed the connection")
                answer += data
            if answer[0] != CONNACK or answer[3] != 0:
                raise OSError(f"the broker refuses the connection (code {answer[3]})")
        except OSError:
            self.link.close()
            raise

    def publish(self, topic, payload, retain=False):
        self.link.sendall(packet(PUBLISH | (RETAIN if retain else 0), text(topic) + payload.encode()))

    def ping(self):
        """Keeps the connection; the broker's answers are read and dropped."""
        self.link.sendall(packet(PINGREQ, b""))
        self.link.setblocking(False)
        try:
            while data := self.link.recv(4096):
                pass
            if data == b"":
                raise OSError("the broker closed the connection")
        except BlockingIOError:
            pass
        finally:
            self.link.settimeout(TIMEOUT_S)

    def close(self):
        try:
            self.link.sendall(packet(DISCONNECT, b""))
        finally:
            self.link.close()
