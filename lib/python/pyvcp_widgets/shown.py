# SPDX-License-Identifier: GPL-2.0-or-later
"""Widgets that show a pin: led, rectled, number, u32, s32, timer, bar, meter, image_bit, image_u32."""

import math
import sys
import time
import tkinter as tk

import hal

from .base import Canvas, Follower, written

SWEEP_RAD = 5.0         # of a meter's needle
POINT_PX = 96 / 72


class Lamp(Canvas):
    """A coloured shape; grey when its pin disable is TRUE."""

    def make(self, panel, halpin, on_color, off_color, disable_pin, disabled_color):
        self.colors = off_color, on_color
        self.disabled_color = disabled_color
        for color in (*self.colors, disabled_color):
            self.winfo_rgb(color)       # a wrong colour is told when the panel is made
        name = panel.default(halpin, "led")
        self.pin = panel.new(name, hal.HAL_BIT, hal.HAL_IN)
        self.disable = panel.new(name + ".disable", hal.HAL_BIT, hal.HAL_IN) if disable_pin else None
        self.shown = None
        self.follow()

    def follow(self):
        off = self.disable is not None and self.disable.get()
        color = self.disabled_color if off else self.colors[self.pin.get()]
        if color != self.shown:
            self.shown = color
            self.itemconfigure("lamp", fill=color)


class Led(Lamp):
    def __init__(self, master, panel, halpin=None, size=20, on_color="green", off_color="red", disable_pin=False,
                 disabled_color="gray80", **options):
        super().__init__(master, size, size, options, bd=0, highlightthickness=0)
        self.create_oval(1, 1, size - 1, size - 1, tags="lamp")
        self.make(panel, halpin, on_color, off_color, disable_pin, disabled_color)


class Rectled(Lamp):
    def __init__(self, master, panel, halpin=None, height=10, width=30, on_color="green", off_color="red",
                 disable_pin=False, disabled_color="gray80", **options):
        super().__init__(master, width, height, options, bd=0, highlightthickness=0)
        self.create_rectangle(1, 1, width - 1, height - 1, tags="lamp")
        self.make(panel, halpin, on_color, off_color, disable_pin, disabled_color)


class Number(tk.Label):
    kind, pattern = hal.HAL_FLOAT, "2.1f"

    def __init__(self, master, panel, halpin=None, format=None, **options):
        super().__init__(master, **options)
        self.pattern = "%" + str(format if format is not None else type(self).pattern).lstrip("%")
        self.pattern % (0.0 if self.kind == hal.HAL_FLOAT else 0)       # so is a wrong format
        self.value = Follower(panel.new(panel.default(halpin, "number"), self.kind, hal.HAL_IN))
        self.follow()

    def follow(self):
        if (value := self.value.changed()) is not None:
            self.configure(text=written(self.pattern, value))


class U32(Number):
    kind, pattern = hal.HAL_U32, "d"


class S32(Number):
    kind, pattern = hal.HAL_S32, "d"


class Timer(tk.Label):
    """Hours, minutes and seconds that run was TRUE; a rising reset begins anew."""

    def __init__(self, master, panel, halpin=None, **options):
        super().__init__(master, **options)
        name = panel.default(halpin, "timer")
        self.reset = panel.new(name + ".reset", hal.HAL_BIT, hal.HAL_IN)
        self.run = panel.new(name + ".run", hal.HAL_BIT, hal.HAL_IN)
        self.was_reset, self.seconds, self.since = False, 0.0, None
        self.show()

    def now(self):
        return time.monotonic()

    def follow(self):
        now, run, reset = self.now(), self.run.get(), self.reset.get()
        if self.since is not None:
            self.seconds += now - self.since
        self.since = now if run else None
        if reset and not self.was_reset:
            self.seconds = 0.0
        self.was_reset = reset
        self.show()

    def show(self):
        whole = int(self.seconds)
        text = f"{whole // 3600:02d}:{whole // 60 % 60:02d}:{whole % 60:02d}"
        if self["text"] != text:
            self.configure(text=text)


class Ranged(Canvas):
    """Shows a number between two others; the first may be the greater one."""

    def range(self, low, high):
        if low == high:
            raise ValueError(f"min_ and max_ are both {low}")
        self.low, self.high = float(low), float(high)

    def share(self, value):
        """Of the way from the first to the last number, 0 to 1."""
        share = (value - self.low) / (self.high - self.low)
        return min(max(share, 0.0), 1.0) if share == share else 0.0


class Bar(Ranged):
    """A bar from the left edge, or from 0, with its number. Colours of ranges: (low, high,
    colour), all three or none."""

    def __init__(self, master, panel, halpin=None, min_=0, max_=100, fillcolor="green", bgcolor="grey",
                 range1=None, range2=None, range3=None, canvas_width=200, canvas_height=50, bar_height=30,
                 bar_width=150, format="3.1f", **options):
        super().__init__(master, canvas_width, canvas_height, options)
        self.range(min_, max_)
        self.pattern = "%" + str(format).lstrip("%")
        self.pattern % 0.0
        self.fillcolor, self.ranges = fillcolor, (range1, range2, range3) if range1 and range2 and range3 else ()
        for _low, _high, color in self.ranges:
            self.winfo_rgb(color)
        self.x, self.y, self.wide, self.tall = (canvas_width - bar_width) / 2, 5, bar_width, bar_height
        self.create_rectangle(self.x, self.y, self.x + bar_width, self.y + bar_height, fill=bgcolor)
        self.create_rectangle(0, 0, 0, 0, fill=fillcolor, width=0, tags="bar")
        below = self.y + bar_height + 7
        self.create_text(self.x, below, text=f"{min_}", tags="ink")
        self.create_text(self.x + bar_width, below, text=f"{max_}", tags="ink")
        self.create_text(self.x + bar_width / 2, self.y + bar_height / 2, tags="number")
        self.value = Follower(panel.new(panel.default(halpin, "bar"), hal.HAL_FLOAT, hal.HAL_IN))
        self.follow()

    def position(self, value):
        return self.x + self.wide * self.share(value)

    def color(self, value):
        for low, high, color in self.ranges:
            if low < value <= high:
                return color
        return self.fillcolor

    def follow(self):
        if (value := self.value.changed()) is None:
            return
        self.coords("bar", self.position(0), self.y, self.position(value), self.y + self.tall)
        self.itemconfigure("bar", fill=self.color(value))
        self.itemconfigure("number", text=written(self.pattern, value))


