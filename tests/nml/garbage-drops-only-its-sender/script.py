# SPDX-License-Identifier: GPL-2.0-or-later
import random
import struct
import threading

from wire import *

server = Server()
good = Client()
print("name:", good.request(NAME, COMMAND, reply=40)[8:].rstrip(b"\0"))
print("write:", good.write(COMMAND, NULL), good.write(COMMAND, NULL), "length", good.number(LENGTH, COMMAND), "count",
      good.number(COUNT, COMMAND))
print("read:", good.read(COMMAND)[:2], good.read(COMMAND)[:2], good.read(COMMAND))
print("status before a writer:", good.read(STATUS, 3))
print("check_if_read:", good.number(CHECK, COMMAND), "clear:",
      struct.unpack(">Ii", good.request(CLEAR, ERROR, reply=8))[1], "space:", good.number(SPACE, ERROR)[0])
print("no such buffer:", struct.unpack(">Iiiii", good.request(READ, 77, 1, 0, reply=20))[1])
late = struct.unpack(">Iiiii", good.request(BLOCKING, COMMAND, 1, 0, struct.pack(">i", 50), 20))
print("blocking read, timed out:", late[1:3])


def later():
    Client().write(COMMAND, NULL)


threading.Timer(0.05, later).start()
print("blocking read, message comes:",
      struct.unpack(">Iiiii", good.request(BLOCKING, COMMAND, 1, 0, struct.pack(">i", 20000), 20))[1:4:2],
      len(good.take(16)))

print("== what drops its sender")
for what, kind, extra in (("unknown request", 99, b""), ("request 0", 0, b""),
                          ("a message that is none", WRITE, b"\xff" * 20), ("a message cut short", WRITE, NULL[:9]),
                          ("an unknown message", WRITE, struct.pack(">iqi", 4711, 24, 0)),
                          ("a text too long", WRITE, struct.pack(">iqiI", 509, 300, 0, 70000) + b"G" * 200)):
    c = Client()
    c.request(kind, COMMAND, 4, len(extra), extra)
    print(what, c.dropped(), server.wait_log("dropped"))
big = Client()
big.request(WRITE, COMMAND, 4, 0x7fffffff)
print("too long", big.dropped())
lines = server.log().count("dropped")
print("log lines:", lines)

print("== noise")
dice = random.Random(11)
for n in range(300):
    noise = Client()
    try:
        if n % 3 == 0:
            noise.socket.sendall(dice.randbytes(dice.randrange(1, 3000)))
        elif n % 3 == 1:  # requests that look right
            for _ in range(20):
                extra = bytearray(NULL + dice.randbytes(dice.randrange(0, 300)))
                for _ in range(3):
                    extra[dice.randrange(len(extra))] = dice.randrange(256)
                noise.socket.sendall(struct.pack(">5I", dice.randrange(1 << 32), dice.randrange(1, 19),
                                                 dice.randrange(0, 5), dice.randrange(0, 12), len(extra)) + extra)
        else:  # half a request, then gone
            noise.socket.sendall(struct.pack(">5I", 1, WRITE, COMMAND, 4, 4000)[:dice.randrange(1, 20)])
        if n % 2:
            noise.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
    except OSError:
        pass
    noise.socket.close()
    if good.number(COUNT, COMMAND) is None:
        print("the good client was dropped at", n)
        break
print("alive:", server.alive(), "log lines more:", server.log().count("dropped") > lines + 50)
while (got := good.read(COMMAND)) and got[0] == 2:
    pass
good.request(CLEAR, COMMAND, reply=8)

print("== many clients, thousands of messages, none lost")
COUNT_EACH, CLIENTS, serials = 1000, 6, []


def writer():
    c, mine = Client(), []
    while len(mine) < COUNT_EACH:
        number, status, _ = c.write(COMMAND, NULL)
        if status == 3:
            mine.append(number)
    serials.append(mine)


threads = [threading.Thread(target=writer) for _ in range(CLIENTS)]
for t in threads:
    t.start()
read = []
while len(read) < COUNT_EACH * CLIENTS:
    got = good.read(COMMAND)
    if got[0] == 2:
        read.append(struct.unpack(">iqi", got[2])[2])
for t in threads:
    t.join()
print(len(read), read == sorted(read), sorted(read) == sorted(n for mine in serials for n in mine),
      all(mine == sorted(mine) for mine in serials))
print("too many connections:", server.alive())
crowd = [socket.create_connection(("127.0.0.1", port())) for _ in range(210)]
print(server.wait_log("one connection too many"), good.number(COUNT, COMMAND) is not None)
for s in crowd:
    s.close()
server.stop()

print("== where the log goes")
for what, ini, lines in (("two errors at most", "RCS_MAX_ERR = 2", 2), ("nowhere", "RCS_DEBUG_DEST = NULL", 0),
                         ("no errors", "RCS_DEBUG = 0x100", 0), ("standard error", "RCS_DEBUG_DEST = stderr", 4)):
    server = Server("", ini)
    for n in range(4):
        c = Client()
        c.request(99, COMMAND)
        c.dropped()
    print(what, server.log().count("dropped") == lines)
    server.stop()
