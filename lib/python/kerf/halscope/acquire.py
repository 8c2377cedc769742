# SPDX-License-Identifier: GPL-2.0-or-later
"""Records from scope_rt: loads it, runs it in a thread, starts and fetches records. No screen."""

import subprocess
from array import array
from dataclasses import dataclass

import hal
import kerf_scope as rt

from .. import clock
from ..language import _
from . import settings as st

FUNCTION = "scope.sample"


class ScopeError(Exception):
    """Why the realtime part does not do what it should."""


@dataclass
class Record:
    """Samples of some channels. `trigger`: number of the sample that triggered (time 0);
    `length`: samples of a complete record; `values`: an array of doubles by channel number."""
    period: int                      # ns between samples
    trigger: int
    length: int
    values: dict

    @property
    def count(self):
        return min((len(v) for v in self.values.values()), default=0)


def halcmd(*words):
    """Runs halcmd; ScopeError with what it said."""
    done = clock.run(["halcmd", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                     stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise ScopeError(done.stdout.strip() or f"halcmd {' '.join(words)} failed")


def source_type(kind, name):
    """hal_type_t of a pin, signal or parameter; 0: there is none, or it is a port."""
    found = {"pin": hal.query.pin, "sig": hal.query.signal, "param": hal.query.param}[kind](name)
    kind = int(found["type"]) if found else 0
    return 0 if kind == hal.HAL_PORT else kind


def threads():
    """Names and periods (ns) of the realtime threads, fastest first."""
    found = [(t["period"], name) for name, t in hal.query.threads().items()]
    return [(name, period) for period, name in sorted(found)]


def linked_thread():
    """The thread that runs the function, or None."""
    for name, thread in hal.query.threads().items():
        if any(f["name"] == FUNCTION and not f["is_init"] for f in thread["functions"]):
            return name
    return None


class Acquisition:
    """scope_rt in use by a component of this process (hal.component)."""

    def __init__(self, component, samples):
        self._component, self.samples = component, samples
        self._open()
        self._numbers, self._channels, self._mult, self._pre, self._length = [], [], 1, 0, 1
        self._wanted = None          # what to start as soon as the realtime part is free
        self._rolling = False
        self.missing = set()         # channels whose source is not in HAL any more
        self.scope.reset()

    def _open(self):
        if not hal.query.funct(FUNCTION):
            halcmd("loadrt", "scope_rt", f"num_samples={self.samples}")
        try:
            self.scope = rt.Scope(self._component.id)
        except RuntimeError as e:
            raise ScopeError(str(e)) from None
        self.samples = self.scope.buf_len

    def link(self, thread):
        """Makes a thread run the function, and no other. The realtime part is loaded again when it has gone
        meanwhile."""
        if not hal.query.funct(FUNCTION):
            self._open()
            self.scope.reset()
        now = linked_thread()
        if now == thread:
            return
        if not hal.query.thread(thread):
            raise ScopeError(_("There is no thread '%s'.") % thread)
        if now:
            halcmd("delf", FUNCTION, now)
        halcmd("addf", FUNCTION, thread)

    def period(self, mult):
        """ns between samples in the thread that runs the function; 0: none does."""
        now = linked_thread()
        return hal.query.thread(now)["period"] * mult if now else 0

    def length(self, settings):
        """Samples of a record with the enabled channels."""
        return self.samples // max(1, len(settings.enabled()))

    def start(self, settings):
        """Begins a new record as soon as an older one is out of the way. ScopeError."""
        numbers = settings.enabled()
        if not numbers:
            raise ScopeError(_("You need to choose at least one channel."))
        length = self.samples // len(numbers)
        pre = min(int(settings.trigger.pos * length), length - 1)
        self._wanted = (settings, numbers, length, pre, settings.run_mode == st.ROLL)
        self.scope.reset()
        self._begin()

    def _trigger(self, settings, numbers):
        t = settings.trigger
        if t.source not in numbers:
            return -1, 0.0, t.rising, t.auto
        return numbers.index(t.source), st.trigger_level(settings.channel(t.source), t.level), t.rising, t.auto

    def _begin(self):
        if self._wanted is None or self.scope.state not in (rt.IDLE, rt.DONE):
            return
        settings, numbers, length, pre, roll = self._wanted
        self._numbers, self._channels = numbers, [settings.channel(n) for n in numbers]
        self._length, self._pre, self._mult, self._rolling = length, pre, settings.mult, roll
        self._resolve()
        self.scope.start(len(numbers), length, pre, settings.mult, *self._trigger(settings, numbers), roll)
        self._wanted = None

    def _resolve(self):
        """Values move when pins are linked: says again where they are."""
        self.missing = {n for place, (n, c) in enumerate(zip(self._numbers, self._channels))
                        if not self.scope.source(place, c.kind, c.name)}

    def retrigger(self, settings):
        """The trigger's level, edge or mode changed while a record is taken."""
        self.scope.retrigger(*self._trigger(settings, self._numbers))

    def force(self):
        self.scope.force()

    def stop(self):
        """No more samples."""
        self._wanted = None
        self.scope.reset()

    def close(self):
        """The memory of scope_rt is given back while the component is still there: nothing
        else can be done with this."""
        self.stop()
        self.scope = None

    @property
    def idle(self):
        return self._wanted is None and self.scope.state in (rt.IDLE, rt.RESET)

    def poll(self):
        """To be called now and then. A complete Record, or while rolling the latest one, or None."""
        if self._wanted is not None:
            self._begin()
            return None
        state = self.scope.state
        if state in (rt.IDLE, rt.RESET):
            return None
        if state == rt.DONE or self._rolling:
            return self.fetch()
        self._resolve()
        return None

    def fetch(self):
        """The samples that are there."""
        if self._rolling:
            self._resolve()
        values = [array("d", v) for v in self.scope.record()[1]]
        period = self.scope.period * self._mult
        trigger = max(0, len(values[0]) - 1) if self._rolling and values else self._pre
        return Record(period, trigger, self._length, dict(zip(self._numbers, values)))

    def progress(self):
        """State, and how much of the record is filled, 0 to 1."""
        state = self.scope.state
        if state == rt.DONE:
            return state, 1.0
        count = self.scope.count
        if state == rt.TRIG_WAIT:
            count = min(count, self._pre)
        return state, min(1.0, count / max(1, self._length))


class Offline:
    """In place of an Acquisition where no realtime runs: log files can be looked at."""
    samples, idle, missing = st.DEFAULT_SAMPLES, True, frozenset()

    def link(self, thread):
        raise ScopeError(_("No realtime is running."))

    def start(self, settings):
        raise ScopeError(_("No realtime is running."))

    def period(self, mult):
        return 0

    def length(self, settings):
        return self.samples // max(1, len(settings.enabled()))

    def progress(self):
        return rt.IDLE, 0.0

    def poll(self):
        return None

    def stop(self):
        pass

    force = close = stop

    def retrigger(self, settings):
        pass
