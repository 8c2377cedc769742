# SPDX-License-Identifier: GPL-2.0-or-later
"""Letters for pictures that Pillow draws: the usual fonts (DejaVu) may be missing, and still everything starts."""

import functools
import subprocess

from PIL import ImageFont

LEAST_PX, WAIT_S = 6, 5.0


@functools.cache
def substitute(name):
    """The file that fontconfig gives instead of a font's file; None without one."""
    family = "monospace" if "Mono" in name else "sans"
    try:
        return subprocess.run(["fc-match", "-f", "%{file}", family], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True, timeout=WAIT_S, check=False).stdout or None
    except (OSError, subprocess.TimeoutExpired):
        return None


def load(name, pixels):
    """The font of a file name ("DejaVuSans.ttf") in this height; another one, at last Pillow's
    own, where it is missing."""
    size = max(LEAST_PX, round(pixels))
    for file in (name, substitute):
        try:
            return ImageFont.truetype(file(name) or "" if callable(file) else file, size)
        except OSError:
            pass
    return ImageFont.load_default()


def drawable(font, text):
    """The text with "?" for letters that the font lacks so much that they cannot be drawn."""
    try:
        font.getbbox(text)
        return text
    except UnicodeEncodeError:          # Pillow's own font
        return text.encode("latin-1", "replace").decode("latin-1")
