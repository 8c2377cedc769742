# SPDX-License-Identifier: GPL-2.0-or-later
"""What the user of the oscilloscope chose. No screen, no HAL."""

from dataclasses import dataclass, field

CHANNELS = 16
MIN_SAMPLES, DEFAULT_SAMPLES, MAX_SAMPLES = 1000, 32000, 1000000
MAX_MULT = 1000
MAX_ZOOM = 9
STOP, NORMAL, SINGLE, ROLL = range(4)
KINDS, CSV = ("pin", "sig", "param"), "csv"
BIT, FLOAT = 1, 2                    # hal_type_t


@dataclass
class Channel:
    """One trace. `kind`: pin, sig or param, csv for one of a log file, "" while it has no source.
    `type`: hal_type_t, 0 unknown."""
    kind: str = ""
    name: str = ""
    type: int = 0
    enabled: bool = False
    vscale: int = 0                  # index into scale()
    vpos: float = 0.5                # of the baseline, 0 top of the screen to 1 bottom
    voff: float = 0.0                # value at the baseline
    ac: bool = False                 # the mean of the record is taken away

    def limits(self):
        """Least and greatest vscale of the type."""
        return {BIT: (-2, 2), FLOAT: (-36, 36), 0: (-36, 36)}.get(self.type, (-2, 30))


@dataclass
class Trigger:
    source: int = 0                  # channel 1..16, 0: none
    level: float = 0.5               # height on the screen, 0 top to 1 bottom
    pos: float = 0.5                 # place in the record
    rising: bool = True
    auto: bool = True


@dataclass
class Settings:
    samples: int = 0                 # values in the buffer; 0: not said
    thread: str = ""
    mult: int = 1
    zoom: int = 1
    pos: float = 0.5                 # of the middle of the screen in the record
    selected: int = 0                # channel 1..16, 0: none
    run_mode: int = STOP
    trigger: Trigger = field(default_factory=Trigger)
    channels: list = field(default_factory=lambda: [Channel() for _ in range(CHANNELS)])

    def channel(self, number):
        return self.channels[number - 1]

    def shown(self):
        """Numbers of the channels that are seen."""
        return [n for n in range(1, CHANNELS + 1) if self.channel(n).enabled]

    def enabled(self):
        """Numbers of the channels that are sampled."""
        return [n for n in self.shown() if self.channel(n).kind in KINDS]

    def forget_log(self):
        """Channels that only a log file had are empty again."""
        for n in self.shown():
            if self.channel(n).kind == CSV:
                self.channels[n - 1] = Channel()
                self.selected = 0 if self.selected == n else self.selected


def scale(index):
    """Units per division of a scale index: 1, 2, 5, 10 ... and 0.5, 0.2, 0.1 ..."""
    decade = int(index / 3)
    return 10.0 ** decade * {-2: 0.2, -1: 0.5, 0: 1.0, 1: 2.0, 2: 5.0}[index - 3 * decade]


def clamp_samples(samples):
    return min(max(samples, MIN_SAMPLES), MAX_SAMPLES)


def trigger_level(channel, level):
    """The value that a height on the screen means for a channel."""
    return (channel.vpos - level) * 10 * scale(channel.vscale) + channel.voff
