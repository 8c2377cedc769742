# SPDX-License-Identifier: GPL-2.0-or-later
import re
import socket
import sys
from pathlib import Path

from mill import *

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "linuxcncrsh" / "lib"))
from rsh import free_port

on()
port = free_port()
process = clock.spawn(["schedrmt", "-p", str(port), "--", "-ini", "mill.ini"], "schedrmt")


class Client:
    def __init__(self):
        while True:
            try:
                self.socket = socket.create_connection(("127.0.0.1", port))
                break
            except ConnectionRefusedError:
                sleep(0.05)
        self.socket.settimeout(20)
        self.pending = b""

    def raw(self, text):
        """All that comes back for the text."""
        self.socket.sendall(text + b"GET PLAT\r")
        clock.suspend()
        while b"PLAT Linux\r\n" not in self.pending:
            data = self.socket.recv(4096)
            if not data:
                break
            self.pending += data
        clock.resume()
        got, _, self.pending = self.pending.partition(b"PLAT Linux\r\n")
        return got.replace(b"GET PLAT\r", b"")

    def say(self, *lines):
        for line in lines:
            print(f"> {line}: {self.raw(line.encode() + chr(13).encode())!r}")


a = Client()
print("== before HELLO")
a.say("GET ECHO", "SET ECHO OFF", "HELLO EMC me", "HELLO WRONG me 1.0", "hello emc me 1.0")
print("== after")
a.say("GET ECHO", "SET VERBOSE ON", "SET ECHO OFF", "GET ENABLE", "SET QMODE RUN", "SET ENABLE WRONG",
      "SET ENABLE EMCTOO", "GET ENABLE", "SET", "GET", "SET NOSUCH 1", "GET NOSUCH", "GET CONFIG",
      "SET CONFIG x", "GET COMM_MODE", "SET COMM_MODE binary", "GET COMM_MODE", "GET COMM_PROT", "GET INIFILE",
      "SET INIFILE x", "GET INI", "GET DEBUG", "SET DEBUG 0", "GET POLLRATE", "SET POLLRATE x",
      "SET POLLRATE 0.1", "GET POLLRATE", "GET AUTOTAGID", "HELP QUIT", "HELP NOSUCH", "SET ECHO ON",
      "GET ECHO\r\nGET ECHO", "SET ECHO OFF")
print("== a second client takes over")
b = Client()
b.say("HELLO EMC you 1.0", "SET ECHO OFF", "SET ENABLE EMCTOO")
a.say("GET ENABLE", "SET QMODE RUN", "SHUTDOWN", "SET ENABLE EMCTOO")
print("== the queue")
for name, x in (("one", 1), ("two", 2), ("three", 3)):
    Path(f"{name}.ngc").write_text(f"G21 G90 G1 F6000 X{x}\nG0 Y{x}\n(MSG,{name} ran)\nM2\n")
a.say("SET PGMADD 5 0 0 0 0 1 two.ngc 100 100 1", "SET PGMADD 1 40 0 0 0 2 one.ngc 50 80 1",
      "SET PGMADD 9 0 7 8 0 0 three.ngc 100 100 2", "SET PGMADD 1 2 3", "SET PGMADD 1 0 0 0 0 10 x 1 1 1",
      "SET PGMADD 1 0 nan 0 0 0 x 1 1 1", "SET PGMADD 1 0 0 0 0 1 x nan 1 1", "SET PGMADD 1 0 0 0 0 1 x 1 inf 1",
      "SET PGMADD 1 0 0 0 0 1 x -1 1 1")
show = lambda *lines: [print("> " + line + ":", a.raw(line.encode() + b"\r")) for line in lines]
show("GET PGMALL", "GET PGMBYID 40", "GET PGMBYINDEX 1", "GET PGMBYID 41", "GET PRIORITYBYID 40",
     "GET PRIORITYBYINDEX 2", "SET PRIORITYBYID 40 7", "GET PGMBYINDEX 0")
a.say("SET PRIORITYBYINDEX 1 1", "SET DELETEBYID 99", "SET DELETEBYINDEX 9", "GET QMODE", "SET QMODE RESUME")
print("status:", re.sub(rb"\d+\r", b"CRC\r", a.raw(b"GET QSTATUS\r")))
print("== it runs")
a.say("SET QMODE RUN")
seen = []


def ran():
    seen.extend(messages())
    return len(seen) == 3


