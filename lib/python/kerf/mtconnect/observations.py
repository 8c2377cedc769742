# SPDX-License-Identifier: GPL-2.0-or-later
"""The changes of all values, numbered."""

import collections
import datetime
import threading
from dataclasses import dataclass

SIZE = 131072
NEVER = "1970-01-01T00:00:00Z"
UNAVAILABLE = "UNAVAILABLE"


def timestamp(when=None):
    when = when or datetime.datetime.now(datetime.timezone.utc)
    return when.strftime("%Y-%m-%dT%H:%M:%S.") + f"{when.microsecond // 1000:03d}Z"


@dataclass(frozen=True, slots=True)
class Observation:
    """value: text, or for a table {entry: {cell: text}}."""
    sequence: int
    time: str
    item: object
    value: object


class Observations:
    """The newest SIZE changes and the last value of each item; threads share it."""

    def __init__(self, items):
        self.items = {item.id: item for item in items}
        self.guard = threading.Lock()
        self.next = 1
        self.kept = collections.deque(maxlen=SIZE)
        self.last = {item.id: Observation(0, NEVER, item, UNAVAILABLE) for item in items}

    def take(self, values, once=()):
        """Records what changed; an item without a value is unavailable, unless it is in `once` (it happens). Returns
        the new observations."""
        now, new = timestamp(), []
        with self.guard:
            for identifier, item in self.items.items():
                if identifier not in values and identifier in once:
                    continue
                value = values.get(identifier, UNAVAILABLE)
                if self.last[identifier].value != value:
                    seen = Observation(self.next, now, item, value)
                    self.next += 1
                    self.kept.append(seen)
                    self.last[identifier] = seen
                    new.append(seen)
        return new

    def range(self):
        """(first, last, next) sequence number."""
        return self.next - len(self.kept), max(0, self.next - 1), self.next

    def current(self):
        with self.guard:
            return list(self.last.values()), self.range()

    def sample(self, start, count):
        """`count` observations from number `start` (None: the first), and (first, last, number for the next call).
        None when start is outside."""
        with self.guard:
            first, last, following = self.range()
            start = first if start is None else start
            if not first <= start <= following:
                return None
            begin = start - first
            chosen = [self.kept[n] for n in range(begin, min(begin + count, len(self.kept)))]
            return chosen, (first, last, chosen[-1].sequence + 1 if chosen else following)
