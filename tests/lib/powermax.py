# SPDX-License-Identifier: GPL-2.0-or-later
"""A Powermax plasma cutter for tests, on one end of a serial line (a pty)."""
import os
import pty
import threading
import tty

REMOTE = {0x2093, 0x2094, 0x2096}


class Powermax:
    def __init__(self):
        self.registers = {0x2098: 0, 0x2099: 20 * 64, 0x209A: 45 * 64, 0x209C: 50 * 128, 0x209D: 80 * 128,
                          0x209E: 0x1234, 0x209F: 2} | dict.fromkeys(REMOTE, 0)
        self.silent = self.broken = False
        self.end, self.other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(self.other)
        self.path = os.ttyname(self.other)
        threading.Thread(target=self.serve, daemon=True).start()

    @staticmethod
    def frame(text):
        return b":%s%02X\r\n" % (text, -sum(bytes.fromhex(text.decode())) & 0xFF)

    def unplug(self):
        os.close(self.other)
        os.close(self.end)

    def serve(self):
        try:
            self.answer_all()
        except OSError:
            pass                # unplugged

    def answer_all(self):
        data = b""
        while more := os.read(self.end, 256):
            data += more
            while b"\r\n" in data:
                line, data = data.split(b"\r\n", 1)
                body = line[1:-2]
                assert self.frame(body) == line + b"\r\n", line
                function, register, value = body[:4], int(body[4:8], 16), int(body[8:12], 16)
                if self.silent:
                    continue
                if function == b"0106":
                    self.registers[register] = value
                    answer = self.frame(body)
                else:
                    assert (function, value) == (b"0104", 1), line
                    answer = self.frame(b"010402%04X" % self.registers[register])
                os.write(self.end, answer[:-3] + b"?\r\n" if self.broken else answer)
