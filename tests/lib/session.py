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
