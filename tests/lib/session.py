# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs of the machine session that this one runs in."""
import os
import signal
from pathlib import Path


def _session_of(folder):
    return [e for e in (folder / "environ").read_bytes().split(b"\0") if e.startswith(b"LINUXCNC_SESSION=")]


def processes(name):
    """Process ids of this session's programs of that name."""
    own, found = _session_of(Path("/proc/self")), []
    for p in Path("/proc").iterdir():
        try:
            if (p / "comm").read_text() == name + "\n" and _session_of(p) == own:
                found.append(int(p.name))
        except OSError:
            pass
    return found


def kill(name):
    for pid in processes(name):
        os.kill(pid, signal.SIGKILL)


def kill_all():
    """All of this session at once, as by a power cut: the launcher, the realtime part, this program."""
    own, victims, process = _session_of(Path("/proc/self")), [], os.getppid()
    while process > 1:
        folder = Path(f"/proc/{process}")
        if (folder / "comm").read_text() == "linuxcnc\n":
            victims.append(process)
        process = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
    for p in Path("/proc").glob("[0-9]*"):
        try:
            if _session_of(p) == own and int(p.name) not in (*victims, os.getpid()):
                victims.append(int(p.name))
        except OSError:
            pass
    for signal_number in (signal.SIGSTOP, signal.SIGKILL):      # nobody sees another one end
        for pid in victims:
            os.kill(pid, signal_number)
    os.kill(os.getpid(), signal.SIGKILL)
