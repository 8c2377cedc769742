# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared names of one of several controllers on a machine (KERF_INSTANCE).

The same rules as src/rtapi/kerf_instance.c, which a test compares with these.
"""

import os
import re

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


def port(documented):
    """TCP port of this instance for a documented port, as instance_port of libnml."""
    return 20000 + key(documented) % 12000 if name() and documented > 0 else documented


def suffixed(path):
    """A machine-wide path (lock, log) of this instance: the default instance's has no suffix."""
    return f"{path}.{name()}" if name() else path
