# SPDX-License-Identifier: GPL-2.0-or-later
import hashlib
import hmac

import linuxcnc
from wire import *

Path("logins").write_text("# who may\nanna  correct-horse\nben tractor # the other\n")
os.chmod("logins", 0o600)


def login(client, name, password, buffer=COMMAND, challenge=None, answer=None):
    """Challenge, answer and what the server says."""
    keys = challenge or client.request(KEYS, buffer, extra=b"emcCommand".ljust(16, b"\0"), reply=20)[4:]
    answer = answer or hmac.new(password.encode(), keys + name.encode(), hashlib.sha256).digest()[:16]
    got = client.request(LOGIN, buffer, extra=name.encode().ljust(16, b"\0") + answer, reply=8)
    return keys, answer, got and struct.unpack(">II", got)[1]


server = Server("passwd=logins", process="REMOTE localhost")
print("without a login:", Client().write(COMMAND, NULL), Client().read(STATUS))
c = Client()
keys, answer, good = login(c, "anna", "correct-horse")
print("the right one:", good, c.write(COMMAND, NULL)[1])
print("good for its buffer only:", c.read(STATUS))
c = Client()
print("another name:", login(c, "ben", "tractor")[2], c.write(COMMAND, NULL)[1])
for what, name, password in (("a wrong password", "anna", "wrong"), ("somebody else's", "anna", "tractor"),
                             ("nobody", "carl", "tractor"), ("empty", "", "")):
    c = Client()
    print(what, login(c, name, password)[2], c.write(COMMAND, NULL))
c = Client()
c.request(KEYS, COMMAND, extra=b"x" * 16, reply=20)
print("an answer heard before:", login(c, "anna", "", challenge=keys, answer=answer)[2])
c = Client()
print("without a challenge:", login(c, "anna", "correct-horse", challenge=b"\0" * 16)[2])
c = Client()
same, _, _ = login(c, "anna", "wrong")
print("a second try with the same challenge:", login(c, "anna", "correct-horse", challenge=same)[2],
      "challenges differ:", same != keys)
print("log:", server.log().count("refused") >= 6, "without a login" in server.log(), "tractor" in server.log())

linuxcnc.nmlfile = str(Path("test.nml").resolve())
command = linuxcnc.command()
linuxcnc.stat().poll()
before = Client()
login(before, "anna", "correct-horse")
print("the module's remote client:", linuxcnc.error_channel().poll(), before.number(LENGTH, COMMAND)[1])
Path("logins").write_text("anna wrong-now\n")
Path("other").write_text("anna correct-horse\n")
os.chmod("other", 0o600)
Path("other.nml").write_text(Path("test.nml").read_text().replace("passwd=logins", "passwd=other"))
linuxcnc.nmlfile = str(Path("other.nml").resolve())
try:
    linuxcnc.stat().poll()
    print("let in")
except linuxcnc.error as e:
    print("after a change of the file:", e)
server.stop()

print("== addresses")
Path("logins").write_text("anna correct-horse\n")
for what, extra, bind in (("all, without a password", "", "*"), ("no address", "passwd=logins", "nowhere"),
                          ("all, with a password", "passwd=logins", "*")):
    server = Server(extra, f"NML_BIND = {bind}")
    text = "other computers need a password" if not extra else "is no address" if bind == "nowhere" else ""
    open_ = False
    if not text:
        Client()
        open_ = True
    else:
        server.wait_log(text)
        try:
            socket.create_connection(("127.0.0.1", port()), 1)
            open_ = True
        except OSError:
            pass
    print(what, open_, server.log().count(text) if text else "")
    server.stop()
os.chmod("logins", 0o644)
server = Server("passwd=logins")
print("a file that others may read:", server.wait_log("chmod 600"))
server.stop()
for f in ("logins", "other", "other.nml"):
    Path(f).unlink()
