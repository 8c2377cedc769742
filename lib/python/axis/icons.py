# SPDX-License-Identifier: GPL-2.0-or-later
"""Icons of the tool bar, drawn at the size that the screen needs."""

import io
import tkinter as tk

from kerf import imagefont
from PIL import Image, ImageDraw

OVERSAMPLE = 4
# Inks for a light and a dark ground; each can be told from a button, pressed or not.
LIGHT = {"ink": "#2b2f36", "bad": "#c62828", "good": "#1a7a33", "blue": "#1f5fa8", "quiet": "#6c7480",
         "gold": "#a06c00", "ring_colour": "#c62828"}
DARK = {"ink": "#e4e6ea", "bad": "#ff6b5e", "good": "#5fd17f", "blue": "#7fb2f0", "quiet": "#9aa1ab", "gold": "#e0a020",
        "ring_colour": "#ffffff"}
EMERGENCY = "#c62828"


class Pen:
    """Draws in a square of 24 by 24 units. Its attributes are colours by purpose, too: ink, bad, good..."""

    def __init__(self, size, colours):
        self.scale = size * OVERSAMPLE / 24
        self.size = size
        vars(self).update(colours)
        self.image = Image.new("RGBA", (size * OVERSAMPLE,) * 2, (0, 0, 0, 0))
        self.draw = ImageDraw.Draw(self.image)

    def points(self, *xy):
        return [c * self.scale for c in xy]

    def line(self, *xy, colour=None, width=2):
        self.draw.line(self.points(*xy), fill=colour or self.ink, width=round(width * self.scale), joint="curve")

    def fill(self, *xy, colour=None):
        self.draw.polygon(self.points(*xy), fill=colour or self.ink)

    def ring(self, x, y, r, colour=None, width=2):
        self.draw.ellipse(self.points(x - r, y - r, x + r, y + r), outline=colour or self.ink,
                          width=round(width * self.scale))

    def disc(self, x, y, r, colour=None):
        self.draw.ellipse(self.points(x - r, y - r, x + r, y + r), fill=colour or self.ink)

    def arc(self, x, y, r, start, end, colour=None, width=2):
        self.draw.arc(self.points(x - r, y - r, x + r, y + r), start, end, fill=colour or self.ink,
                      width=round(width * self.scale))

    def rect(self, x0, y0, x1, y1, colour=None):
        self.draw.rectangle(self.points(x0, y0, x1, y1), fill=colour or self.ink)

    def text(self, text, colour=None, size=15):
        font = imagefont.load("DejaVuSans-Bold.ttf", size * self.scale)
        self.draw.text(self.points(12, 12), text, fill=colour or self.ink, font=font, anchor="mm")

    def png(self):
        data = io.BytesIO()
        self.image.resize((self.size, self.size), Image.LANCZOS).save(data, "PNG")
        return data.getvalue()


def estop(p):
    p.disc(12, 12, 11, EMERGENCY)
    p.ring(12, 12, 11, p.ring_colour, 1)
    p.line(7, 7, 17, 17, colour="#ffffff", width=3)
    p.line(17, 7, 7, 17, colour="#ffffff", width=3)


def power(p):
    p.arc(12, 13, 8, -60, 240, p.good, 2.6)
    p.line(12, 2, 12, 12, colour=p.good, width=2.6)


def open_(p):
    p.fill(2, 6, 9, 6, 11, 9, 20, 9, 20, 12, 2, 12, colour=p.gold)
    p.fill(5, 11, 23, 11, 19, 20, 2, 20, colour="#e8ae30")


def reload(p):
    p.arc(12, 12, 8, 30, 320, p.blue, 2.6)
    p.fill(15, 3, 22, 5, 17, 11, colour=p.blue)


def run(p):
    p.fill(6, 3, 20, 12, 6, 21, colour=p.good)


def step(p):
    p.fill(4, 3, 15, 12, 4, 21, colour=p.good)
    p.rect(17, 4, 20, 20, p.good)


def pause(p, colour=None):
    for x in (5, 14):
        p.rect(x, 4, x + 4, 20, colour or p.blue)


def pause_inhibited(p):
    pause(p, p.quiet)
    p.line(3, 21, 21, 3, colour=p.bad, width=2.4)


