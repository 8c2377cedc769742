# SPDX-License-Identifier: GPL-2.0-or-later
"""The older interface of Python components: classes halType, pinDir, component, pin, port, signal.

Deprecated: new programs use the module hal, on which this one is built. Whatever HAL
refuses raises HalException with HAL's negative error number or the rule that was broken.
"""
import warnings

import _hal
import hal
import kerf_clock

warnings.warn("pyhal is deprecated: use the module hal", FutureWarning, stacklevel=2)

_WAIT_S = 0.01


class HalException(Exception):
    """What HAL refused."""


class halType:
    """Types of pins and signals."""
    BIT, FLOAT, SIGNED, UNSIGNED, PORT = 1, 2, 3, 4, 5
    values = [BIT, FLOAT, SIGNED, UNSIGNED, PORT]


class pinDir:
    """Directions of pins."""
    IN, OUT, IO = 16, 32, 48
    values = [IN, OUT, IO]


class pin:
    """A pin of a component; `value` reads and writes it, whatever its direction."""

    def __init__(self, component, name, type, dir, item):
        self.comp, self.name, self.type, self.dir, self._item = component, name, type, dir, item

    @property
    def fullname(self):
        return "%s.%s" % (self.comp.name, self.name)

    @property
    def value(self):
        if self.type == halType.PORT:
            raise HalException("cannot get value of PORT pin")
        return self._item.get()

    @value.setter
    def value(self, value):
        if self.type == halType.PORT:
            raise HalException("cannot set value of PORT pin")
        self._item.set(value)


class port(pin):
    """A queue of bytes: one component writes its OUT pin, one reads its IN pin."""

    def _reader(self):
        if self.dir == pinDir.OUT:
            raise HalException("cannot read output port")
        return self._item

    def _writer(self):
        if self.dir == pinDir.IN:
            raise HalException("cannot write input port")
        return self._item

    def read(self, count):
        """The next count bytes; b"" when there are fewer."""
        return self._reader().read(count) or b""

    def peek(self, count):
        """As read, but the bytes stay."""
        return self._reader().peek(count) or b""

    def peek_commit(self, count):
        """Drops count bytes; False when there are fewer."""
        return self._reader().peek_commit(count)

    def write(self, buff):
        """Writes all of a text or bytes; False when there is too little room."""
        return self._writer().write(buff)

    def readable(self):
        return self._reader().readable()

    def writable(self):
        return self._writer().writable()

    def size(self):
        return self._item.size()

    def clear(self):
        self._item.clear()

    def waitReadable(self, count):
        """Waits until count bytes can be read."""
        while self.readable() < count:
            kerf_clock.sleep(_WAIT_S)

    def waitWritable(self, count):
        """Waits until there is room for count bytes."""
        while self.writable() < count:
            kerf_clock.sleep(_WAIT_S)


class signal:
    """A signal; `value` reads and writes it while no output pin does (a port's: the size of its queue)."""

    def __init__(self, name, type):
        self.name, self.type = name, type

    @property
    def value(self):
        return hal.get_s(self.name)

    @value.setter
    def value(self, value):
        try:
            hal.set_s(self.name, value)
        except RuntimeError as e:
            raise HalException(str(e)) from None


class component:
    """A component of this process. `pins` has its pins by name."""

    def __init__(self, name):
        try:
            self._comp = _hal.component(name)
        except hal.error:
            raise HalException('failed to initialize component "%s"' % name) from None
        self.id, self.name, self.pins = self._comp.id, name, {}

    def ready(self):
        try:
            self._comp.ready()
        except hal.error as e:
            raise HalException("hal_ready failed: %s" % e) from None

    def exit(self):
        """Removes the component and its pins; once more does nothing."""
        if self._comp is not None:
            self._comp.exit()
            self._comp = None

    def pinNew(self, name, type, dir):
        """A new pin COMPONENT.name."""
        for word, value, known in (("type", type, halType.values), ("dir", dir, pinDir.values)):
            if value not in known:
                raise HalException('failed to create pin "%s". Unknown %s %s' % (name, word, value))
        try:
            item = self._comp.newpin(name, type, dir)
        except (hal.error, ValueError) as e:
            raise HalException('failed to create pin "%s": %s' % (name, e)) from None
        self.pins[name] = (port if type == halType.PORT else pin)(self, name, type, dir, item)
        return self.pins[name]

    def sigNew(self, name, type):
        """A new signal; it belongs to nobody and stays."""
        if hal.new_sig(name, type):
            raise HalException('failed to create signal "%s"' % name)
        return signal(name, type)

    def sigLink(self, pin_name, sig_name):
        """Links a pin, by its full name, to a signal."""
        if hal.connect(pin_name, sig_name):
            raise HalException('failed to link sig "%s" to pin "%s"' % (sig_name, pin_name))
