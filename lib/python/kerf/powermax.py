# SPDX-License-Identifier: GPL-2.0-or-later
"""Powermax plasma cutters on a serial line: registers, and Modbus ASCII at 19200 8E1. Source: Modbus sheet, section 8."""

from kerf.serial_line import SerialLine

TIMEOUT_S = 0.1
MODE, CURRENT, PRESSURE, FAULT = 0x2093, 0x2094, 0x2096, 0x2098
CURRENT_MIN, CURRENT_MAX, PRESSURE_MIN, PRESSURE_MAX = 0x2099, 0x209A, 0x209C, 0x209D
ARC_LOW, ARC_HIGH = 0x209E, 0x209F
SCALE = {MODE: 1, CURRENT: 64, PRESSURE: 128, FAULT: 1, CURRENT_MIN: 64, CURRENT_MAX: 64, PRESSURE_MIN: 128,
         PRESSURE_MAX: 128}
SET = {MODE: "mode", CURRENT: "current", PRESSURE: "pressure"}
LIMITS = {CURRENT_MIN: "current_min", CURRENT_MAX: "current_max", PRESSURE_MIN: "pressure_min",
          PRESSURE_MAX: "pressure_max"}


def lrc(text):
    """Two digits that make the sum of all bytes 0."""
    return b"%02X" % (-sum(bytes.fromhex(text.decode())) & 0xFF)


def raw(register, value):
    """What the register holds for a value in its unit."""
    return min(max(int(value * SCALE[register]), 0), 0xFFFF)


class Line:
    """A cutter's line. Raises OSError when it cannot be opened or is gone."""

    def __init__(self, port):
        self.line = SerialLine(port, 19200, "even")

    def close(self):
        self.line.close()

    def ask(self, body):
        """The answer to a frame, whole lines only; b"" after the time-out."""
        return self.line.ask(b":" + body + lrc(body) + b"\r\n", lambda answer: answer.endswith(b"\r\n"), TIMEOUT_S)

    def write(self, register, value):
        body = b"0106%04X%04X" % (register, value)
        return self.ask(body) == b":" + body + lrc(body) + b"\r\n"

    def read(self, register):
        """Its value, or None."""
        answer = self.ask(b"0104%04X0001" % register)
        try:
            good = len(answer) == 15 and answer[:7] == b":010402" and lrc(answer[1:11]) == answer[11:13]
            return int(answer[7:11], 16) if good else None
        except ValueError:
            return None
