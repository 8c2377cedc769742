# SPDX-License-Identifier: GPL-2.0-or-later
"""The TCP protocol of NML as a foreign client speaks it, and a linuxcncsvr to speak to."""
import os
import socket
import struct
import subprocess
import time
from pathlib import Path

from kerf import instance

READ, WRITE, CHECK, CLEAR, CLOSE, KEYS, LOGIN, BLOCKING, NAME, COUNT, LENGTH, SPACE = 1, 2, 3, 5, 6, 7, 8, 11, 12, 16, 17, 18
COMMAND, STATUS, ERROR = 1, 2, 3
NULL = struct.pack(">iqi", 21, 24, 0)  # the message EMC_NULL


def port(documented=5005):
    return instance.port(documented)


class Server:
    """linuxcncsvr with buffer options `extra` and INI lines `ini`; its output is in svr.log."""
    def __init__(self, extra="", ini="", process="LOCAL localhost"):
        lines = [f"B emcCommand SHMEM localhost 8192 0 0 1 16 1001 TCP=5005 xdr queue confirm_write serial {extra}",
                 f"B emcStatus SHMEM localhost 20480 0 0 2 16 1002 TCP=5005 xdr {extra}",
                 f"B emcError SHMEM localhost 8192 0 0 3 16 1003 TCP=5005 xdr queue {extra}"]
        for who, kind, server in (("emc", "LOCAL localhost", "0 1.0 0 0"), ("emcsvr", "LOCAL localhost", "1 1.0 1 2"),
                                  ("xemc", process, "0 10.0 0 10")):
            lines.append(f"P {who} default {kind} RW {server}")
        Path("test.nml").write_text("\n".join(lines) + "\n")
        Path("test.ini").write_text(f"[EMC]\nNML_FILE = {Path('test.nml').resolve()}\n{ini}\n")
        with open("svr.log", "w") as log:
            self.status = subprocess.run(["linuxcncsvr", "-ini", "test.ini"], stdout=log, stderr=log,
                                         stdin=subprocess.DEVNULL).returncode
        self.pid = None
        for _ in range(200):  # it goes into the background by way of two short-lived processes
            before, self.pid = self.pid, self.find()
            if self.status or (self.pid and before == self.pid):
                break
            time.sleep(0.05)

    @staticmethod
    def find():
        """The process that has our folder and that name."""
        for p in Path("/proc").iterdir():
            try:
                if (p.name.isdigit() and (p / "comm").read_text() == "linuxcncsvr\n"
                        and os.readlink(p / "cwd") == os.getcwd()):
                    return int(p.name)
            except OSError:
                pass

    def alive(self):
        return self.pid is not None and self.find() == self.pid

    def log(self):
        return Path("svr.log").read_text()

    def wait_log(self, text):
        for _ in range(500):
            if text in self.log():
                return True
            time.sleep(0.02)
        return False

    def stop(self):
        os.kill(self.pid, 15)
        while self.alive():
            time.sleep(0.01)
        for k in (1001, 1002, 1003):
            subprocess.run(["ipcrm", "-M", str(instance.key(k))], stderr=subprocess.DEVNULL)
        for f in ("test.nml", "test.ini", "svr.log"):
            Path(f).unlink()


class Client:
    def __init__(self, address="127.0.0.1"):
        for _ in range(200):
            try:
                self.socket = socket.create_connection((address, port()), 10)
                break
            except ConnectionRefusedError:
                time.sleep(0.02)
        self.serial = 0

    def request(self, kind, buffer, w3=0, w4=0, extra=b"", reply=0):
        """The words of the answer (its serial is checked), and what follows them; None when dropped."""
        self.serial += 1
        try:
            self.socket.sendall(struct.pack(">5I", self.serial, kind, buffer, w3, w4) + extra)
            got = self.take(reply)
        except OSError:
            return None
        return got

    def take(self, n):
        data = b""
        while len(data) < n:
            more = self.socket.recv(n - len(data))
            if not more:
                return None
            data += more
        return data

    def read(self, buffer, access=1, last=0):
        head = self.request(READ, buffer, access, last, reply=20)
        if head is None:
            return None
        serial, status, size, write_id, was_read = struct.unpack(">Iiiii", head)
        return status, write_id, self.take(size)

    def write(self, buffer, message):
        got = self.request(WRITE, buffer, 4, len(message), message, 12)
        return None if got is None else struct.unpack(">iii", got)

    def number(self, kind, buffer):
        got = self.request(kind, buffer, reply=12)
        return None if got is None else struct.unpack(">Iii", got)[1:]

    def dropped(self):
        try:
            return self.socket.recv(1) == b""
        except OSError:
            return True
