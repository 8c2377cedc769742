# SPDX-License-Identifier: GPL-2.0-or-later
"""What the processes of a running session weigh: for tests that nothing grows."""
import os
from pathlib import Path

SESSION = b"LINUXCNC_SESSION="


def own_session():
    return next(e for e in Path("/proc/self/environ").read_bytes().split(b"\0") if e.startswith(SESSION))


def weigh(folder):
    """(kB that it has written, open files) of one process of /proc. Pages of files are not its own: they become private
    when others that map them end."""
    rollup = (folder / "smaps_rollup").read_text()
    return (sum(int(line.split()[1]) for line in rollup.splitlines() if line.startswith(("Private_Dirty:", "Swap:"))),
            len(os.listdir(folder / "fd")))


def parent(pid):
    return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])


def ancestors():
    found = [os.getpid()]
    while found[-1] > 1:
        found.append(parent(found[-1]))
    return found


def sizes(names=None):
    """Name and process id -> (kB of private memory, open files): processes of this session, and the X server that
    with-display made for it."""
    session, older, found = own_session(), ancestors(), {}
    for p in Path("/proc").glob("[0-9]*"):
        try:
            name = (p / "comm").read_text().strip()
            if names and name not in names:
                continue
            if session in (p / "environ").read_bytes().split(b"\0") or (name == "Xvfb" and parent(p.name) in older):
                found[name + p.name] = weigh(p)
        except OSError:
            pass
    return found
