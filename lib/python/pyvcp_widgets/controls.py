# SPDX-License-Identifier: GPL-2.0-or-later
"""Widgets that set a number: spinbox, scale, dial, jogwheel."""

import math
import re
import tkinter as tk

import hal
from kerf.tkscroll import turns, wheel_scrolls

from .base import Canvas, Follower, ink_on

S32_MIN, S32_MAX = -2 ** 31, 2 ** 31 - 1


def bind_wheel(widget, action):
    """action(step) for each step of the wheel, +1 or -1; not while that scrolls the panel below the pointer."""
    for event in ("<Button-4>", "<Button-5>", "<MouseWheel>"):
        widget.bind(event, lambda e: None if wheel_scrolls(e) else action(turns(e)))


def make_param_pin(panel, kind, number, halparam, initval):
    """The pin that sets the value from outside; always of the default name, unless halparam names it."""
    name = halparam or f"{kind}.{number}.param_pin"
    follower = Follower(panel.new(name, hal.HAL_FLOAT, hal.HAL_IN))
    follower.seen = panel.first(name, initval)
    follower.pin.set(follower.seen)
    return follower


class Spinbox(tk.Spinbox):
    def __init__(self, master, panel, halpin=None, min_=0, max_=100, initval=0, resolution=1,
                 format="2.1f", param_pin=0, halparam=None, **options):
        number = panel.count("spinbox")
        self.low, self.high, self.resolution = float(min_), float(max_), float(resolution)
        self.pattern = "%" + str(format).lstrip("%")
        name = halpin or f"spinbox.{number}"
        first = panel.first(name, initval)
        self.value = tk.StringVar(master, value=self.pattern % first)
        # Tk's arrows know only %N.Mf: put() writes other formats behind them
        places = re.search(r"\.(\d+)f$", self.pattern)
        super().__init__(master, textvariable=self.value, from_=min_, to=max_, increment=resolution, **options,
                         format=f"%.{places[1] if places else 9}f", command=lambda: self.put(self.number()))
        self.pin = panel.new(name, hal.HAL_FLOAT, hal.HAL_OUT)
        self.param = make_param_pin(panel, "spinbox", number, halparam, initval) if param_pin == 1 else None
        self.bind("<Return>", lambda _: self.put(self.number()))
        self.bind("<KP_Enter>", lambda _: self.put(self.number()))
        bind_wheel(self, lambda step: self.put(self.number() + step * self.resolution) or "break")
        self.put(first)
        self.follow()

    def number(self):
        """What is written; while that is no number, the last one that was."""
        try:
            value = float(self.value.get())
            if math.isfinite(value):
                self.good = value
        except ValueError:
            pass
        return self.good

    def put(self, value):
        self.good = min(max(value, self.low), self.high)
        self.value.set(self.pattern % self.good)
        return ""

    def follow(self):
        if self.param and (asked := self.param.changed()) is not None and not math.isnan(asked):
            self.put(asked)
        self.pin.set(self.number())


class Scale(tk.Scale):
    """A slider: KIND-f is its value, KIND-i the whole part."""

    def __init__(self, master, panel, halpin=None, min_=0, max_=10, initval=0, resolution=1, param_pin=0,
                 halparam=None, **options):
        number = panel.count("scale")
        name = halpin or f"scale.{number}"
        first = panel.first(name + "-f", panel.first(name + "-i", initval))
        self.value = tk.DoubleVar(master, value=first)
        if resolution > 0 and float(resolution) != int(resolution):
            # as many places as the resolution has
            places = len(f"{float(resolution):.9f}".rstrip("0").partition(".")[2])
            options.setdefault("digits", len(str(int(max(abs(min_), abs(max_))))) + places)
        super().__init__(master, variable=self.value, from_=min_, to=max_, resolution=resolution, **options)
        self.step = float(resolution)
        self.whole = panel.new(name + "-i", hal.HAL_S32, hal.HAL_OUT)
        self.real = panel.new(name + "-f", hal.HAL_FLOAT, hal.HAL_OUT)
        self.param = make_param_pin(panel, "scale", number, halparam, initval) if param_pin == 1 else None
        bind_wheel(self, lambda step: self.set(self.get() + step * self.step))
        self.set(first)
        self.follow()

    def follow(self):
        if self.param and (asked := self.param.changed()) is not None and math.isfinite(asked):
            self.set(asked)
        value = float(self.get())
        self.real.set(value)
        self.whole.set(min(max(int(value), S32_MIN), S32_MAX))


