# SPDX-License-Identifier: GPL-2.0-or-later
"""What widgets share: the panel with its component and counters, pins, drawings, elements that are no widgets."""

import tkinter as tk

from kerf import tkstyle

LEAST_CONTRAST = 0.35       # of letters on their ground, of the way from black to white


class Panel:
    """One panel: its HAL component, default names, images, widgets. include(widget, file, prefix) fills an include.
    numbers: what pins of numbers begin with, by full name."""

    def __init__(self, component, include, numbers):
        self.component, self.include, self.numbers = component, include, numbers
        self.counters, self.images, self.widgets = {}, {}, []

    def count(self, kind):
        """The next number of a kind of widgets, from 0."""
        number = self.counters.get(kind, 0)
        self.counters[kind] = number + 1
        return number

    def default(self, halpin, kind, suffix=""):
        """halpin, or the default name KIND.N and suffix; only default names count."""
        return halpin if halpin else f"{kind}.{self.count(kind)}{suffix}"

    def first(self, name, initval):
        """The number that a pin begins with."""
        return float(self.numbers.get(f"{self.component.getprefix()}.{name}", initval))

    def new(self, name, kind, direction):
        """A pin. Raises hal.error."""
        return self.component.newpin(name, kind, direction)


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


def written(pattern, value):
    """The number by a format; one that has no whole part for %d (NaN, infinite) as it is."""
    try:
        return pattern % value
    except (ValueError, OverflowError):
        return f"{value:g}"


def brightness(widget, colour):
    """0 black to 1 white."""
    red, green, blue = widget.winfo_rgb(colour)
    return (0.299 * red + 0.587 * green + 0.114 * blue) / 65535


def ink_on(widget, ground):
    """A colour that can be read on this one."""
    return "black" if brightness(widget, ground) > 0.5 else tkstyle.DARK["ink"]


def keep_readable(widget, options):
    """Where the panel's author chose only the letters' colour or only their ground, the other comes from the theme:
    letters that can hardly be read then, on a dark ground or on the author's, get another colour."""
    chosen = bool({"bg", "background"} & options.keys())
    if "foreground" not in widget.keys() or (chosen and {"fg", "foreground"} & options.keys()):
        return
    ground = brightness(widget, widget["background"])
    if ((chosen or ground < 0.5 or tkstyle.style_of(widget).dark)
            and abs(ground - brightness(widget, widget["foreground"])) < LEAST_CONTRAST):
        widget.configure(foreground=ink_on(widget, widget["background"]))


def known_options(options, names):
    """Those options that have these names, and the names of the others."""
    return {n: value for n, value in options.items() if n in names}, sorted(options.keys() - names)


class Canvas(tk.Canvas):
    """A drawing on the panel's own ground, in the pixels of a usual screen: it grows with the screen. tint() gives
    what has the tag ink (letters, lines) or edge (outlines) a colour that can be read on it, also after the theme has
    changed. `unknown`: options that are not for drawings."""

    def __init__(self, master, width, height, options, **defaults):
        super().__init__(master, width=width, height=height, **defaults)
        known, self.unknown = known_options(options, set(self.keys()) - {"width", "height"})
        self.configure(**known)
        self.ground = None
        if (not {"bg", "background"} & options.keys()
                and self["background"] in (tkstyle.LIGHT["field"], tkstyle.DARK["field"])):
            self.configure(background=master["background"])
        self.factor, self.usual_size, self.sizes = 1.0, (width, height), {}
        self.after_idle(self.grow)           # when all is drawn

    def grow(self):
        if self.winfo_exists():
            tkstyle.follow(self, self.resize)

    def resize(self):
        """To the scale of the screen."""
        before, self.factor = self.factor, tkstyle.style_of(self).scale
        change = self.factor / before
        self.configure(width=round(self.usual_size[0] * self.factor), height=round(self.usual_size[1] * self.factor))
        if change != 1:
            tk.Canvas.scale(self, "all", 0, 0, change, change)      # a wheel has a pin of that name
            for item in self.find_all():
                if self.type(item) != "text":
                    self.itemconfigure(item, width=float(self.itemcget(item, "width")) * change)
        for item, points in self.sizes.items():
            self.itemconfigure(item, font=self.letters(points))

    def letters(self, points):
        return "Helvetica", -max(round(points * 96 / 72 * self.factor), 8)

    def write(self, x, y, points, **options):
        """A text with letters of this height."""
        item = self.create_text(x, y, font=self.letters(points), **options)
        self.sizes[item] = points
        return item

    def coords(self, *args):
        """Moves an item, in the pixels of a usual screen."""
        return super().coords(args[0], *(self.factor * v for v in args[1:]))

    def tint(self):
        if self.ground != self["background"]:
            self.ground = self["background"]
            colour = ink_on(self, self.ground)
            self.itemconfigure("ink", fill=colour)
            self.itemconfigure("edge", outline=colour)


class Directive:
    """An element that says something to the container around it, and is no widget."""

    def apply(self, container):
        raise NotImplementedError
