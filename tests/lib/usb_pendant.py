# SPDX-License-Identifier: GPL-2.0-or-later
"""A pendant of XHC for tests (usb_pendant.c) and the program that serves it."""
import os
import signal
import subprocess
import time
from pathlib import Path

from hal_outside import halcmd, until

HERE = Path(__file__).resolve().parent
BLOCK, REPORT_ID = 8, 6


class Pendant:
    """program: its name; prefix: that of its pins; product: of the receiver; size, display: bytes of a report and of
    the display's image in blocks."""

    def __init__(self, program, prefix, product, size, display):
        self.folder = Path(os.environ["PENDANT"])
        self.program, self.prefix, self.product, self.size, self.display = program, prefix, product, size, display
        library = self.folder / "usb.so"
        self.environment = dict(os.environ, LD_PRELOAD=str(library))
        if not library.exists():
            self.make(library)
        self.pipe = os.open(self.folder / "in", os.O_RDWR)

    def make(self, library):
        flags = subprocess.run(["pkg-config", "--cflags", "libusb-1.0"], stdout=subprocess.PIPE, text=True).stdout
        subprocess.run(["cc", "-shared", "-fPIC", *flags.split(), "-o", library, HERE / "usb_pendant.c"], check=True)
        os.mkfifo(self.folder / "in")

    def appear(self, numbers=None):
        (self.folder / "present").write_text(f"{numbers or f'10ce:{self.product:x}'} {self.size}")

    def vanish(self, error=0xFF):
        """Unplugged, while the program waits for a report: a transfer fails (FC to FF: of several ways)."""
        (self.folder / "present").unlink()
        self.send(bytes([error]) * self.size)

    def send(self, report):
        os.write(self.pipe, report)

    def image(self):
        """What the display shows last."""
        blocks = (self.folder / "out").read_bytes()
        whole = len(blocks) // self.display * self.display
        last = blocks[whole - self.display:whole]
        assert all(last[n] == REPORT_ID for n in range(0, self.display, BLOCK))
        return b"".join(last[n + 1:n + BLOCK] for n in range(0, self.display, BLOCK))

    def loops(self):
        """The program has been round at least once since the call: it sends a display each time."""
        seen = self.sent()
        while self.sent() < seen + 3 * self.display:
            time.sleep(0.005)

    def sent(self):
        """Bytes of displays so far; a pendant that was just found has had none."""
        out = self.folder / "out"
        return out.stat().st_size if out.exists() else 0

    def start(self, *options, **changes):
        return subprocess.Popen([self.program, *options], env=self.environment | changes, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def ready(self):
        return self.program in halcmd("list", "comp").split()

    def get(self, pin):
        return halcmd("getp", f"{self.prefix}.{pin}")

    def setp(self, pin, value):
        halcmd("setp", f"{self.prefix}.{pin}", str(value))

    def on(self, *names):
        """Which of these are TRUE."""
        return [n for n in names if self.get(n) == "TRUE"]


def end(program):
    program.send_signal(signal.SIGTERM)
    print("ends with", program.wait(20), program.stdout.read().splitlines())


def coordinates(bytes_of_image):
    """Numbers of whole part and ten-thousandths with a sign."""
    words = [int.from_bytes(bytes_of_image[n:n + 2], "little") for n in range(0, len(bytes_of_image), 2)]
    return [(w + (f & 0x7FFF) / 10000) * (-1 if f & 0x8000 else 1) for w, f in zip(words[::2], words[1::2])]
