# SPDX-License-Identifier: GPL-2.0-or-later
# FP-155: a hundred clients that ask as often as they can hold up neither motion, nor each other, nor a stop.
import os
import socket
import struct
import sys
import threading
import time
from pathlib import Path

for other in ("nml", "linuxcncrsh"):
    sys.path.insert(0, os.environ["EMC2_HOME"] + f"/tests/{other}/lib")
import rsh
import wire
from mill import *

CLIENTS = 100
ASK = struct.pack(">5I", 1, wire.READ, wire.STATUS, 1, 0)
COMMAND = struct.pack(">5I", 1, wire.WRITE, wire.COMMAND, 4, len(wire.NULL)) + wire.NULL


class Flood:
    """Each connection is kept full of this request, its answers are taken, until the end of the block."""

    def __init__(self, sockets, request):
        self.sockets, self.request, self.over, self.dropped, self.answers = sockets, request, False, 0, 0

    def __enter__(self):
        for s in self.sockets:
            s.setblocking(False)
        self.thread = threading.Thread(target=self.run)
        self.thread.start()
        clock.suspend()
        while not self.answers:
            time.sleep(0.001)
        clock.resume()

    def run(self):
        while not self.over:
            for s in self.sockets:
                try:
                    self.answers += len(s.recv(1 << 18))
                except BlockingIOError:
                    pass
                except OSError:
                    self.dropped += 1
                try:
                    s.send(self.request * 20)
                except OSError:  # full
                    pass
            time.sleep(0.001)

    def __exit__(self, *_):
        self.over = True
        self.thread.join()
        for s in self.sockets:
            s.close()
        print("dropped:", self.dropped)


def remote(n):
    return [wire.Client().socket for _ in range(n)]


def run(each_ms=lambda: None):
    """Virtual seconds that the program takes."""
    begin = clock.now()
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.interp_state != INTERP_IDLE, "start")
    while poll().interp_state != INTERP_IDLE:
        each_ms()
        sleep(0.001)
    return round(clock.now() - begin, 3)


def as_long(*each_ms):
    """Does the program take as long as alone? (It begins with a cycle of task of 10 ms.)"""
    took = run(*each_ms)
    return abs(took - alone) < 0.03 or (took, alone)


on()
Path("part.ngc").write_text("G21 G90 G64 F3000\n" + "".join(f"G1 X{n * 7 % 5} Y{n % 3}\n" for n in range(20)) + "M2\n")
mode(MODE_AUTO)
c.program_open(str(Path("part.ngc").resolve()))
server = rsh.Server()
run()
alone = run()
readers = [linuxcnc.stat() for _ in range(CLIENTS)]
print("== a hundred programs that poll at 1 kHz:", as_long(lambda: [r.poll() for r in readers]))
print("== a hundred connections to linuxcncsvr")
with Flood(remote(CLIENTS), ASK):
    print("the program takes as long:", as_long())
print("== a hundred to linuxcncrsh")
clients = [rsh.Client(server, enable=False).socket for _ in range(CLIENTS)]
with Flood(clients, b"GET ABS_ACT_POS\r\nGET PROGRAM_STATUS\r\n"):
    print("the program takes as long:", as_long())

print("== one that sends 1500 requests at once is served at 1 kHz, others at once")
flooder, other = rsh.Client(server), rsh.Client(server)
begin = clock.now()
flooder.send(*["GET ESTOP"] * 1499, rsh.MARK)
print(other.say("GET MODE"), "at once:", clock.now() - begin < 0.1)
answers = flooder.read(b"PLAT Linux\r\n").count(b"ESTOP OFF")
print("linuxcncrsh:", answers, clock.now() - begin > 1.2)
clock.suspend()
flooder, other = wire.Client(), wire.Client()
begin = time.monotonic()
flooder.socket.sendall(struct.pack(">5I", 1, wire.SPACE, wire.COMMAND, 0, 0) * 1500)
print(other.number(wire.SPACE, wire.COMMAND)[0])
print("linuxcncsvr:", len(flooder.take(1500 * 12)) // 12, time.monotonic() - begin > 1.2)
clock.resume()

print("== a hundred that fill the queue of commands: every stop comes through, soon")
refused, longest = 0, 0
mode(MODE_MDI)
with Flood(remote(CLIENTS), COMMAND):
    for n in range(10):
        c.mdi(f"G0 X{300 * (n % 2)}")
        need(lambda s: s.current_vel > 10, "motion")
        begin = clock.now()
        try:
            c.abort()
        except linuxcnc.error:
            refused += 1
        longest = max(longest, clock.now() - begin)
        need(lambda s: s.current_vel == 0, "standstill")
print("refused:", refused, "within 0.3 s:", longest < 0.3 or longest)
print(server.stop(), messages())
