# SPDX-License-Identifier: GPL-2.0-or-later
# FP-060, FP-061: a continuous jog has one owner. When that ends, is killed, or its connection is cut, the
# axis stops; a jog of another program, and an incremental one, goes on.
import os
import re
import signal
import socket
import struct
import subprocess

import hal

from mill import *
from wire import port

CLIENT = """
import linuxcnc, sys
from kerf import clock
clock.join("client", 600)
c = linuxcnc.command()
{}
print("jogs", flush=True)
clock.sleep(1000)
"""


def client(text):
    child = clock.spawn(["/usr/bin/python3", "-c", CLIENT.format(text)], "client", priority=600, stdout=subprocess.PIPE)
    return child


def moves(axis):
    a = poll().position[axis]
    sleep(0.02)
    return poll().position[axis] != a


def check(what, axis, end):
    need(lambda s: s.position[axis] > 1, f"jog by {what}")
    end()
    stopped = clock.wait_until(lambda: not moves(axis), 1, 0.02)
    at = poll().position[axis]
    sleep(2)
    print(f"{what}: stops {stopped} stays {poll().position[axis] == at} {messages()}")


def home():
    c.jog(JOG_STOP, 0, 0)
    c.jog(JOG_STOP, 0, 1)
    mdi("G53 G0 X0 Y0")
    mode(MODE_MANUAL)
    c.teleop_enable(1)
    c.wait_complete()
    messages()


def kill(child):
    child.kill()
    child.wait()


on()
home()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 0, 0, 5)")
check("a killed client", 0, lambda: kill(child))
home()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 0, 0, 5); clock.sleep(0.5); raise SystemExit")
check("one that ends by itself", 0, lambda: clock.wait_until(lambda: child.poll() is not None, 5))
home()
c.teleop_enable(0)
c.wait_complete()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 1, 1, 5)")
check("a joint", 1, lambda: kill(child))
home()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 0, 0, 5)")
need(lambda s: s.position[0] > 1, "jog")
c.jog(JOG_CONTINUOUS, 0, 0, 6)
kill(child)
sleep(0.5)
print("another program has taken over:", "goes on" if moves(0) else "stopped", messages())
home()
child = client("c.jog(linuxcnc.JOG_INCREMENT, 0, 0, 5, 10)")
need(lambda s: s.position[0] > 1, "jog")
kill(child)
sleep(5)
print("an increment:", round(poll().position[0], 3), messages())
home()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 0, 0, 5); clock.sleep(0.5); c.jog(linuxcnc.JOG_STOP, 0, 0)")
need(lambda s: s.position[0] > 1 and not s.joint[0]["velocity"], "jog")
kill(child)
sleep(0.1)
print("one that was over:", messages())
home()


# A program that is stopped, one whose heartbeats end, one whose heartbeats are slow but come.
home()
child = client("c.jog(linuxcnc.JOG_CONTINUOUS, 0, 0, 5)")
check("a stopped client", 0, lambda: child.send_signal(signal.SIGSTOP))
child.send_signal(signal.SIGCONT)
sleep(1)
print("it goes on:", "moves" if moves(0) else "rests", messages())
kill(child)
BEATS = """
c.jog(linuxcnc.JOG_CONTINUOUS, {joint}, {axis}, 5)
for _ in range({n}):
    c.jog_held({joint}, {axis})
    clock.sleep({pause})
"""
for joint in 0, 1:
    home()
    c.teleop_enable(1 - joint)
    c.wait_complete()
    child = client(BEATS.format(joint=joint, axis=1, n=20, pause=0.2))
    need(lambda s: abs(s.joint[1]["velocity"] - 5) < 1e-6, "speed")
    speeds = set()
    for _ in range(2500):
        sleep(0.001)
        speeds.add(round(hal.get_value("joint.1.vel-cmd"), 6))
    print("slow heartbeats:", speeds)
    stopped = clock.wait_until(lambda: not moves(1), 10, 0.02)
    print("they end: stops", stopped, messages())
    kill(child)
home()
child = client("for _ in range(50):\n    c.jog_held(0, 0)\n    clock.sleep(0.01)")
sleep(0.3)
print("heartbeats of no jog:", "moves" if moves(0) else "rests", messages())
kill(child)
c.jog(JOG_CONTINUOUS, 0, 0, 5)
c.jog_held(0, 0)
c.jog_held(0, 0)
print("beside commands:", c.wait_complete() != RCS_ERROR, c.serial == poll().echo_serial_number)
sleep(0.5)
print("after that:", "moves" if moves(0) else "rests", messages())
home()
Path("far.nml").write_text(re.sub(r"^(P +xemc +\S+ +)LOCAL", r"\1REMOTE",
                                  Path(os.environ["NMLFILE"]).read_text(), flags=re.M))
child = client("linuxcnc.nmlfile = 'far.nml'; c = linuxcnc.command()" + BEATS.format(joint=0, axis=1, n=10, pause=0.1))
need(lambda s: s.position[1] > 1, "jog")
print("a remote client that is silent: stops", clock.wait_until(lambda: not moves(1), 10, 0.02), messages(),
      "connected", child.poll() is None)
kill(child)
home()
remote = socket.create_connection(("127.0.0.1", port()))
message = struct.pack(">iqiidi", 124, 48, 0, 0, 5.0, 0)
remote.sendall(struct.pack(">5I", 1, 2, 1, 4, len(message)) + message)
remote.recv(12)
check("a remote client that is cut off", 0, remote.close)
home()
first, second = (socket.create_connection(("127.0.0.1", port())) for _ in range(2))
for remote in first, second:
    remote.sendall(struct.pack(">5I", 1, 2, 1, 4, len(message)) + message)
    remote.recv(12)
first.close()
sleep(0.5)
print("another remote client has taken over:", "goes on" if moves(0) else "stopped", messages())
second.close()
home()
remote = socket.create_connection(("127.0.0.1", port()))
remote.sendall(struct.pack(">5I", 1, 2, 1, 4, len(message)) + message)
remote.recv(12)
need(lambda s: s.joint[0]["velocity"] > 4, "jog")
questions = [line.split()[5] for line in Path("/proc/net/tcp").read_text().splitlines()[1:]
             if line.split()[1].endswith(f":{port():04X}") and line.split()[3] == "01"]
print("asked every second whether it is there:", all(q.startswith("02") and int(q[3:], 16) <= 100 for q in questions))
c.abort()
need(lambda s: s.joint[0]["velocity"] == 0, "rest")
program("G21 G90 G0 X0\nG1 F600 X5\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(0.1)
remote.close()
print("one that goes while a program runs, after a jog that was aborted:", c.wait_complete(20), messages())
