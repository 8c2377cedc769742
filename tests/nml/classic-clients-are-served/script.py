# SPDX-License-Identifier: GPL-2.0-or-later
# As the clients of LinuxCNC speak: they begin with the name of the buffer and number 0, expect replies
# one above, and send texts and pieces of programs in full length.
from wire import *


class Classic(Client):
    def __init__(self):
        super().__init__()
        self.serial = -1

    def request(self, *args, **named):
        got = super().request(*args, **named)
        return (got if got is None or struct.unpack(">I", got[:4])[0] == self.serial + 1
                else f"numbered {got[:4]} for {self.serial}".encode())


def text(value, room):
    return struct.pack(">I", room) + value.ljust(room + -room % 4, b"\0")


def status(client, kind, size, extra):
    """Of a write, whose reply begins with the number of the message."""
    got = Client.request(client, WRITE, COMMAND, 4, len(extra) + 16, struct.pack(">iqi", kind, size, 0) + extra, 12)
    return got and struct.unpack(">iii", got)


server = Server()
c = Classic()
print(c.request(NAME, COMMAND, reply=40)[8:].rstrip(b"\0"), c.number(LENGTH, COMMAND))
print("MDI:", status(c, 509, 280, text(b"G0 X1", 255)))
print("MDI without an end:", status(Classic(), 509, 280, text(b"x" * 255, 255)))
piece = bytes(range(256)) * 16
print("a piece of a program:",
      status(c, 506, 4400, text(b"/tmp/far.ngc", 255) + struct.pack(">QQ", 10000, 4096) + text(piece, 4096)))
sent = []
for _ in range(2):
    got = c.read(COMMAND)
    sent.append(got[2])
print("comes back:", sent[0][16:26], len(sent[0]) - 16, sent[1][-4096:] == piece)
other = Client()
print("others:", other.number(LENGTH, COMMAND),
      struct.unpack(">I", other.request(NAME, STATUS, reply=40)[:4])[0] == other.serial)
server.stop()
