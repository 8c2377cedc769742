# SPDX-License-Identifier: GPL-2.0-or-later
"""Mitsubishi drives (computer link) for tests, on one end of a serial line (a pty)."""
import os
import pty
import re
import threading
import tty

DATA = {"7A": 0, "6F": 0, "70": 0, "71": 0, "72": 0, "F3": 2, "FA": 2, "ED": 4, "FD": 4}


def checksum(text):
    return b"%02X" % (sum(text) & 0xFF)


class Drive:
    """Turns at once as it is told."""

    def __init__(self):
        self.values = {"7A": "00", "6F": "0BB8", "70": "00FA", "71": "0898", "72": "002A"}
        self.told, self.asked, self.turns = [], [], "00"
        self.silent = self.broken = self.refuses = False

    def answer(self, station, command, data):
        if not DATA[command]:
            self.asked.append(command)
            text = station + self.values[command].encode()
            return b"\x02" + text + b"\x03" + (b"??" if self.broken else checksum(text))
        if self.refuses:
            return b"\x15" + station + b"A"
        self.told.append((command, data))
        if command == "FA":
            self.turns = data
        return b"" if command == "FD" else b"\x06" + station


class Line:
    """`link`: path of the other end, until unplug() takes it away together with the line; plug() makes it again."""

    def __init__(self, link, drives):
        self.link, self.drives = link, drives
        self.plug()

    def plug(self):
        self.end, self.other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(self.other)
        if os.path.islink(self.link):
            os.unlink(self.link)
        os.symlink(os.ttyname(self.other), self.link)
        threading.Thread(target=self.serve, args=(self.end,), daemon=True).start()

    def unplug(self):
        os.unlink(self.link)
        os.close(self.other)
        os.close(self.end)

    def serve(self, end):
        data = b""
        try:
            while more := os.read(end, 256):
                data += more
                while frame := re.match(rb"\x05(..)(..)1", data):
                    station, command = frame.group(1), frame.group(2).decode()
                    size = frame.end() + DATA[command] + 2
                    if len(data) < size:
                        break
                    text, data = data[1:size], data[size:]
                    assert checksum(text[:-2]) == text[-2:]
                    drive = self.drives.get(station)
                    if drive and not drive.silent:
                        os.write(end, drive.answer(station, command, text[5:-2].decode()))
        except OSError:
            pass
