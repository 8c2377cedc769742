# SPDX-License-Identifier: GPL-2.0-or-later
"""What is in HAL: pins, parameters, signals, components, functions, threads.

Single look-ups return a dict or None, the plural forms a dict of dicts by name, in the
order of `halcmd show`. Every dict says its kind in "haltype". RuntimeError on failure.
"""
import _hal
from hal import CompType, Dir, Type


def _pp(d):
    if d is not None:
        d["type"] = Type(d["type"])
        d["dir"] = Dir(d["dir"])
    return d


def _signal(d):
    if d is not None:
        d["type"] = Type(d["type"])
    return d


def _comp(d):
    if d is not None:
        d["type"] = CompType(d["type"])
    return d


def _named(dicts, convert=lambda d: d):
    return {d["name"]: convert(d) for d in dicts}


def pin(name):
    """name, type, dir, value, alias (original name or None), signal, comp, comp_id."""
    return _pp(_hal._query_pin(name))


def param(name):
    """As pin, without signal."""
    return _pp(_hal._query_param(name))


def signal(name):
    """name, type, value, writers, readers, bidirs, driver (its OUT pin or None)."""
    return _signal(_hal._query_signal(name))


def comp(name_or_id):
    """name, type, id, pid, ready, insmod (load arguments or None)."""
    return _comp(_hal._query_comp(name_or_id))


def funct(name):
    """name, comp, comp_id, users, reentrant."""
    return _hal._query_funct(name)


def thread(name):
    """name, comp, comp_id, priority, period (ns), functions: a list of dicts with
    name, index, is_init."""
    return _hal._query_thread(name)


def signalpins(name):
    """The pins linked to a signal by name, or None when there is no such signal."""
    pins = _hal._query_signalpins(name)
    return None if pins is None else _named(pins, _pp)


def pins():
    return _named(_hal._query_pins(), _pp)


def params():
    return _named(_hal._query_params(), _pp)


def signals():
    return _named(_hal._query_signals(), _signal)


def comps():
    return _named(_hal._query_comps(), _comp)


def functs():
    return _named(_hal._query_functs())


def threads():
    return _named(_hal._query_threads())
