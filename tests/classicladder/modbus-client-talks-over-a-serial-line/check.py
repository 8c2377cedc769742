#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The ladder's Modbus client polls a slave on a pseudo terminal (RTU): every request, check
sums, errors and silence."""

from __future__ import annotations

import os
import pty
import select
import subprocess
import sys
import tempfile
import termios
import time
import tty
from pathlib import Path

sys.path.insert(0, "../lib")
from clp import COIL, NO, OPERATE, line, project, row, wide  # noqa: E402

DEADLINE_S = 30
# coils, inverted, into %B12..; holding registers into %W10, %W11
PROJECT = project(
    [row([(NO, "70/10")], (COIL, "60/0")), row([(NO, "50/1")], (COIL, "0/1")),
     {**line(0, 7), **wide(9, 0, OPERATE, 0)}, {**line(0, 7), **wide(9, 0, OPERATE, 1)}],
    {"arithmetic_expressions.csv": ["0000,@200/3@:=4660", "0001,@280/0@:=@200/7@"],
     "com_params.txt": ["MODBUS_MASTER_SERIAL_PORT={port}", "MODBUS_MASTER_SERIAL_SPEED=19200",
                        "MODBUS_MASTER_SERIAL_PARITY=2", "MODBUS_MASTER_TIME_INTER_FRAME=2",
                        "MODBUS_MASTER_TIME_OUT_RECEIPT=400", "MODBUS_ELEMENT_OFFSET=0",
                        "MODBUS_DEBUG_LEVEL=0", "MODBUS_MAP_INPUT=0", "MODBUS_MAP_COIL_READ=0",
                        "MODBUS_MAP_COIL_WRITE=0", "MODBUS_MAP_HOLDING=200", "MODBUS_MAP_REGISTER_READ=200",
                        "MODBUS_MAP_REGISTER_WRITE=200"],
     "modbusioconf.csv": ["#VER=1.0", "3,0,100,10,0,2",     # read inputs 100.. into %B2..11
                          "3,1,5,3,0,1",                    # write coils 5.. from %B1..3
                          "4,2,7,1,0,7",                    # read input register 7 of slave 4 into %W7
                          "3,3,9,2,0,3",                    # write holding registers 9, 10 from %W3, %W4
                          "3,4,6,4,1,12", "3,5,1,2,0,10",
                          "3,6,0,1,0,0", "3,7,0,1,0,0"]})    # status, diagnostics


def crc(data: bytes) -> bytes:
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value.to_bytes(2, "little")


def length(frame: bytes) -> int:
    """Of a request, as far as it is known."""
    if len(frame) < 2:
        return 2
    if frame[1] in (15, 16):
        return 9 + frame[6] if len(frame) > 6 else 7
    return 4 if frame[1] == 7 else 8


ANSWERS = {1: "01 01 05", 2: "02 02 05 02", 4: "04 02 01 02", 3: "03 04 00 0a 00 0b", 7: "07 00"}


def answer(frame: bytes) -> bytes:
    kind = frame[1]
    if kind in ANSWERS:
        return frame[:1] + bytes.fromhex(ANSWERS[kind])
    return frame[:-2] if kind == 8 else frame[:6]


class Slave:
    def __init__(self, fd: int):
        self.fd, self.mode, self.log, self.begun = fd, "right", [], b""

    def serve(self, until, what: str) -> None:
        end = time.monotonic() + DEADLINE_S
        frame = self.begun
        while not until():
            if time.monotonic() > end:
                print(f"{what}: does not come; seen {[f.hex() for f in self.log[-5:]]}")
                sys.exit(1)
            if not select.select([self.fd], [], [], 0.02)[0]:
                continue
            frame = self.begun = frame + os.read(self.fd, max(length(frame) - len(frame), 1))
            if len(frame) < length(frame):
                continue
            if crc(frame[:-2]) != frame[-2:]:
                print(f"{what}: wrong check sum {frame.hex()}")
            self.log.append(frame[:-2])
            reply = answer(frame)
            if self.mode == "error":
                reply = frame[:1] + bytes([frame[1] | 0x80, 2])
            if self.mode != "silent":
                os.write(self.fd, reply + (b"\0\0" if self.mode == "garbled" else crc(reply)))
            frame = self.begun = b""


def hal(*words: str) -> str:
    with tempfile.TemporaryFile("w+") as out:
        subprocess.run(words, stdout=out, stderr=out, stdin=subprocess.DEVNULL, timeout=30)
        out.seek(0)
        return out.read().strip()


def failed() -> bool:
    return hal("halcmd", "getp", "classicladder.0.out-00") == "TRUE"


def main() -> None:
    os.environ["KERF_CLOCK"] = "real"       # the line is outside of virtual time
    master, line_fd = pty.openpty()
    tty.setraw(master)
    slave = Slave(master)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rtu.clp"
        path.write_text(PROJECT.replace("{port}", os.ttyname(line_fd)))
        program = None
        try:
            hal("realtime", "start")
            for words in ("loadrt classicladder_rt", "loadrt threads", "addf classicladder.0.refresh thread1",
                          "setp classicladder.0.in-01 1", "start"):
                hal("halcmd", *words.split())
            program = subprocess.Popen(["classicladder", "--modmaster", str(path)])
            # the first round may have met a ladder that had not run yet
            slave.serve(lambda: len(slave.log) >= 24 and slave.log[-1][1] == 8, "three rounds")
            # on a busy computer an answer may have come too late: the request was made again
            frames = [f for n, f in enumerate(slave.log) if n == 0 or f != slave.log[n - 1]]
            for frame in frames[-8:]:
                print(frame.hex(" "))
            slave.serve(lambda: not failed(), "the last request done")
            print("failed:", failed(), " register 7:", hal("halcmd", "getp", "classicladder.0.s32out-00"))
            attributes = termios.tcgetattr(line_fd)
            print("line:", attributes[4] == termios.B19200, "two stop bits:", bool(attributes[2] & termios.CSTOPB))
            for mode in ("silent", "garbled", "error"):
                slave.mode = mode
                slave.serve(failed, mode)
                slave.log.clear()
                slave.serve(lambda: len(slave.log) >= 9, mode)
                kinds = [frame[:6] for frame in slave.log]
                inner = kinds.index(next(k for k in kinds if k != kinds[0]))
                print(f"{mode}: each request is tried", kinds[inner:inner + 4].count(kinds[inner]), "times")
                slave.mode = "right"
                slave.serve(lambda: not failed(), "right again")
        finally:
            if program:
                program.terminate()
                program.wait(10)
            hal("realtime", "stop")
            os.close(line_fd)
            os.close(master)


if __name__ == "__main__":
    main()