class Wheel(Canvas):
    """A round knob that is turned by dragging and by the mouse's wheel: turned(steps) is called."""

    def make(self, size, cpr, text, face, edge, dot):
        self.middle, self.cpr = size / 2, max(int(cpr), 1)
        self.radius = size / 2 - 5
        self.rest, self.steps, self.last = 0.0, 0, None
        edge_tags = () if edge or face else ("edge",)
        self.ink_tags = () if face else ("ink",)         # on the panel's ground, which may change
        self.ink = ink_on(self, face) if face else "black"
        self.create_oval(5, 5, size - 5, size - 5, fill=face, outline=edge or "black", width=2,
                         tags=("face", *edge_tags))
        for n in range(self.cpr if self.cpr <= 120 else 60):
            angle = 2 * math.pi * n / (self.cpr if self.cpr <= 120 else 60)
            self.create_line(*self.at(angle, self.radius), *self.at(angle, self.radius * 0.94), fill=edge or self.ink,
                             tags=() if edge else self.ink_tags)
        self.create_oval(0, 0, 0, 0, fill=dot, tags="dot")
        self.say(0.72, size / 18, text=text or "")
        self.say(0.5, size / 14, tag="number")
        self.bind("<ButtonPress-1>", self.grip)
        self.bind("<B1-Motion>", self.drag)
        bind_wheel(self, self.turn)
        self.show_dot()

    def say(self, height, letters, tag="text", text=""):
        """A text in the middle; height: share from the top."""
        self.write(self.middle, 2 * self.middle * height, max(int(letters), 6), text=text, fill=self.ink,
                   tags=(tag, *self.ink_tags))

    def at(self, angle, radius):
        """A place; angle from the top, clockwise."""
        return self.middle + radius * math.sin(angle), self.middle - radius * math.cos(angle)

    def show_dot(self):
        x, y = self.at(2 * math.pi * self.steps / self.cpr, self.radius * 0.8)
        r = self.radius * 0.1
        self.coords("dot", x - r, y - r, x + r, y + r)

    def angle(self, event):
        return math.atan2(event.x / self.factor - self.middle, self.middle - event.y / self.factor)

    def grip(self, event):
        self.last = self.angle(event)

    def drag(self, event):
        if self.last is None:
            return
        now = self.angle(event)
        # the shorter way round
        self.rest += (now - self.last + math.pi) % (2 * math.pi) - math.pi
        self.last = now
        steps = int(self.rest * self.cpr / (2 * math.pi))
        if steps:
            self.rest -= steps * 2 * math.pi / self.cpr
            self.turn(steps)

    def turn(self, steps):
        self.steps += steps
        self.show_dot()
        self.turned(steps)

    def turned(self, steps):
        raise NotImplementedError


class Dial(Wheel):
    """A number: double clicks change the step (left a tenth, middle the first one, right ten times), Shift-click goes
    back to the first value."""
    NUMBERS = ("min_", "max_")

    def __init__(self, master, panel, halpin=None, halparam=None, size=200, cpr=40, min_=None, max_=None,
                 text=None, initval=0, resolution=0.1, param_pin=1, dialcolor="", edgecolor="",
                 dotcolor="grey", **options):
        super().__init__(master, size, size, options)
        number = panel.count("dial")
        name = halpin or f"dial.{number}.out"
        self.pin = panel.new(name, hal.HAL_FLOAT, hal.HAL_OUT)
        self.param = make_param_pin(panel, "dial", number, halparam, initval)
        self.low, self.high = min_, max_
        self.first, self.value = float(initval), panel.first(name, initval)
        self.first_step = self.step = float(resolution)
        self.make(size, cpr, text, dialcolor, edgecolor, dotcolor)
        self.say(0.35, size / 20, tag="step")
        for button, change in ((1, lambda: self.step / 10), (2, lambda: self.first_step), (3, lambda: self.step * 10)):
            self.bind(f"<Double-Button-{button}>", lambda _, change=change: self.set_step(change()))
        self.bind("<Shift-Button-1>", lambda _: self.put(self.first))
        self.set_step(self.step)
        self.put(self.value)

    def set_step(self, step):
        self.step = step
        self.itemconfigure("step", text=f"x {step:g}")

    def turned(self, steps):
        self.put(self.value + steps * self.step)

    def put(self, value):
        if self.low is not None:
            value = max(value, self.low)
        if self.high is not None:
            value = min(value, self.high)
        self.value = value
        self.pin.set(value)
        self.itemconfigure("number", text=f"{value:.6g}")

    def follow(self):
        if (asked := self.param.changed()) is not None and math.isfinite(asked):
            self.put(asked)


class Jogwheel(Wheel):
    """Counts steps; with clear_pin a scaled number is shown, which Shift-click and the pin reset clear."""

    def __init__(self, master, panel, halpin=None, size=200, cpr=40, bgcolor="lightgrey",
                 fillcolor="lightgrey", text=None, clear_pin=0, scale_pin=0, **options):
        super().__init__(master, size, size, options)
        base = panel.default(halpin, "jogwheel")
        name = halpin or base + ".count"
        self.pin = panel.new(name, hal.HAL_FLOAT, hal.HAL_OUT)
        self.reset = Follower(panel.new(base + ".reset", hal.HAL_BIT, hal.HAL_IN)) if clear_pin else None
        self.scale = Follower(panel.new(base + ".scale", hal.HAL_FLOAT, hal.HAL_IN)) if scale_pin else None
        self.count, self.shown = int(panel.first(name, 0)), 0.0
        self.pin.set(self.count)
        self.make(size, cpr, text, bgcolor, "", "grey")
        self.winfo_rgb(fillcolor)
        self.say(0.35, size / 20, tag="step")
        self.bind("<Enter>", lambda _: self.itemconfigure("face", fill=fillcolor))
        self.bind("<Leave>", lambda _: self.itemconfigure("face", fill=bgcolor))
        if clear_pin:
            self.bind("<Shift-Button-1>", lambda _: self.clear())
            self.clear()

    def clear(self):
        self.shown = 0.0
        self.show()

    def show(self):
        if self.reset is not None:
            self.itemconfigure("number", text=f"{self.shown:.4f}")

    def turned(self, steps):
        self.count += steps
        self.pin.set(self.count)
        self.shown += steps * (self.scale.pin.get() if self.scale is not None else 0)
        self.show()

    def follow(self):
        if self.reset is not None and self.reset.changed():
            self.clear()
        if self.scale is not None and (scale := self.scale.changed()) is not None:
            self.itemconfigure("step", text=f"x {scale:g}")
