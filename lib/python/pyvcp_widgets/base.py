# SPDX-License-Identifier: GPL-2.0-or-later
"""What widgets share: the panel with its component and counters, pins, elements that are no widgets."""


class Panel:
    """One panel: its HAL component, default names, images, widgets. include(widget, file, prefix) fills an include."""

    def __init__(self, component, include):
        self.component, self.include = component, include
        self.counters, self.images, self.widgets, self.pins = {}, {}, [], set()

    def count(self, kind):
        """The next number of a kind of widgets, from 0."""
        number = self.counters.get(kind, 0)
        self.counters[kind] = number + 1
        return number

    def next_number(self, kind):
        """The number that count() would give."""
        return self.counters.get(kind, 0)

    def default(self, halpin, kind, suffix=""):
        """halpin, or the default name KIND.N and suffix; only default names count."""
        return halpin if halpin else f"{kind}.{self.count(kind)}{suffix}"

    def new(self, name, kind, direction):
        """A pin. Raises hal.error."""
        self.pins.add(f"{self.component.getprefix()}.{name}")
        return self.component.newpin(name, kind, direction)

    def has(self, name):
        return f"{self.component.getprefix()}.{name}" in self.pins


class Follower:
    """A pin that is looked at: changed() gives its value when that is a new one, else None."""

    def __init__(self, pin):
        self.pin, self.seen = pin, None

    def changed(self):
        value = self.pin.get()
        if value == self.seen:
            return None
        self.seen = value
        return value


class Directive:
    """An element that says something to the container around it, and is no widget."""

    def apply(self, container):
        raise NotImplementedError
