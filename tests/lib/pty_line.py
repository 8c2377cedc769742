# SPDX-License-Identifier: GPL-2.0-or-later
"""One end of a serial line (a pty) for devices of tests."""
import os
import pty
import threading
import tty


class PtyLine:
    """`link`: path of the other end, until unplug() takes it away together with the line; plug() makes it again. A
    device has take(data, write): the bytes that it leaves for later."""

    def __init__(self, link):
        self.link = link
        self.plug()

    def plug(self):
        self.end, self.other = pty.openpty()
        tty.setraw(self.end)
        tty.setraw(self.other)
        if os.path.islink(self.link):
            os.unlink(self.link)
        os.symlink(os.ttyname(self.other), self.link)
        self.plugged = object()
        threading.Thread(target=self.serve, args=(self.end, self.plugged), daemon=True).start()

    def unplug(self):
        """What is written from now on is lost: the kernel keeps the line until the read that waits on it returns."""
        self.plugged = None
        os.unlink(self.link)
        os.close(self.other)
        os.close(self.end)

    def serve(self, end, plugged):
        data = b""
        try:
            while (more := os.read(end, 256)) and self.plugged is plugged:
                data = self.take(data + more, lambda answer: os.write(end, answer))
        except OSError:
            pass
