# SPDX-License-Identifier: GPL-2.0-or-later
"""The processes of a machine that the launcher started: found by the variable that marks them, ended, waited for."""

import os
import signal
import time
from pwd import getpwuid

from . import instance

CHILD_END_S = 1.9       # for a process to end after TERM, and again after KILL
SESSION = "LINUXCNC_SESSION"


def ended(returncode):
    """How a program ended, in words."""
    return (f"ended with status {returncode}" if returncode > 0
            else f"was ended by signal {-returncode} ({signal.Signals(-returncode).name})")


def status_of(returncode):
    """Shell-like exit status of a subprocess."""
    return 128 - returncode if returncode < 0 else returncode


def session_processes(session, part=""):
    """Ids of all other processes that this session started, at any depth; the likely ones come first.
    part: only the display and what it started."""
    wanted = f"{SESSION}{part}={session}".encode()
    me, parent = os.getpid(), os.getppid()
    hosts = set() if part else instance.users_of_memory()
    for pid in sorted((int(e) for e in os.listdir("/proc") if e.isdigit()), key=lambda p: (p < me, p)):
        if pid in (me, parent):
            continue
        try:
            with open(f"/proc/{pid}/environ", "rb") as f:
                if wanted not in f.read().split(b"\0"):
                    continue
        except PermissionError:         # of a setuid program
            if pid not in hosts or not comm_of(pid).startswith("rtapi_app"):
                continue
        except OSError:
            continue
        if lives(pid):
            yield pid


def user_name(uid):
    try:
        return getpwuid(uid).pw_name
    except KeyError:
        return f"user {uid}"


def comm_of(pid):
    try:
        with open(f"/proc/{pid}/comm") as f:
            return f.read().strip()
    except OSError:
        return ""


def lives(pid):
    """False also for a process that has ended and that nobody has waited for."""
    return state_of(pid) not in "ZX"


def end(pids, still_there=lives):
    """TERM, then KILL, each with a wait. Returns those that did not go."""
    for sig in (signal.SIGTERM, signal.SIGKILL):
        for pid in pids:
            try:
                os.kill(pid, sig)
            except OSError:
                pass
        until = time.monotonic() + CHILD_END_S
        while pids and time.monotonic() < until:
            reap()
            pids = [p for p in pids if still_there(p)]
            if pids:
                time.sleep(0.005)
        if not pids:
            break
    return pids


def reap():
    """Collects children that have ended."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass


def state_of(pid):
    try:
        with open(f"/proc/{pid}/stat") as f:
            return f.read().rsplit(")", 1)[1].split()[0]
    except OSError:
        return "X"