def stop(p):
    p.rect(4, 4, 20, 20, p.bad)


def blockdelete(p):
    p.line(16, 3, 8, 21, width=3)
    p.line(2, 12, 6, 12, colour=p.quiet)
    p.line(18, 12, 22, 12, colour=p.quiet)


def optpause(p):
    p.text("M1", size=12)


def magnifier(p, plus):
    p.ring(10, 10, 7)
    p.line(15, 15, 21, 21, width=3)
    p.line(7, 10, 13, 10)
    if plus:
        p.line(10, 7, 10, 13)


def letter(text, colour, turned=False):
    def draw(p):
        p.text(text, getattr(p, colour))
        if turned:
            p.arc(12, 12, 10.5, 200, 290, p.quiet, 1.6)
            p.fill(14, 0, 18, 3, 13, 5, colour=p.quiet)
    return draw


def perspective(p):
    a, b = (4, 9, 13, 5, 21, 8, 12, 13), ((4, 9), (12, 13), (21, 8))
    p.line(*a, 4, 9, colour=p.blue, width=1.6)
    for x, y in b:
        p.line(x, y, x, y + 9, colour=p.blue, width=1.6)
    p.line(4, 18, 12, 22, 21, 17, colour=p.blue, width=1.6)


def rotate(p):
    p.arc(12, 12, 9, 120, 400, width=2.2)
    p.fill(16, 15, 23, 17, 18, 22)
    p.disc(12, 12, 2)


def clear(p):
    p.line(3, 18, 9, 8, 14, 15, 20, 5, colour=p.gold, width=2)
    p.line(4, 4, 20, 20, colour=p.bad, width=2.4)


def turning(start, end, head):
    def draw(p):
        p.arc(12, 12, 8, start, end, p.good, 2.6)
        p.fill(*head, colour=p.good)
    return draw


def radio(on):
    def draw(p):
        p.ring(12, 12, 10)
        if on:
            p.disc(12, 12, 5.5, p.blue)
    return draw


def check(on):
    def draw(p):
        for x0, y0, x1, y1 in ((3, 3, 21, 3), (21, 3, 21, 21), (21, 21, 3, 21), (3, 21, 3, 3)):
            p.line(x0, y0, x1, y1)
        if on:
            p.line(7, 12, 11, 16.5, 18, 7, colour=p.blue, width=3.5)
    return draw


MARKS = {"radio_off": radio(False), "radio_on": radio(True), "check_off": check(False), "check_on": check(True)}
MARK_SIZE = 0.62             # of the tool bar's icons
DRAWINGS = MARKS | {
    "estop": estop, "power": power, "open": open_, "reload": reload, "run": run, "step": step, "pause": pause,
    "pause_inhibited": pause_inhibited, "stop": stop, "blockdelete": blockdelete, "optpause": optpause,
    "zoomin": lambda p: magnifier(p, True), "zoomout": lambda p: magnifier(p, False),
    "view_z": letter("Z", "blue"), "view_z2": letter("Z", "blue", True), "view_x": letter("X", "good"),
    "view_y": letter("Y", "bad"), "view_y2": letter("Y", "bad", True), "view_p": perspective, "rotate": rotate,
    "clear": clear, "spindle_cw": turning(180, 450, (12, 24, 12, 16, 5, 20)),
    "spindle_ccw": turning(90, 360, (12, 24, 12, 16, 19, 20)), "spindle_stop": stop,
}


class Icons:
    """Images by name; each is made once."""

    def __init__(self, root, size, dark=False):
        self.root, self.size, self.colours = root, size, DARK if dark else LIGHT
        self.images = {}

    def png(self, name):
        if name not in DRAWINGS:
            raise ValueError(f"no image {name}; there are {' '.join(sorted(DRAWINGS))}")
        pen = Pen(round(self.size * MARK_SIZE) if name in MARKS else self.size, self.colours)
        DRAWINGS[name](pen)
        return pen.png()

    def get(self, name):
        if name not in self.images:
            self.images[name] = tk.PhotoImage(master=self.root, data=self.png(name))
        return self.images[name]

    def restyle(self, size, dark):
        """All images at another size or for another ground; widgets show them at once."""
        self.size, self.colours = size, DARK if dark else LIGHT
        for name, image in self.images.items():
            image.configure(data=self.png(name))
