# SPDX-License-Identifier: GPL-2.0-or-later
"""Log files of the oscilloscope: CSV with semicolons, one line per sample, all channels.

    # Sampling period is 1000000 ns
    and2.0.out;speed
    # Position: 0.500000;0.250000
    # Scale: 0;3
    1;0.50000000000000

Spreadsheets and numpy.loadtxt(delimiter=";", skiprows=2) read them as well.
"""

import math
import re
from array import array
from dataclasses import dataclass
from decimal import Decimal

import kerf_tooltext

from ..language import _
from . import settings as st


class LogError(Exception):
    """What is wrong in a log file, with the line."""


@dataclass
class Log:
    """A record of a file. Values: an array of doubles per name."""
    period: int
    names: list
    values: list
    positions: list
    scales: list


def _value(value, is_bit):
    """14 places, and as many more as it takes to be the same number when it is read."""
    if is_bit:
        return str(int(value != 0))
    short = f"{value:.14f}"
    return short if float(short) == value or not math.isfinite(value) else format(Decimal(repr(value)), "f")


def text(period, channels, values):
    """channels: Channel objects, values: an array of doubles each, of the same length."""
    out = [f"# Sampling period is {period} ns", ";".join(c.name for c in channels),
           "# Position: " + ";".join(f"{c.vpos:.6f}" for c in channels),
           "# Scale: " + ";".join(str(c.vscale) for c in channels)]
    bits = [c.type == st.BIT for c in channels]
    for row in zip(*values):
        out.append(";".join(_value(v, bit) for v, bit in zip(row, bits)))
    return "\n".join(out) + "\n"


def save(path, period, channels, values):
    kerf_tooltext.replace_file(path, text(period, channels, values).encode(), False)


def parse(lines):
    """A Log from the lines of a file; LogError names the line that is wrong."""
    lines = [line.rstrip("\r\n") for line in lines]
    first = re.match(r"#\s*Sampling period is (\d+) ns", lines[0]) if lines else None
    if not first or int(first[1]) <= 0:
        raise LogError(_("line 1: '# Sampling period is N ns' is missing"))
    if len(lines) < 2 or not lines[1].strip():
        raise LogError(_("line 2: the names of the channels are missing"))
    names = lines[1].split(";")
    if len(names) > st.CHANNELS:
        raise LogError(_("line 2: %s channels, at most %s fit") % (len(names), st.CHANNELS))
    log = Log(int(first[1]), names, [array("d") for _ in names], [None] * len(names), [None] * len(names))
    for number, line in enumerate(lines[2:], 3):
        note = re.match(r"#\s*(Position|Scale):(.*)", line)
        if note:
            words = [w.strip() for w in note[2].split(";")]
            kind, put = (float, log.positions) if note[1] == "Position" else (int, log.scales)
            try:
                put[:] = [kind(w) for w in words]
                if not all(map(math.isfinite, put)):
                    raise ValueError
            except (ValueError, OverflowError):     # no number, or more than fits
                raise LogError(_("line %s: bad number in '%s'") % (number, line)) from None
            if len(put) != len(names):
                raise LogError(_("line %s: %s values for %s channels") % (number, len(put), len(names)))
            continue
        if not line.strip() or line.startswith("#"):
            continue
        words = line.split(";")
        if len(words) != len(names):
            raise LogError(_("line %s: %s values for %s channels") % (number, len(words), len(names)))
        try:
            row = [float(w) for w in words]
        except ValueError:
            raise LogError(_("line %s: bad number in '%s'") % (number, line[:60])) from None
        for column, value in zip(log.values, row):
            column.append(value)
    return log


def load(path):
    """The Log of a file. OSError, LogError."""
    with open(path, encoding="utf-8", errors="replace") as f:
        return parse(f.read().splitlines())
