# SPDX-License-Identifier: GPL-2.0-or-later
import os
import pty
import select
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

OWN = f"KERF_INSTANCE={os.environ['KERF_INSTANCE']}".encode()
scratch = Path(tempfile.mkdtemp())
shutil.copytree(Path(os.environ["EMC2_HOME"]) / "configs/sim/mill", scratch / "machine")
ini = scratch / "machine/mill.ini"
ini.write_text(ini.read_text().replace("[TRAJ]", "[TRAJ]\nNO_FORCE_HOMING = 1").replace("HALUI = halui", ""))
(scratch / "screen.py").write_text(f"""
import linuxcnc, signal
c, s = linuxcnc.command(), linuxcnc.stat()
for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    c.state(state)
    c.wait_complete()
c.mode(linuxcnc.MODE_AUTO)
open("p.ngc", "w").write("M3 S1000\\nM8\\nF60\\nG1 X300\\nM2\\n")
c.program_open("p.ngc")
c.auto(linuxcnc.AUTO_RUN, 0)
while not s.position[0] > 0.01:
    s.poll()
open("{scratch}/ready", "w")
while True:
    signal.pause()
""")
(scratch / "display").write_text(f"#!/bin/sh\nexec /usr/bin/python3 {scratch}/screen.py\n")
(scratch / "display").chmod(0o755)


def mine():
    """Names of the session's processes."""
    found = []
    for p in Path("/proc").iterdir():
        try:
            if (p.name.isdigit() and OWN in (p / "environ").read_bytes().split(b"\0")
                    and b"\0LINUXCNC_SESSION=" in (p / "environ").read_bytes()):
                found.append((p / "comm").read_text().strip())
        except OSError:
            pass
    return sorted(found)


def look(terminal, until, limit):
    """Reads what comes; whether until() became true within limit seconds."""
    end = time.monotonic() + limit
    while not until():
        if time.monotonic() > end:
            return False
        if terminal is None:
            time.sleep(0.02)
        elif select.select([terminal], [], [], 0.02)[0]:
            try:
                os.read(terminal, 4096)
            except OSError:
                terminal = None
    return True


for name, words in (("all are hung up", []), ("closed", []), ("closed with nohup", ["nohup"])):
    (scratch / "ready").unlink(missing_ok=True)
    pid, terminal = pty.fork()
    if pid == 0:
        words += ["linuxcnc", "-r", "-D", str(scratch / "display"), str(ini)]
        os.chdir(scratch)
        os.execvp(words[0], words)
    if not look(terminal, (scratch / "ready").exists, 60):
        print("did not start", mine())
    if name.startswith("closed"):
        os.close(terminal)
        terminal = None
    else:
        os.killpg(pid, signal.SIGHUP)
    if words[0:1] == ["nohup"]:
        time.sleep(0.5)
        print(name + ":", mine())
        os.kill(pid, signal.SIGTERM)
    gone = look(terminal, lambda: not mine() and os.waitpid(pid, os.WNOHANG)[0] == pid, 20)
    print(name + ":", "ends" if gone else mine(),
          "lock left" if Path(f"/tmp/linuxcnc.lock.{os.environ['KERF_INSTANCE']}").exists() else "")
    subprocess.run(["realtime", "status"])
shutil.rmtree(scratch)
