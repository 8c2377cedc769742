# SPDX-License-Identifier: GPL-2.0-or-later
"""HAL components, pins, signals and streams for Python programs.

    import hal
    c = hal.component("passthrough")
    c.newpin("in", hal.HAL_FLOAT, hal.HAL_IN)
    c.newpin("out", hal.HAL_FLOAT, hal.HAL_OUT)
    c.ready()
    while True:
        c["out"] = c["in"]
        time.sleep(0.1)

Importing this maps HAL's shared memory (ImportError when that fails) and lets SIGTERM
raise KeyboardInterrupt, so that `halcmd unload` ends a component in order.
"""
import atexit as _atexit
import enum as _enum
import os as _os
import signal as _signal
import warnings as _warnings

import _hal
from _hal import *  # noqa: F401,F403
from _hal import error, item as _item  # noqa: F401


class Type(_enum.IntEnum):
    """Types of pins, parameters and signals."""
    BOOL = HAL_BOOL = HAL_BIT = 1
    REAL = HAL_REAL = HAL_FLOAT = 2
    S32 = HAL_S32 = 3
    U32 = HAL_U32 = 4
    PORT = HAL_PORT = 5
    SINT = HAL_SINT = HAL_S64 = 6
    UINT = HAL_UINT = HAL_U64 = 7


class Dir(_enum.IntEnum):
    """Directions of pins (IN, OUT, IO) and parameters (RO, RW)."""
    IN = HAL_IN = 16
    OUT = HAL_OUT = 32
    IO = HAL_IO = 48
    RO = HAL_RO = 64
    RW = HAL_RW = 192


class CompType(_enum.IntEnum):
    """Kinds of components."""
    UNKNOWN = -1
    USER = 0
    REALTIME = 1
    OTHER = 2


class RTType(_enum.IntEnum):
    """What the realtime host found at its start."""
    REALTIME_TYPE_UNINITIALIZED = UNINITIALIZED = -1
    REALTIME_TYPE_NONE = NONE = 0
    REALTIME_TYPE_UNKNOWN = UNKNOWN = 1
    REALTIME_TYPE_PREEMPT_DYNAMIC = PREEMPT_DYNAMIC = 2
    REALTIME_TYPE_PREEMPT_RT = PREEMPT_RT = 3
    REALTIME_TYPE_RTAI = RTAI = 4
    REALTIME_TYPE_LXRT = LXRT = 5
    REALTIME_TYPE_XENOMAI = XENOMAI = 6
    REALTIME_TYPE_XENOMAI_EVL = XENOMAI_EVL = 7


def get_realtime_type():
    """RTType of the realtime host; UNINITIALIZED while none runs."""
    return RTType(_hal._get_realtime_type())


class _ItemWrap:
    """What pins and parameters have in common. `name` is without the prefix."""

    def __init__(self, item):
        if not isinstance(item, _item):
            raise TypeError("Constructor argument must be _hal.item: %s" % type(item))
        self._item = item

    def get(self):
        """The value; of a linked pin that of the signal."""
        return self._item.get()

    def set(self, value):
        """Sets the value, whatever the direction."""
        self._item.set(value)

    def get_type(self):
        return self._item.get_type()

    def get_name(self):
        return self._item.get_name()

    def get_dir(self):
        return self._item.get_dir()

    def is_pin(self):
        return self._item.is_pin()

    name = property(get_name)
    type = property(get_type)
    dir = property(get_dir)
    value = property(get, set)


class Pin(_ItemWrap):
    """A pin of a component of this program. Ports also have write, read, peek,
    peek_commit, clear, size, readable and writable."""

    _PORT = ("write", "read", "peek", "peek_commit", "clear", "size", "readable", "writable")

    def __init__(self, item):
        _ItemWrap.__init__(self, item)
        if not item.is_pin():
            raise TypeError("Must be constructed from pin object")
        if item.get_type() == Type.PORT:
            for name in self._PORT:
                setattr(self, name, getattr(item, name))


class Param(_ItemWrap):
    """A parameter of a component of this program."""

    def __init__(self, item):
        _ItemWrap.__init__(self, item)
        if item.is_pin():
            raise TypeError("Must be constructed from param object")


class component(_hal.component):
    """component(name[, prefix]): a user component of this process; hal.error when the
    name is taken. Values by suffix: c["in"] or c.in_."""

    def newpin(self, *args, **kwargs):
        """newpin(suffix, type, dir): a new pin `prefix.suffix`; returns hal.Pin."""
        return Pin(_hal.component.newpin(self, *args, **kwargs))

    def newparam(self, *args, **kwargs):
        """newparam(suffix, type, dir): a new parameter; returns hal.Param."""
        return Param(_hal.component.newparam(self, *args, **kwargs))

    def getpin(self, *args, **kwargs):
        """The pin of that suffix as hal.Pin."""
        return Pin(_hal.component.getpin(self, *args, **kwargs))

    def getparam(self, *args, **kwargs):
        """The parameter of that suffix as hal.Param."""
        return Param(_hal.component.getparam(self, *args, **kwargs))


def __getattr__(name):
    if name in ("is_rt", "is_sim"):
        _warnings.warn("hal.%s is deprecated: ask lcnc_realtime.verify()" % name, FutureWarning, stacklevel=2)
        import lcnc_realtime
        realtime = bool(lcnc_realtime.verify())
        return realtime if name == "is_rt" else not realtime
    raise AttributeError("module 'hal' has no attribute '%s'" % name)


try:
    _signal.signal(_signal.SIGTERM, _signal.default_int_handler)
except ValueError:
    pass  # imported outside of the main thread, where signals can not be set

_pid = _os.getpid()


def _leave():
    if _os.getpid() == _pid:
        _hal._exit_all()
        _hal._lib_exit()


_atexit.register(_leave)

from hal import query  # noqa: E402,F401
