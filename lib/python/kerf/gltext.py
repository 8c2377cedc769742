# SPDX-License-Identifier: GPL-2.0-or-later
"""Letters for OpenGL: one texture with the glyphs of a font, and quads of texts."""

import numpy as np
from PIL import Image, ImageDraw

from . import imagefont

FIRST, LAST = 32, 126
MORE = "⌂⚠°±…µ·×ÄÖÜäöüßéèêçàñå"       # beside ASCII
FILE = "DejaVuSansMono.ttf"


class Glyphs:
    """The texture's data and the places in it. Unknown letters become '?'."""

    def __init__(self, pixels):
        font = imagefont.load(FILE, pixels)
        letters = [chr(c) for c in range(FIRST, LAST + 1)] + [c for c in MORE if imagefont.drawable(font, c) == c]
        boxes = [font.getbbox(c) for c in letters]
        self.advance = (max(1, round(font.getlength("0"))) if hasattr(font, "getlength")
                        else max(1, font.getsize("0")[0]))
        self.width = max(self.advance, *(b[2] for b in boxes)) + 2
        self.height = max(b[3] for b in boxes) + 2
        self.line = round(1.25 * pixels)
        columns = 16
        rows = -(-len(letters) // columns)
        sheet = Image.new("L", (columns * self.width, rows * self.height), 0)
        draw = ImageDraw.Draw(sheet)
        for i, c in enumerate(letters):
            draw.text((i % columns * self.width + 1, i // columns * self.height), c, font=font, fill=255)
        self.data = np.asarray(sheet, np.uint8)
        self.size = sheet.size
        self.columns = columns
        self.index = {c: i for i, c in enumerate(letters)}
        self.unknown = self.index["?"]

    def quads(self, text, x, y):
        """Rows x, y, u, v of two triangles a letter; x, y: upper left corner of the text, pixels, y down."""
        at, rows = [], []
        for line in text.split("\n"):
            left = x
            for c in line:
                if c != " ":
                    at.append((left, y))
                    rows.append(self.index.get(c, self.unknown))
                left += self.advance
            y += self.line
        if not at:
            return np.empty((0, 4), np.float32)
        at = np.array(at, np.float32)
        n = np.array(rows)
        u0, v0 = n % self.columns * self.width, n // self.columns * self.height
        out = np.empty((len(n), 6, 4), np.float32)
        for k, (i, j) in enumerate(((0, 0), (1, 0), (0, 1), (0, 1), (1, 0), (1, 1))):
            out[:, k, 0] = at[:, 0] + i * self.width
            out[:, k, 1] = at[:, 1] + j * self.height
            out[:, k, 2] = (u0 + i * self.width) / self.size[0]
            out[:, k, 3] = (v0 + j * self.height) / self.size[1]
        return out.reshape(-1, 4)

    def extent(self, text):
        """(width, height) of a text in pixels."""
        lines = text.split("\n")
        return self.advance * max(map(len, lines)), self.line * len(lines)
