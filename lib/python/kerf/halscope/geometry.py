# SPDX-License-Identifier: GPL-2.0-or-later
"""From samples to pixels and back. No screen.

Time 0 is the trigger. The screen is 10 divisions wide and 10 high."""

import math
from dataclasses import dataclass

from . import settings as st

DIVISIONS = 10


def nice(seconds):
    """The least 1-2-5 number that is not less, as an index for nice_value()."""
    if seconds <= 0:
        return 0
    index = 3 * math.floor(math.log10(seconds)) - 1
    while nice_value(index) < seconds * (1 - 1e-9):
        index += 1
    return index


def nice_value(index):
    decade, part = divmod(index, 3)
    return (1.0, 2.0, 5.0)[part] * 10.0 ** decade


@dataclass
class Horizontal:
    """Samples to columns. `start` and `step`: sample at the left edge, samples a pixel."""
    period: float                    # s
    trigger: float
    start: float
    step: float
    per_div: float                   # s

    def sample(self, x):
        return self.start + x * self.step

    def x(self, sample):
        return (sample - self.start) / self.step

    def time(self, x):
        """s since the trigger."""
        return (self.sample(x) - self.trigger) * self.period


def horizontal(settings, period, length, width, trigger):
    """period: ns, length: samples of a record, width: pixels. Zoom 1 shows the whole record."""
    period = max(period, 1) * 1e-9
    per_div = nice_value(nice(length * period / DIVISIONS) - (settings.zoom - 1))
    shown = DIVISIONS * per_div / period
    return Horizontal(period, trigger, settings.pos * length - shown / 2, shown / max(1, width), per_div)


def baseline(channel, height):
    return channel.vpos * height


def mean(values):
    return math.fsum(values) / len(values) if len(values) else 0.0


def y_of(channel, value, height, average=0.0):
    """Height in pixels of a value; average: of the record, for AC coupled channels."""
    value -= channel.voff + (average if channel.ac else 0.0)
    return baseline(channel, height) - value / st.scale(channel.vscale) * height / DIVISIONS


def trace(values, h, width, y, steps, columns):
    """Points [x0, y0, x1, y1, ...] of a trace. values: array of doubles, y: function of a value, steps: hold each
    value until the next sample; columns: kerf_scope.columns."""
    first, last = h.start, h.start + h.step * width
    points, before, after = [], math.ceil(first) - 1, math.ceil(last)
    if 0 <= before < len(values):
        points += [h.x(before), y(values[before])]

    def add(x, value):
        if steps and points:
            points.extend((x, points[-1]))
        points.extend((x, y(value)))
    for column, low, high, begin, end in columns(values, first, last, width):
        x = h.x(math.ceil(first + column * h.step)) if h.step < 1 else column
        add(x, begin)
        if low != high:
            points.extend((x, y(low), x, y(high), x, y(end)))
    if 0 <= after < len(values):
        add(h.x(after), values[after])
    return points


UNITS = ((1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n"))


def engineering(value, unit):
    """5e-06 s as '5 us'."""
    if value == 0:
        return f"0 {unit}"
    if abs(value) >= 1e3 and unit == "Hz":
        return f"{value / 1e3:.4g} k{unit}"
    for factor, letter in UNITS:
        if abs(value) >= factor * 0.99999:
            return f"{value / factor:.4g} {letter}{unit}"
    return f"{value:.3g} {unit}"


def nearest(channels, columns_y, x, y, tolerance):
    """The number of the trace that passes nearest to a point, None when none is within the tolerance.
    columns_y: {number: {column: (top, bottom)}}."""
    best, best_distance = None, tolerance
    for number in channels:
        for dx in range(-int(tolerance), int(tolerance) + 1):
            span = columns_y.get(number, {}).get(int(x) + dx)
            if not span:
                continue
            dy = max(span[0] - y, 0, y - span[1])
            distance = math.hypot(dx, dy)
            if distance < best_distance:
                best, best_distance = number, distance
    return best


def snap(fraction):
    """To a multiple of .05 within .005; 0 to 1."""
    near = round(fraction * 20) / 20
    fraction = near if abs(fraction - near) <= 0.005 else fraction
    return min(max(fraction, 0.0), 1.0)
