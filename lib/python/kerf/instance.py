# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared names of one of several controllers on a machine (KERF_INSTANCE).

The same rules as src/rtapi/kerf_instance.c, which a test compares with these.
"""

import ctypes
import os
import re
from dataclasses import dataclass

# documented keys of SysV memory
SEGMENTS = {0x64: "motion", 0x48414C32: "HAL", 0x48484C34: "UUID", 0x90280A48: "RTAPI",
            0x130CF406: "halscope", 0x434C522B: "classicladder"}
MASK = (1 << 64) - 1
LONGEST = 48


def name():
    """This process's instance; empty for the default one."""
    return os.environ.get("KERF_INSTANCE", "")


def key(documented, instance=None):
    """SysV key of an instance for a documented key, as an unsigned number."""
    instance = name() if instance is None else instance
    if not instance or documented == 0:
        return documented & 0xFFFFFFFF
    if len(instance) > LONGEST:
        raise ValueError(f"instance name longer than {LONGEST} characters: {instance}")
    value = 0xCBF29CE484222325
    for byte in (documented & 0xFFFFFFFF).to_bytes(4, "little") + re.sub(r"[^A-Za-z0-9_.-]", "_", instance).encode():
        value = ((value ^ byte) * 0x100000001B3) & MASK
    value ^= value >> 32
    return value & 0x7FFFFFFF or 1


@dataclass(frozen=True)
class Segment:
    """A present SysV segment."""
    shmid: int
    attached: int      # number of processes
    users: tuple       # ids of the processes that made it and that attached it last


def segments():
    """Present SysV segments by their keys."""
    found = {}
    with open("/proc/sysvipc/shm") as f:
        next(f)
        for line in f:
            word = [int(w) for w in line.split()]
            found[word[0] & 0xFFFFFFFF] = Segment(word[1], word[6], (word[4], word[5]))
    return found


def remove_segment(segment):
    """False: not allowed, or gone."""
    return ctypes.CDLL(None).shmctl(segment.shmid, 0, None) == 0      # 0 = IPC_RMID


def users_of_memory(instance=None):
    """Ids of processes that use an instance's memory; its host is one of them, also where it is a setuid program,
    whose environment only root can read."""
    present = segments()
    return {pid for k in SEGMENTS if (mapped := key(k, instance)) in present for pid in present[mapped].users}


def port(documented):
    """TCP port of this instance for a documented port, as instance_port of libnml."""
    return 20000 + key(documented) % 12000 if name() and documented > 0 else documented


def suffixed(path):
    """A machine-wide path (lock, log) of this instance: the default instance's has no suffix."""
    return f"{path}.{name()}" if name() else path
