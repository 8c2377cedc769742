# SPDX-License-Identifier: GPL-2.0-or-later
# What a connection began ends with it, or with its right to command; what others do goes on.
import select
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lib"))
from mill import *
from rsh import *

on(home=False)
server = Server()
a, b = Client(server), Client(server)
a.say("SET VERBOSE ON")
b.say("SET VERBOSE ON")
print("== a jog ends when its client is disabled, by whomever")
d = Client(server)
d.say("HELLO EMC d")
number = next(line.split()[1] for line in b.say("GET CLIENTS") if "'d'" in line)
for how in (lambda: b.say("SET DISABLE " + number), lambda: d.say("SET ENABLE OFF"), lambda: d.say("HELLO EMC d")):
    d.say("HELLO EMC d", "SET ENABLE EMCTOO", "SET WAIT_MODE RECEIVED", "SET JOG 0 600")
    need(lambda s: s.joint[0]["velocity"] > 9, "jog")
    print(how(), until(lambda s: s.joint[0]["velocity"] == 0, 1), messages())
print("== a jog that another client has taken over goes on")
d.say("HELLO EMC d", "SET ENABLE EMCTOO", "SET WAIT_MODE RECEIVED", "SET JOG 0 -300")
b.say("SET WAIT_MODE RECEIVED", "SET JOG 0 -400")
d.say("SET ENABLE OFF")
sleep(0.3)
print(round(poll().joint[0]["velocity"], 1), b.say("SET JOG_STOP 0", "SET WAIT_MODE DONE"))
print("== one that jogged before leaves a program alone when it goes")
print(d.say("HELLO EMC d", "SET ENABLE EMCTOO", "SET ECHO OFF", "SET WAIT_MODE RECEIVED", "SET JOG 0 -600",
            "SET ABORT"))
need(lambda s: s.joint[0]["velocity"] == 0, "rest")
c.teleop_enable(0)
c.wait_complete()
c.home(-1)
need(lambda s: all(s.homed[:3]), "home")
program("G21 G90 G0 X0 Y0\nG1 F600 X5\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(0.1)
messages()
d.close()
print(c.wait_complete(20), messages())
print("== one that waits for homing holds up nobody")
c.mode(MODE_MANUAL)
c.wait_complete()
print(a.say("SET WAIT_MODE RECEIVED", "SET TELEOP_ENABLE OFF", "SET JOINT_UNHOME -1"))
a.send("SET JOINT_HOME -1", "SET JOINT_WAIT_HOMED -1 20", MARK)
need(lambda s: any(j["homing"] for j in s.joint), "homing")
print(b.say("GET JOINT_HOMED", "SET ABORT"), a.read(MARK.encode()[4:]), poll().homed[:3])
print("== one that waits for heartbeats, neither")
a.say("SET WAIT_MODE DONE")
a.send(*["SET WAIT_HEARTBEAT 1000"] * 30)
for _ in range(30):
    b.say("GET ECHO")
a.send(MARK)
answered = a.socket.recv(65536) if select.select([a.socket], [], [], 0)[0] else b""
print("a few of its waits are over:", answered.count(b"WAIT_HEARTBEAT ACK") < 15)
a.read(MARK.encode()[4:])
print("== SHUTDOWN does not wait for one that never listens")
second = Server("-4")
deaf, other = Client(second), Client(second)


def unsent():
    """Bytes that the system holds for the deaf one: at most what its buffers take."""
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return max(int(r[4].split(":")[0], 16) for r in rows if int(r[1].split(":")[1], 16) == second.port)


full = 0
while full < 3: # the rest waits in the server
    before = unsent()
    deaf.send(*["HELP GET"] * 100, end="\n")
    other.say(*["GET ECHO"] * 110)
    full = full + 1 if unsent() == before else 0
other.send("SHUTDOWN")
print(other.read(None), second.end(5))
print("== SIGTERM", server.stop())
