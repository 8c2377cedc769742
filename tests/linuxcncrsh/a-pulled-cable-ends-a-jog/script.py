# SPDX-License-Identifier: GPL-2.0-or-later
# A client on another computer whose cable is pulled can not stop its jog any more, and nobody says so: the jog ends.
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lib"))
from mill import *
from rsh import *

HERE, THERE = "192.0.2.1", "192.0.2.2"
FAR = """
import hashlib, hmac, socket, subprocess, sys
sys.stdin.readline()
for words in "link set lo up", "addr add {there}/24 dev there", "link set there up":
    subprocess.run(["ip", *words.split()], check=True)
link = socket.create_connection(("{here}", {port}), 10)
lines = link.makefile("rw", newline="")
def say(line):
    lines.write(line + "\\r\\n")
    lines.flush()
    return lines.readline().strip()
def answer(password):
    return hmac.new(password, say("GET CHALLENGE").split()[1].encode(), hashlib.sha256).hexdigest()
say("HELLO " + answer(b"MINE") + " panel 1.1")
lines.write("SET ECHO OFF\\r\\n")
lines.flush()
lines.readline()
for line in "SET ENABLE " + answer(b"MINETOO"), "SET WAIT_MODE RECEIVED", "SET JOG 0 0.6":
    lines.write(line + "\\r\\n")
    lines.flush()
print(say("GET ENABLE"), flush=True)
sys.stdin.readline()
"""


def ip(words):
    subprocess.run(["ip", *words.split()], check=True)


ip("link set lo up")
ip("link add here type veth peer name there")
ip(f"addr add {HERE}/24 dev here")
ip("link set here up")
on(home=False)
server = Server("--bind", HERE, "-w", "MINE", "-e", "MINETOO", wait=False)
sleep(0.5)
far = subprocess.Popen(["unshare", "-n", "/usr/bin/python3", "-c",
                        FAR.format(here=HERE, there=THERE, port=server.port)],
                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
while Path(f"/proc/{far.pid}/ns/net").readlink() == Path("/proc/self/ns/net").readlink():
    time.sleep(0.01)
ip(f"link set there netns {far.pid}")
clock.suspend()
far.stdin.write("go\n")
far.stdin.flush()
print(far.stdout.readline().strip())
clock.resume()
need(lambda s: s.joint[0]["velocity"] > 0, "jog")
clock.suspend()
time.sleep(2)  # of the network, which knows no other time
clock.resume()
print("quiet, but there: jogs", poll().joint[0]["velocity"] > 0)
ip("link set here down")
clock.suspend()
for _ in range(100):
    if poll().joint[0]["velocity"] == 0:
        break
    time.sleep(0.1)
clock.resume()
print("pulled: jogs", poll().joint[0]["velocity"] > 0, "before its end:", s.position[0] < 20, messages())
far.stdin.close()
far.wait()
print(server.stop())
