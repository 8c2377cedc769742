# SPDX-License-Identifier: GPL-2.0-or-later
# FP-126: a client that goes away in the middle of a command blocks nobody, and no bad parameter
# ends the server.
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lib"))
from mill import *
from rsh import *

on()
server = Server()
a, b = Client(server), Client(server)
a.say("SET VERBOSE ON")
b.say("SET VERBOSE ON")
print("clients:", sorted(line.split()[2:] for line in a.say("GET CLIENTS")))

print("== one command at a time, but stopping always goes")
mode(MODE_MDI)
a.send("SET MDI G0 X50", MARK)
until(lambda s: s.interp_state != INTERP_IDLE)
for line in ("SET MIST ON", "SET MODE MANUAL", "GET MODE", "SET MACHINE ON", "SET ESTOP OFF",
             "SET WAIT_HEARTBEAT", "SET ABORT"):
    print("b>", line, b.say(line))
print("a<", a.read(b"PLAT Linux\r\n"))
print("b>", b.say("SET MIST ON"), b.say("SET MIST OFF"))

print("== lines wait while a command of the same client is under way")
print(a.say("SET MDI G0 X60", "SET MDI G0 X0", "GET ABS_ACT_POS X"))

print("== a time-out")
print(a.say("SET TIMEOUT 0.05", "SET MDI G4 P5"), b.say("SET ABORT"), a.say("SET TIMEOUT 0"))

print("== the waiting client goes away", b.say("SET WAIT_MODE RECEIVED"))
for how in ("close", "end of input"):
    c3 = Client(server)
    mode(MODE_MDI)
    c3.send("SET MDI G4 P1000")
    need(lambda s: s.interp_state != INTERP_IDLE, "dwell")
    if how == "close":
        c3.close()
    else:
        c3.socket.shutdown(1)
    reply = ["still active"]
    while "still active" in reply[0]:
        reply = b.say("SET FLOOD OFF")
    print(how, "->", reply, b.say("SET ABORT"))
    c3.close()

print("== STEP waits until another client aborts", b.say("SET WAIT_MODE DONE"))
Path("step.ngc").write_text("G0 X1\nG0 X2\nM2\n")
print(a.say("SET MODE AUTO", f"SET OPEN {Path('step.ngc').resolve()}"))
a.send("SET STEP", MARK)
need(lambda s: s.interp_state == INTERP_PAUSED, "paused program")
print(b.say("SET ABORT"), a.read(b"PLAT Linux\r\n"), a.say("SET MODE MANUAL"))

print("== half a line is no command")
c4 = Client(server)
c4.socket.sendall(b"SET MI")
sleep(0.05)
c4.socket.sendall(b"ST ON\n\n\r\n")
c4.say("GET ECHO")
print(b.say("GET MIST"), b.say("SET MIST OFF"))
c4.socket.sendall(b"SET MIST ON")
c4.close()
sleep(0.05)
print(b.say("GET MIST"))

words = [line.split()[0] for line in b.say("HELP SET")[1:] if line.startswith("    ")]
print("== every subcommand: none, a wrong one and too many parameters; one answer each")
wrong = []
for word in sorted(({line.split()[0] for line in b.say("HELP GET")[1:] if line.startswith("    ")} | set(words))
                   - {"PLAT"}):
    for verb in ("GET", "SET"):
        for parameters in ("", "?", "? ? ? ? ? ? ? ? ? ? ? ?", "-1 0 0 0 0 0 0 0 0 0 0 0"):
            if verb == "SET":
                b.say("HELLO EMC b", "SET ENABLE EMCTOO", "SET VERBOSE ON", "SET ECHO OFF", "SET TIMESTAMP OFF",
                      "SET WAIT_MODE RECEIVED", "SET TIMEOUT 0")
            answer = b.say(f"{verb} {word} {parameters}")
            ends = [line for line in answer if line in (f"{verb} {word} ACK", f"{verb} {word} NAK")]
            if (verb == "SET" and len(ends) != 1 or verb == "GET"
                    and (not answer and word not in ("WAIT", "WAIT_HEARTBEAT", "PROBE", "PROBE_CLEAR")
                         or len(ends) > 1)):
                wrong.append((verb, word, parameters, answer))
b.say("SET ABORT", "SET WAIT_MODE DONE", "SET MODE MANUAL")
print("wrong:", wrong, "alive:", server.process.poll())
print("== nonsense of all kinds")
dice = random.Random(4)
values = ["", "-1", "0", "99999999999", "-2147483649", "x", "1e400", "nan", "on", "\x00\x01", "%s%n", "'\"", "ä" * 30,
          "X", "a b c d e f g", "A" * 300]
skipped = {"JOINT_WAIT_HOMED", "WAIT", "STEP", "TIMESTAMP", "ECHO", "VERBOSE", "ENABLE", "DISABLE", "RUN", "WAIT_MODE",
           "MACHINE", "ESTOP", "TIMEOUT"}
for n in range(400):
    verb = dice.choice(["GET", "SET", "SET"])
    word = dice.choice([w for w in words if verb == "GET" or w not in skipped])
    if verb == "SET" and word in ("JOG", "JOG_INCR", "HOME", "JOINT_HOME", "MDI", "PROBE", "SPINDLE"):
        b.say("SET WAIT_MODE RECEIVED")
    b.say(f"{verb} {word} {dice.choice(values)} {dice.choice(values)}")
b.say("SET ABORT", "SET WAIT_MODE DONE")
print("alive:", b.say("GET ECHO"), server.process.poll())

print("== clients killed at random points")
for n in range(60):
    victim = Client(server, enable=False)
    text = "HELLO EMC v 1\r\nSET ENABLE EMCTOO\r\nSET MODE MDI\r\nSET MDI G4 P0.01\r\nSET MIST ON\r\nSET MIST OFF\r\nGET ABS_ACT_POS\r\n" * 3
    victim.socket.sendall(text[:dice.randrange(len(text))].encode())
    if n % 2:
        victim.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
    victim.close()
a.say("SET ABORT")
sleep(1)
print("still here:", b.say("SET MODE MANUAL"), len(b.say("GET CLIENTS")), server.process.poll())
print("== one that asks and never listens is dropped")
deaf = Client(server)
deaf.socket.setblocking(False)
sent = 0
while True:
    try:
        sent += deaf.socket.send(b"HELP GET\n" * 1000)
    except BlockingIOError:
        if b.say("GET ECHO") != ["ECHO OFF"]:
            print("the others wait")
    except OSError:
        break
print("dropped", b.say("GET ECHO"), server.process.poll())
print("== a jog ends with the client that began it, others' jogs go on")
c.mode(MODE_MANUAL)
c.wait_complete()
c.teleop_enable(0)
sleep(0.1)
d, f = Client(server), Client(server)
print(d.say("SET WAIT_MODE RECEIVED", "SET JOG 0 600"), f.say("SET WAIT_MODE RECEIVED", "SET JOG 1 600"))
need(lambda s: s.joint[0]["velocity"] > 9 and s.joint[1]["velocity"] > 9, "two jogs")
d.close()
need(lambda s: s.joint[0]["velocity"] == 0, "stop of joint 0")
print("the other one:", poll().joint[1]["velocity"] > 9)
print(f.say("SET JOG_STOP 1", "SET MACHINE OFF"))
print("== SIGTERM", server.stop())
