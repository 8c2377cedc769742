# SPDX-License-Identifier: GPL-2.0-or-later
"""A linuxcncrsh of its own for a test, and conversations with it (in virtual time)."""
import os
import socket

from kerf import clock

MARK = "GET PLAT"  # answered by every connection, so its answer ends a conversation


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Server:
    def __init__(self, *options, ini="mill.ini", wait=True):
        self.port = free_port()
        self.process = clock.spawn(["linuxcncrsh", "-q", "-p", str(self.port), *options, "--", "-ini", ini],
                                   "linuxcncrsh")
        while wait:
            try:
                socket.create_connection(("127.0.0.1", self.port)).close()
                break
            except ConnectionRefusedError:
                clock.sleep(0.01)

    def end(self, timeout=10):
        """Its exit status."""
        clock.suspend()
        try:
            return self.process.wait(timeout)
        finally:
            clock.resume()

    def stop(self):
        self.process.terminate()
        return self.end()


class Client:
    def __init__(self, server, *, enable=True, quiet=True):
        self.socket = socket.create_connection(("127.0.0.1", server.port))
        self.socket.settimeout(20)
        self.pending = b""
        if quiet:
            self.say("SET ECHO OFF")
        if enable:
            self.say("HELLO EMC test 1.0", "SET ENABLE EMCTOO")

    def send(self, *lines, end="\r\n"):
        self.socket.sendall("".join(line + end for line in lines).encode())

    def read(self, end):
        """Everything up to the line `end`, or to the end of the connection."""
        clock.suspend()
        try:
            while end is None or end not in self.pending:
                data = self.socket.recv(65536)
                if not data:
                    got, self.pending = self.pending, b""
                    return got
                self.pending += data
        finally:
            clock.resume()
        got, self.pending = self.pending.split(end, 1)
        return got

    def say(self, *lines):
        """Sends the lines; all the lines that come back until they are done."""
        self.send(*lines, MARK)
        text = self.read(b"PLAT Linux\r\n").decode(errors="replace")
        return [line for line in text.split("\r\n")[:-1] if not line.endswith(MARK)]

    def close(self):
        self.socket.close()


def show(client, *lines):
    for line in lines:
        print(f"> {line[:60]}")
        for reply in client.say(line):
            print(reply.replace(os.getcwd(), "HERE"))