clock.wait_until(ran, 200, 0.05)
idle()
print(seen, xyz())
clock.wait_until(lambda: b"STOP" in a.raw(b"GET QMODE\r"), 1000, 0.1)
a.say("GET QMODE", "GET QSTATUS")
poll()
print("offsets of the last one:", s.g92_offset[:2], "overrides:", s.feedrate, s.spindle[0]["override"])
print("== a file that is not there, a machine that is off")
a.say("SET PGMADD 1 0 0 0 0 1 /nothing.ngc 100 100 1", "SET QMODE RUN")
clock.wait_until(lambda: b"ERROR" in a.raw(b"GET QMODE\r"), 100, 0.1)
a.say("GET QMODE", "SET QMODE STOP", "GET QSTATUS")
c.state(STATE_OFF)
a.say("SET PGMADD 1 0 0 0 0 1 one.ngc 100 100 1", "SET QMODE RUN")
clock.wait_until(lambda: b"RUN" not in a.raw(b"GET QMODE\r"), 1000, 0.1)  # its sockets are served in wall time
sleep(5)
a.say("GET QMODE")
print("nothing moved:", messages()[-1:])
print("== turned on, the queue waits for somebody to say so")
on(home=False)
sleep(3)
print(s.interp_state == INTERP_IDLE, *[a.raw(b"GET QMODE\r")])
print("== a job that is stopped ends the queue")
Path("long.ngc").write_text("G21 G90 G1 F60 X9\nX0\nM2\n")
for what, stop in (("abort", c.abort), ("machine off", lambda: c.state(STATE_OFF)),
                   ("emergency stop", lambda: c.state(STATE_ESTOP)),
                   ("machine off and on", lambda: (c.state(STATE_OFF), c.wait_complete(), c.state(STATE_ON)))):
    a.say("SET QMODE STOP", "SET PGMADD 1 0 0 0 0 1 long.ngc 100 100 1", "SET PGMADD 2 0 0 0 0 1 one.ngc 100 100 1",
          "SET QMODE RUN")
    if poll().task_state != STATE_ON:
        on(home=False)
        a.say("SET QMODE RUN")
    need(lambda s: s.interp_state != INTERP_IDLE and s.task_mode == MODE_AUTO and s.current_vel > 0, "job")
    if what == "abort":
        c.jog(JOG_CONTINUOUS, True, 0, 10)     # of another program: refused
    sleep(0.2)
    stop()
    c.wait_complete()
    sleep(1)
    if poll().task_state != STATE_ON:
        on(home=False)
    sleep(3)
    clock.wait_until(lambda: b"RUN" not in a.raw(b"GET QMODE\r"), 1000, 0.1)
    print(f"{what}: {'stands' if poll().interp_state == INTERP_IDLE else 'goes on'}", *[a.raw(b"GET QMODE\r")],
          messages()[:1])
print("== a job with a mistake ends it too; a command of another program that is refused does not")
a.say("SET QMODE STOP")
Path("bad.ngc").write_text("G21 G90 G1 F600 X1\nG1 X2 F-1\nM2\n")
for name in ("bad", "long"):
    a.say(f"SET PGMADD 1 0 0 0 0 1 {name}.ngc 100 100 1", "SET PGMADD 2 0 0 0 0 1 one.ngc 100 100 1", "SET QMODE RUN")
    need(lambda s: s.interp_state != INTERP_IDLE and s.task_mode == MODE_AUTO and s.current_vel > 0, "job")
    c.jog(JOG_CONTINUOUS, True, 0, 10)
    clock.wait_until(lambda: b"RUN" not in a.raw(b"GET QMODE\r"), 100, 0.5)
    print(name, a.raw(b"GET QMODE\r"), messages())
    a.say("SET QMODE STOP")
print("== while a job is set up everybody is served, and it can be taken away")
a.say("SET QMODE STOP")
c.feedrate(1)
mdi("G92.1")
mdi("G54 G53 G0 X0 Y0")
c.rapidrate(0.008)
for take_away in "SET QMODE STOP", "SET DELETEBYINDEX 0":
    a.say("SET PGMADD 1 0 60 0 0 0 one.ngc 100 100 1", "SET QMODE RUN")
    need(lambda s: s.current_vel > 0, "way to its place")
    a.say("GET QMODE", take_away)
    print("on the way:", poll().current_vel > 0, "has control:", s.control_pid == process.pid)
    c.abort()
    need(lambda s: s.control_pid == 0 and s.inpos, "end of control")
    clock.wait_until(lambda: b"STOP" in a.raw(b"GET QMODE\r"), 100, 0.1)
    a.say("GET QSTATUS")
c.rapidrate(1)
print("== garbage and the end")
g = Client()
g.socket.sendall(bytes(range(256)) * 40 + b"\r")
g.socket.close()
a.say("GET QMODE", "SET QMODE PAUSE", "GET QMODE")
b.raw(b"QUIT\r")
a.socket.sendall(b"SHUTDOWN\r")
clock.suspend()
print(process.wait(20))
clock.resume()
