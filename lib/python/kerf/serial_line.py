# SPDX-License-Identifier: GPL-2.0-or-later
"""A serial line for programs that ask a device and wait for its answer."""

import errno
import os
import select
import termios
import time

PARITIES = {"none": 0, "even": termios.PARENB, "odd": termios.PARENB | termios.PARODD}
RATES = {int(name[1:]): value for name, value in vars(termios).items() if name[0] == "B" and name[1:].isdigit()}


class SerialLine:
    """8 bits, raw. Raises OSError when it cannot be opened or is gone."""

    def __init__(self, port, rate, parity="none", stop_bits=1):
        self.fd = os.open(port, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            control = termios.CS8 | PARITIES[parity] | termios.CREAD | termios.CLOCAL
            control |= termios.CSTOPB if stop_bits == 2 else 0
            speed, characters = RATES[rate], [b"\0"] * 32
            termios.tcsetattr(self.fd, termios.TCSANOW, [0, 0, control, 0, speed, speed, characters])
        except termios.error as e:
            if e.args[0] != errno.EINVAL:       # a pseudo terminal knows no parity
                os.close(self.fd)
                raise OSError(*e.args) from None

    def close(self):
        os.close(self.fd)

    def send(self, data):
        os.write(self.fd, data)

    def ask(self, question, complete, timeout_s):
        """The answer for which complete(answer) is true; b"" after the time-out. What came before is thrown away."""
        try:
            termios.tcflush(self.fd, termios.TCIFLUSH)
        except termios.error as e:
            raise OSError(*e.args) from None
        self.send(question)
        answer, end = b"", time.monotonic() + timeout_s
        while not complete(answer):
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.fd], [], [], left)[0]:
                return b""
            more = os.read(self.fd, 64)
            if not more:
                raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))
            answer += more
        return answer
