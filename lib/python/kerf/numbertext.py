# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers as people type them."""
import re


def with_point(text):
    """The text with a decimal comma made a point ("120,5" is 120.5, never 1205). Anything else stays as it is, so that
    what reads it refuses it: "1.234,5" or "1,234,5" is no number."""
    return re.sub(r"^(\s*[-+]?\d*),(\d+\s*)$", r"\1.\2", text)


def plain(text):
    """The text. ValueError for what Python takes for a number and controller and people do
    not: 1_000, digits of other scripts."""
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return text
