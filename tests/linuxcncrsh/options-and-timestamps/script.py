# SPDX-License-Identifier: GPL-2.0-or-later
import hashlib
import hmac
import os
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "lib"))
from mill import *
from rsh import *

for options in (["-p", "0"], ["-p", "65535"], ["-p", "x"], ["-e", "OFF"], ["-e", "a b"], ["-z"]):
    done = subprocess.run(["linuxcncrsh", *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    print(options, done.returncode, bool(done.stderr), done.stdout)
for options in (["-p", "5007x"], ["-s", "x"], ["-s", "-1"]):
    print(options, subprocess.run(["linuxcncrsh", *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True).stdout.strip())
print("-h", subprocess.run(["linuxcncrsh", "-h"], stdout=subprocess.DEVNULL).returncode)

server = Server("-n", "shop", "-w", "hi", "-e", "open", "-s", "2", "-4", wait=False)
while True:
    try:
        a = Client(server, enable=False)
        break
    except ConnectionRefusedError:
        sleep(0.01)
show(a, "HELLO EMC x 1", "HELLO hi x 1", "SET ENABLE EMCTOO", "SET ENABLE open", "GET ENABLE")
b = Client(server, enable=False)
third = socket.create_connection(("127.0.0.1", server.port))
clock.suspend()
print("third:", third.recv(100))
clock.resume()
b.close()
sleep(0.1)
c3 = Client(server, enable=False)
print("after one left:", c3.say("GET ECHO"))
try:
    socket.create_connection(("::1", server.port))
    print("IPv6 in spite of -4")
except OSError:
    print("no IPv6")

local, epoch = r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{6}: ", r"\d+\.\d{6}: "
for line, shape in (("SET TIMESTAMP ON", local), ("SET TIMESTAMP ON OFF", local), ("SET TIMESTAMP ON ON", epoch)):
    a.say(line)
    replies = a.say("GET TIMESTAMP", "SET TIMESTAMP x")
    print(line, [re.sub(f"^{shape}", "<t> ", r) for r in replies])
    a.say("SET TIMESTAMP OFF")
print(re.fullmatch(r"TIME \d+\.\d{6}", a.say("GET TIME")[0]) is not None)

def own_address():
    """An address of this computer that others see, or a loopback one where its name has none."""
    try:
        return socket.gethostbyname(socket.gethostname())
    except OSError:
        return "127.0.0.1"


# The two address families of a default server, and a second program on the same port.
six = Server()
with socket.socket(socket.AF_INET6) as s:
    try:
        s.connect(("::1", six.port))
        print("IPv6 works")
    except OSError as e:
        print("IPv6 works" if not Path("/proc/net/if_inet6").exists() else e)
print("elsewhere:", end=" ")
try:
    socket.create_connection((own_address(), six.port), 1)
    print("let in" if not own_address().startswith("127.") else "not")
except OSError:
    print("not")
again = clock.run(["linuxcncrsh", "-q", "-p", str(six.port), "--", "-ini", "mill.ini"],
                  stderr=subprocess.PIPE, text=True)
print("port taken:", again.returncode, str(six.port) in again.stderr)
print(clock.run(["linuxcncrsh", "--", "-ini", "none.ini"], stderr=subprocess.DEVNULL).returncode,
      six.stop(), server.stop())

# A file is that of the folder in which linuxcncrsh works, also when task works in another one.
Path("apart").mkdir()
Path("apart/part.ngc").write_text("M2\n")
Path("part.ngc").write_text("G0 X1\nM2\n")
here = os.getcwd()
os.chdir("apart")
apart = Server(ini="../mill.ini")
os.chdir(here)
on()
p = Client(apart)
p.say("SET MODE AUTO")
print("its own folder:", p.say("SET OPEN part.ngc", "GET OPEN"), p.say("GET PROGRAM")[0].endswith("/apart/part.ngc"),
      apart.stop())
c.state(STATE_ESTOP)

# Other addresses: only with passwords of one's own, which do not travel.
done = clock.run(["linuxcncrsh", "-q", "-p", str(free_port()), "-b", "*", "--", "-ini", "mill.ini"],
                 stderr=subprocess.PIPE, text=True)
print("default passwords on all addresses:", done.returncode, "--connectpw" in done.stderr)
wide = Server("-b", "*", "-w", "mine", "-e", "minetoo", "-4")
a = Client(wide, enable=False)


def answer(password):
    return hmac.new(password.encode(), a.say("GET CHALLENGE")[0].split()[1].encode(), hashlib.sha256).hexdigest()


first = answer("mine")
print("answer:", a.say(f"HELLO {first} x 1"), "again:", a.say(f"HELLO {first} x 1"), "wrong:",
      a.say(f"HELLO {answer('yours')} x 1"))
print("enable:", a.say(f"HELLO {answer('mine')} x 1"), a.say(f"SET ENABLE {answer('minetoo')}", "GET ENABLE"))
print("clear text from this computer:", a.say("HELLO mine x 1", "SET ENABLE minetoo", "GET ENABLE"))
here = own_address()
if not here.startswith("127."):
    far = socket.create_connection((here, wide.port))
    far.sendall(b"HELLO mine x 1\r\n")
    clock.suspend()
    got = far.recv(100)
    clock.resume()
    if got != b"HELLO NAK\r\n":
        print("clear text from elsewhere:", got)
print(wide.stop())
