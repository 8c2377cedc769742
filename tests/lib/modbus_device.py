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
        self.broken = False     # answers with a wrong CRC (serial), or of another request (TCP)
        self.watch = None       # called with address and value of each register or coil that is written

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
        if self.watch and code in (5, 6, 16):
            self.watch(at, word(3) if code < 16 else word(6))
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
    """Listens on `port`; stop() closes it and every connection. Or calls a server, until hang_up()."""

    def __init__(self, port=0, size=200):
        super().__init__(size)
        self.connections = []
        self.start(port)

    def serve(self, connection):
        self.connections.append(connection)
        try:
            while head := connection.recv(7, socket.MSG_WAITALL):
                body = connection.recv(int.from_bytes(head[4:6], "big") - 1, socket.MSG_WAITALL)
                if not self.silent:
                    reply = self.answer(body)
                    head = bytes([head[0] ^ self.broken]) + head[1:]
                    connection.sendall(head[:4] + (len(reply) + 1).to_bytes(2, "big") + head[6:7] + reply)
        except (OSError, IndexError):
            pass

    def start(self, port):
        device = self

        class Handler(socketserver.BaseRequestHandler):
            def handle(self):
                device.serve(self.request)

        class Server(socketserver.ThreadingTCPServer):
            allow_reuse_address = daemon_threads = True

        self.server = Server(("127.0.0.1", port), Handler)
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def call(self, port):
        connection = socket.create_connection(("127.0.0.1", port), 10)
        connection.settimeout(None)
        threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def hang_up(self):
        for connection in self.connections:
            try:
                connection.shutdown(socket.SHUT_RDWR)
                connection.close()
            except OSError:
                pass
        self.connections.clear()

    def stop(self):
        self.server.shutdown()
        self.server.server_close()
        self.hang_up()


class SerialDevice(Device):
    """Device `slave` on a line; `path` is the other end. With `link` that is a symbolic link, which unplug() takes
    away together with the line, and plug() makes again."""

    def __init__(self, slave, size=200, link=None):
        super().__init__(size)
        self.slave, self.link = slave, link
        self.others = {}        # more devices on the line, by number
        self.plug()

    def plug(self):
        self.end, self.other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(self.other)
        self.path = os.ttyname(self.other)
        if self.link:
            if os.path.islink(self.link):
                os.unlink(self.link)
            os.symlink(self.path, self.link)
            self.path = self.link
        self.thread = threading.Thread(target=self.serve, args=(self.end,), daemon=True)
        self.thread.start()

    def unplug(self):
        os.unlink(self.link)
        os.close(self.other)
        os.write(self.end, b"")
        end, self.end = self.end, None
        os.close(end)

    def serve(self, end):
        try:
            self.answer_all(end)
        except OSError:
            pass                # unplugged

    def answer_all(self, end):
        data = b""
        while more := os.read(end, 256):
            data += more
            while len(data) >= 8:
                size = 9 + data[6] if data[1] in (15, 16) else 8
                if len(data) < size:
                    break
                frame, data = data[:size], data[size:]
                device = self if frame[0] == self.slave else self.others.get(frame[0])
                if device and frame[-2:] == crc(frame[:-2]) and not device.silent:
                    reply = frame[:1] + device.answer(frame[1:-2])
                    os.write(end, reply + (b"xx" if device.broken else crc(reply)))
