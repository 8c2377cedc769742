# SPDX-License-Identifier: GPL-2.0-or-later
"""A Modbus device for tests: on a TCP port, and on one end of a serial line (a pty)."""
import os
import pty
import socket
import socketserver
import threading
import tty


def crc(data):
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value.to_bytes(2, "little")


class Device:
    """Memory of one device; addresses from `size` on are answered with exception 2."""

    def __init__(self, size=200):
        self.size, self.coils, self.inputs = size, [False] * size, [False] * size
        self.holding, self.registers = [0] * size, [0] * size
        self.asked = []         # function codes
        self.silent = False     # does not answer

    def answer(self, pdu):
        code, at = pdu[0], int.from_bytes(pdu[1:3], "big")
        self.asked.append(code)
        word = lambda n: int.from_bytes(pdu[n:n + 2], "big")
        count = word(3) if code in (1, 2, 3, 4, 15, 16) else 1
        if at + count > self.size:
            return bytes([code | 0x80, 2])
        if code in (1, 2):
            bits = (self.coils if code == 1 else self.inputs)[at:at + count]
            data = sum(bit << n for n, bit in enumerate(bits)).to_bytes((count + 7) // 8, "little")
            return bytes([code, len(data)]) + data
        if code in (3, 4):
            words = (self.holding if code == 3 else self.registers)[at:at + count]
            return bytes([code, 2 * count]) + b"".join(w.to_bytes(2, "big") for w in words)
        if code == 5:
            self.coils[at] = word(3) == 0xFF00
            return pdu
        if code == 6:
            self.holding[at] = word(3)
            return pdu
        if code == 15:
            bits = int.from_bytes(pdu[6:], "little")
            self.coils[at:at + count] = [bool(bits >> n & 1) for n in range(count)]
        elif code == 16:
            self.holding[at:at + count] = [word(6 + 2 * n) for n in range(count)]
        else:
            return bytes([code | 0x80, 1])
        return pdu[:5]


class TcpDevice(Device):
    """Listens on `port`; stop() closes it and every connection."""

    def __init__(self, port=0):
        super().__init__()
        self.connections = []
        self.start(port)

    def start(self, port):
        device = self

        class Handler(socketserver.BaseRequestHandler):
            def handle(self):
                device.connections.append(self.request)
                try:
                    while head := self.request.recv(7, socket.MSG_WAITALL):
                        body = self.request.recv(int.from_bytes(head[4:6], "big") - 1, socket.MSG_WAITALL)
                        if not device.silent:
                            reply = device.answer(body)
                            self.request.sendall(head[:4] + (len(reply) + 1).to_bytes(2, "big") + head[6:7] + reply)
                except (OSError, IndexError):
                    pass

        class Server(socketserver.ThreadingTCPServer):
            allow_reuse_address = daemon_threads = True

        self.server = Server(("127.0.0.1", port), Handler)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def stop(self):
        self.server.shutdown()
        self.server.server_close()
        for connection in self.connections:
            try:
                connection.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        self.connections.clear()


class SerialDevice(Device):
    """Device `slave` on a line; `path` is the other end."""

    LENGTHS = {1: 8, 2: 8, 3: 8, 4: 8, 5: 8, 6: 8}

    def __init__(self, slave, size=200):
        super().__init__(size)
        self.slave = slave
        self.end, other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(other)
        self.path, self.other = os.ttyname(other), other
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        data = b""
        while more := os.read(self.end, 256):
            data += more
            while len(data) >= 8:
                size = self.LENGTHS.get(data[1]) or 9 + data[6]
                if len(data) < size:
                    break
                frame, data = data[:size], data[size:]
                if frame[-2:] == crc(frame[:-2]) and frame[0] == self.slave and not self.silent:
                    reply = bytes([self.slave]) + self.answer(frame[1:-2])
                    os.write(self.end, reply + crc(reply))
