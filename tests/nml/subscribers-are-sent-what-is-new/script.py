# SPDX-License-Identifier: GPL-2.0-or-later
# Requests 9 and 13: the server sends what comes new; a subscriber that is slow, or dies, disturbs nobody.
from wire import *

SUBSCRIBE, CANCEL, DIAGNOSE = 9, 13, 15
POLLED, VARIABLE = 1, 2


def answer(client, kind, buffer, w3=0, w4=0):
    return struct.unpack(">I", client.request(kind, buffer, w3, w4, reply=8)[4:])[0]


def news(client, buffer_message=NULL):
    """(serial, status, write id) of the next message that the server sends by itself."""
    serial, status, size, write_id, _ = struct.unpack(">Iiiii", client.take(20))
    return serial, status, write_id, client.take(size)[:4] == buffer_message[:4]


server = Server("diag")
writer, reader = Client(), Client()
print("asked for:", answer(reader, SUBSCRIBE, COMMAND, VARIABLE), "unknown kind:",
      answer(Client(), SUBSCRIBE, COMMAND, 7))
mine = reader.serial
for n in range(3):
    writer.write(COMMAND, NULL)
got = [news(reader) for n in range(3)]
print("each of a queue:", [g[1:] for g in got], "with the subscription's number:", all(g[0] == mine for g in got))
print("other requests beside it:", reader.number(COUNT, COMMAND))
print("ended:", answer(reader, CANCEL, COMMAND), "again:", answer(reader, CANCEL, COMMAND))
writer.write(COMMAND, NULL)
print("then asked:", reader.read(COMMAND)[:2])

print("polled:", answer(reader, SUBSCRIBE, COMMAND, POLLED, 300))
begin = time.monotonic()
for n in range(2):
    writer.write(COMMAND, NULL)
first, second = news(reader), news(reader)
print("one in each period:", first[2], second[2], time.monotonic() - begin > 0.2)
answer(reader, CANCEL, COMMAND)

# Who is slow: its answers wait in the server up to a bound, the queue keeps the rest.
lazy = Client()
lazy.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
answer(lazy, SUBSCRIBE, COMMAND, VARIABLE)
for n in range(3000):
    writer.write(COMMAND, NULL)
print("served beside a slow one:", reader.number(COUNT, COMMAND) is not None, "alive:", server.alive())
lazy.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
lazy.socket.close()
print("after its death:", reader.number(COUNT, COMMAND) is not None)

head = writer.request(DIAGNOSE, COMMAND, reply=12)
serial, status, count = struct.unpack(">Iii", head)
cnum, name, pid, reads, read_bytes, writes, write_bytes, last = struct.unpack(">i16siqqqqq", writer.take(64))
print("diagnostics:", status, count, cnum, name.rstrip(b"\0"), pid == server.pid, reads > 3, read_bytes == 24 * reads,
      writes, write_bytes == 24 * writes, last > 0)
server.stop()
print("without the option:", end=" ")
server = Server()
print(struct.unpack(">ii", Client().request(DIAGNOSE, COMMAND, reply=12)[4:]))
server.stop()
