#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The ladder's Modbus server answers requests of every function; its client polls the same
server with the requests of a project."""

from __future__ import annotations

import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FREE = " , ".join(["0-0-0/0"] * 10)


def project(port: int) -> str:
    """%W1 counts scans; the client writes it and three bits to the server, reads others back.
    The server and the client share the memory of one ladder."""
    cells = "9-0-0/0 , " * 7 + "99-0-0/0 , 99-0-0/0 , 60-0-0/0"
    server = f"127.0.0.1:{port}"
    return "\n".join([
        "_FILES_CLASSICLADDER",
        "_FILE-com_params.txt", "MODBUS_MASTER_SERIAL_PORT=", "MODBUS_MASTER_TIME_INTER_FRAME=5",
        "MODBUS_MAP_COIL_WRITE=0", "MODBUS_MAP_COIL_READ=0", "MODBUS_MAP_REGISTER_WRITE=200",
        "MODBUS_MAP_REGISTER_READ=200", "MODBUS_MAP_INPUT=0", "MODBUS_MAP_HOLDING=200", "_/FILE-com_params.txt",
        "_FILE-arithmetic_expressions.csv", "0000,@200/1@:=4711", "_/FILE-arithmetic_expressions.csv",
        "_FILE-sections.csv", "#VER=1.0", "000,0,-1,0,0,0", "_/FILE-sections.csv",
        "_FILE-rung_0.csv", "#VER=2.0", "#NEXTRUNG=-1", cells, *[FREE] * 5, "_/FILE-rung_0.csv",
        "_FILE-modbusioconf.csv", "#VER=1.0",
        f"{server},1,11,3,0,1",         # %B1..3 to coils 11..13 = addresses 10..12 = %B11..13
        f"{server},4,11,3,1,5",         # back, inverted, into %B5..7
        f"{server},3,11,2,0,1",         # %W1..2 to registers 11.. = %W11..12
        f"{server},5,11,2,0,15",        # back into %W15..16
        "_/FILE-modbusioconf.csv", "_/FILES_CLASSICLADDER", ""])


def free_port() -> int:
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Client:
    def __init__(self, port: int):
        self.socket = socket.create_connection(("127.0.0.1", port), 5)
        self.number = 0

    def ask(self, pdu: bytes) -> bytes:
        self.number += 1
        self.socket.sendall(struct.pack(">HHHB", self.number, 0, len(pdu) + 1, 1) + pdu)
        number, _, length, _ = struct.unpack(">HHHB", self.receive(7))
        assert number == self.number
        return self.receive(length - 1)

    def receive(self, n: int) -> bytes:
        data = b""
        while len(data) < n:
            part = self.socket.recv(n - len(data))
            if not part:
                raise EOFError
            data += part
        return data


def hexed(data: bytes) -> str:
    return data.hex(" ")


def exercise(port: int) -> None:
    c = Client(port)
    requests = [
        ("write coils 0..3", struct.pack(">BHHBB", 15, 0, 4, 1, 0b0101)),
        ("read coils 0..3", struct.pack(">BHH", 1, 0, 4)),
        ("read inputs 0..1", struct.pack(">BHH", 2, 0, 2)),
        ("write coil 2", struct.pack(">BHH", 5, 2, 0)),
        ("read coils 0..3", struct.pack(">BHH", 1, 0, 4)),
        ("write register 3", struct.pack(">BHH", 6, 3, 0x1234)),
        ("write registers 4..5", struct.pack(">BHHBHH", 16, 4, 2, 4, 7, 8)),
        ("read registers 3..5", struct.pack(">BHH", 3, 3, 3)),
        ("read input registers 5", struct.pack(">BHH", 4, 5, 1)),
        ("too many coils", struct.pack(">BHH", 1, 0, 2001)),
        ("no such coil", struct.pack(">BHH", 1, 25, 10)),
        ("no such register", struct.pack(">BHH", 6, 500, 1)),
        ("bad value of a coil", struct.pack(">BHH", 5, 0, 1)),
        ("short write", struct.pack(">BHHBB", 16, 0, 2, 4, 0)),
        ("unknown function", struct.pack(">BHH", 99, 0, 1)),
    ]
    for what, pdu in requests:
        print(f"{what}: {hexed(c.ask(pdu))}")
    # The client of the ladder has moved its bits and words when its last target is right.
    deadline = time.monotonic() + 20
    words = bits = b""
    while time.monotonic() < deadline:
        words, bits = c.ask(struct.pack(">BHH", 3, 10, 6)), c.ask(struct.pack(">BHH", 1, 4, 3))
        if words[2:4] == words[-4:-2] == b"\x12\x67" and bits[-1] == 0b110:      # 4711
            break
        time.sleep(0.01)
    print(f"client: words {hexed(words)}, inverted bits {hexed(bits)}")
    # A message that is none ends the connection; another one is served.
    c.socket.sendall(b"\x00\x01\x00\x07\x00\x06\x01\x03\x00\x00\x00\x01")
    try:
        c.receive(1)
        print("bad header answered")
    except (EOFError, ConnectionError):
        print("bad header: connection closed")
    print(f"another: {hexed(Client(port).ask(struct.pack('>BHH', 3, 10, 1)))}")


def hal(*words: str) -> None:
    with tempfile.TemporaryFile() as out:
        subprocess.run(words, stdout=out, stderr=out, stdin=subprocess.DEVNULL, timeout=30, check=True)


def main() -> None:
    os.environ["KERF_CLOCK"] = "real"       # sockets are outside of virtual time
    port = free_port()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "modbus.clp"
        path.write_text(project(port))
        program = None
        try:
            hal("realtime", "start")
            hal("halcmd", "loadrt", "classicladder_rt")
            hal("halcmd", "loadrt", "threads")
            hal("halcmd", "addf", "classicladder.0.refresh", "thread1")
            hal("halcmd", "start")
            program = subprocess.Popen(["classicladder", "--modslave", "--modmaster",
                                        f"--modbus_port={port}", str(path)])
            for _ in range(200):
                try:
                    Client(port)
                    break
                except OSError:
                    time.sleep(0.02)
            exercise(port)
        finally:
            if program:
                program.terminate()
                print(f"ended with {program.wait(10)}")
            hal("realtime", "stop")


if __name__ == "__main__":
    sys.exit(main())
