# SPDX-License-Identifier: GPL-2.0-or-later
"""Processes that belong to another one: they end with it, and take no more memory than they may.

As a program, `process.py PID COMMAND...`: runs a command of somebody else for the process PID. When that one ends, or
this one gets SIGTERM, the command and all it started are ended. Its exit status is the command's (128 + n for signal
n).
"""

import ctypes
import os
import resource
import signal
import subprocess
import sys
import time

PR_SET_PDEATHSIG = 1
M_MMAP_THRESHOLD = -3    # of glibc's mallopt()
LARGE_BYTES = 1 << 18
GRACE_S = 1.0            # for a command to end itself


def end_with_parent(how=signal.SIGTERM, parent=None):
    """This process gets the signal when the thread that started it ends. parent: its number; when that one is gone
    already, SystemExit."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, how, 0, 0, 0)
    if parent is not None and os.getppid() != parent:
        raise SystemExit(1)


def give_back_memory():
    """From now on a large block goes back to the system when it is freed (glibc keeps those below the largest that was
    ever freed, in one heap for each thread). With another C library nothing changes."""
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt:
        mallopt(M_MMAP_THRESHOLD, LARGE_BYTES)


def limit_memory(megabytes):
    """From now on this process gets no more than so much memory of its own (MemoryError, std::bad_alloc)."""
    with open("/proc/self/statm") as f:
        used = int(f.read().split()[5]) * resource.getpagesize()
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    wanted = used + int(megabytes * 1e6)
    resource.setrlimit(resource.RLIMIT_DATA, (wanted if hard == resource.RLIM_INFINITY else min(wanted, hard), hard))


def main(parent, *command):
    os.setsid()
    child = None

    def end_all(*_):
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        os.killpg(0, signal.SIGTERM)
        end = time.monotonic() + GRACE_S
        while child and os.waitpid(child.pid, os.WNOHANG)[0] == 0 and time.monotonic() < end:
            time.sleep(0.02)
        os.killpg(0, signal.SIGKILL)
    signal.signal(signal.SIGTERM, end_all)
    end_with_parent(signal.SIGTERM, int(parent))
    child = subprocess.Popen(command)
    status = child.wait()
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
