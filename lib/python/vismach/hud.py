# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts over the picture, at the upper left."""

import re

import hal
from OpenGL import GL
from kerf import imagefont
from PIL import Image, ImageDraw

from .parts import tell

CELL = 9, 15            # of a letter
FONT, SIZE = "DejaVuSansMono.ttf", 14
EDGE = 4                # pixels above and below the lines
MISSING = "----"        # in place of a pin's value


def value_of_pin(name):
    """None while there is no such pin: other programs may make theirs later, or end before."""
    try:
        return hal.get_value(name)
    except RuntimeError:
        return None


def filled(string, value):
    if value is None:
        return re.sub(r"{[^}]*}", MISSING, string)
    try:
        return string.format(value)
    except (ValueError, IndexError, KeyError) as error:
        tell(f"{string!r} with the value {value}: {error}")
        return string


def number_of_tag(value, offset):
    try:
        return {int(value + offset)}
    except (TypeError, ValueError, OverflowError):      # no pin, NaN, infinite
        return set()


class Hud:
    """Lines with and without tags; those with one show while the tag is switched on."""

    def __init__(self, showme=1):
        self.showme = showme
        self.strs = []          # shown before the others
        self.lines = []         # (function that gives the text, tags)
        self.rules = []         # functions that give the tags that are on
        self.hiding = []        # (pin, value) that hide everything
        self.background, self.foreground = (0, .2, 0, .5), (1, .8, .4)
        self.drawn = None, None
        self.scale = 1.0        # of letters

    def show(self, string=None):
        self.showme = 1
        if string is not None:
            self.add_txt(string)

    def hide(self):
        self.showme = 0

    def clear(self):
        print("vismach: Hud.clear() is deprecated and does nothing")

    def add_txt(self, string, tag=None):
        self.lines.append((lambda: str(string), self.tags(tag)))

    def add_pin(self, string, pin=None, tag=None):
        """string.format(value of the pin); pin is its full name."""
        self.lines.append((lambda: filled(str(string), value_of_pin(pin)) if pin else str(string), self.tags(tag)))

    @staticmethod
    def tags(tag):
        return None if tag is None else set(tag) if isinstance(tag, (list, tuple, set)) else {tag}

    def show_tag_if_same(self, tag, pin, val=True):
        self.rules.append(lambda: self.tags(tag) if value_of_pin(pin) == val else set())

    def show_tags_in_pin(self, pin, offs=0):
        self.rules.append(lambda: number_of_tag(value_of_pin(pin), offs))

    def hide_all(self, pin, val=True):
        self.hiding.append((pin, val))

    def set_hud_rgba(self, r, g, b, a):
        self.background = r, g, b, a

    def set_hud_text_rgb(self, r, g, b):
        self.foreground = r, g, b

    def texts(self):
        """The lines to show now."""
        if not self.showme or any(value_of_pin(pin) == value for pin, value in self.hiding):
            return []
        on = set().union(*(rule() for rule in self.rules)) if self.rules else set()
        found = [str(s) for s in self.strs] + [text() for text, tags in self.lines if tags is None or tags & on]
        return [line for text in found for line in text.split("\n")]

    def picture(self, texts):
        """RGBA, as it is drawn."""
        colors = [tuple(round(255 * v) for v in c) for c in (self.background, self.foreground)]
        wide, tall, size, edge = (round(v * self.scale) for v in (*CELL, SIZE, EDGE))
        image = Image.new("RGBA", (wide * (max(map(len, texts)) + 2), tall * len(texts) + 2 * edge), colors[0])
        pen = ImageDraw.Draw(image)
        font = imagefont.load(FONT, size)
        for row, text in enumerate(texts):
            for column, letter in enumerate(text):
                pen.text((wide * (column + 1), edge + tall * row), imagefont.drawable(font, letter), font=font,
                         fill=colors[1] + (255,))
        return image

    def draw(self, height):
        """Over the picture; height: of the window in pixels."""
        texts = self.texts()
        if not texts:
            return
        key = texts, self.background, self.foreground
        if self.drawn[0] != key:
            self.drawn = key, self.picture(texts).transpose(Image.FLIP_TOP_BOTTOM)
        image = self.drawn[1]
        GL.glPushAttrib(GL.GL_ENABLE_BIT | GL.GL_COLOR_BUFFER_BIT)
        GL.glDisable(GL.GL_LIGHTING)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glEnable(GL.GL_BLEND)
        GL.glBlendFunc(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA)
        GL.glWindowPos2i(0, 0)
        GL.glBitmap(0, 0, 0, 0, 0, height - image.height, b"")          # below the window where it is higher
        GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
        GL.glDrawPixels(image.width, image.height, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, image.tobytes())
        GL.glPopAttrib()