class Meter(Ranged):
    NUMBERS = ("majorscale",)       # options that are numbers if they are given

    def __init__(self, master, panel, halpin=None, size=200, text=None, subtext=None, min_=0, max_=100, majorscale=None,
                 minorscale=0, region1=None, region2=None, region3=None, **options):
        super().__init__(master, size, size, options)
        self.range(min_, max_)
        self.middle = size / 2
        self.radius = size / 2 - 6
        self.create_oval(6, 6, size - 6, size - 6, fill="white")
        for region in (region1, region2, region3):
            if region:
                self.arc(*region)
        # an odd scale (0, below 0, thousands of lines) gives none rather than a hang
        span = self.high - self.low
        for scale, long in ((minorscale, 0.06), (majorscale if majorscale else abs(span) / 10, 0.12)):
            if scale and scale > 0 and abs(span) / scale <= 1000:
                values = [self.low + math.copysign(n * scale, span) for n in range(int(abs(span) / scale + 1e-9) + 1)]
                every = self.every(values) if long > 0.1 else 0
                for n, value in enumerate(values):
                    self.mark(value, long, bool(every) and n % every == 0)
        for where, what, big in ((0.62, text, 8), (0.74, subtext, 6)):
            if what:
                self.write(self.middle, self.middle * 2 * where, max(int(size / 200 * big) + 4, 6), text=what)
        self.create_line(0, 0, 0, 0, width=3, fill="red", tags="needle")
        self.create_oval(self.middle - 5, self.middle - 5, self.middle + 5, self.middle + 5, fill="black")
        self.create_text(self.middle, size * 0.86, tags="number")
        self.value = Follower(panel.new(panel.default(halpin, "meter", ".value"), hal.HAL_FLOAT, hal.HAL_IN))
        self.follow()

    def angle(self, value):
        """From the positive x axis, against the clock: the sweep is open at the bottom."""
        return math.pi / 2 + SWEEP_RAD / 2 - SWEEP_RAD * self.share(value)

    def at(self, angle, radius):
        return self.middle + radius * math.cos(angle), self.middle - radius * math.sin(angle)

    def arc(self, low, high, color):
        start, end = self.angle(high), self.angle(low)
        edge = 6 + self.radius * 0.06
        size = self.middle * 2
        self.create_arc(edge, edge, size - edge, size - edge, start=math.degrees(start),
                        extent=math.degrees(end - start), outline=color, style="arc", width=self.radius * 0.1)

    def every(self, values):
        """How many marks have one number between them, so that numbers do not touch."""
        wide = 0.7 * POINT_PX * self.mark_points() * (max(len(f"{v:g}") for v in values) + 1)
        room = self.radius * 0.7 * SWEEP_RAD / max(len(values) - 1, 1)
        return next(n for n in (m * 10 ** e for e in range(9) for m in (1, 2, 5))
                    if n * room >= wide or n > len(values))

    def mark_points(self):
        return max(int(self.middle / 12), 6)

    def mark(self, value, long, named):
        angle = self.angle(value)
        self.create_line(*self.at(angle, self.radius), *self.at(angle, self.radius * (1 - long)),
                         width=2 if long > 0.1 else 1)
        if named:
            self.write(*self.at(angle, self.radius * 0.7), self.mark_points(), text=f"{value:g}")

    def follow(self):
        if (value := self.value.changed()) is None:
            return
        self.coords("needle", self.middle, self.middle, *self.at(self.angle(value), self.radius * 0.9))
        self.itemconfigure("number", text=f"{value:g}" if abs(value) < 1e6 else f"{value:.3g}")


class ImageBit(tk.Label):
    """The image whose number the pin says."""
    kind = hal.HAL_BIT

    def __init__(self, master, panel, halpin=None, images=(), **options):
        super().__init__(master, **options)
        names = images.split() if isinstance(images, str) else list(images)
        try:
            self.images = [panel.images[name] for name in names]
        except KeyError as error:
            raise ValueError(f"no image {error}: <image name=... file=.../> must stand before") from None
        self.name = panel.default(halpin, "number")
        self.value = Follower(panel.new(self.name, self.kind, hal.HAL_IN))
        self.follow()

    def follow(self):
        if (value := self.value.changed()) is None:
            return
        if int(value) >= len(self.images):
            print(f"Unknown image #{int(value)} on {self.name}", file=sys.stderr)
        else:
            self.configure(image=self.images[int(value)])


class ImageU32(ImageBit):
    kind = hal.HAL_U32
