# SPDX-License-Identifier: GPL-2.0-or-later
"""Mitsubishi drives (computer link) for tests, on one end of a serial line (a pty)."""
import re

from pty_line import PtyLine

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


class Line(PtyLine):
    """A line with drives, by station."""

    def __init__(self, link, drives):
        self.drives = drives
        super().__init__(link)

    def take(self, data, write):
        while frame := re.match(rb"\x05(..)(..)1", data):
            station, command = frame.group(1), frame.group(2).decode()
            size = frame.end() + DATA[command] + 2
            if len(data) < size:
                break
            text, data = data[1:size], data[size:]
            assert checksum(text[:-2]) == text[-2:]
            drive = self.drives.get(station)
            if drive and not drive.silent:
                write(drive.answer(station, command, text[5:-2].decode()))
        return data
