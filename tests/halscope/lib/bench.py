# SPDX-License-Identifier: GPL-2.0-or-later
"""scope_rt without a screen, in virtual time: sources, records."""
import hal
from kerf import clock
from kerf.halscope import acquire, settings as st

clock.join("test")
comp = hal.component("halscope")
comp.ready()


def source(settings, number, kind, name, **more):
    """A channel with that source."""
    c = settings.channel(number)
    c.kind, c.name, c.type, c.enabled = kind, name, acquire.source_type(kind, name), True
    for key, value in more.items():
        setattr(c, key, value)
    return c


def record(acq, settings, timeout=30.0, meanwhile=None):
    """A new record; None when there is none in time. meanwhile() is called while it is taken."""
    acq.stop()
    acq.start(settings)
    found = []

    def done():
        if meanwhile:
            meanwhile()
        got = acq.poll()
        if got is not None:
            found.append(got)
        return got is not None
    return found[0] if clock.wait_until(done, timeout, 0.002) else None


__all__ = ["acquire", "clock", "comp", "hal", "record", "source", "st"]
