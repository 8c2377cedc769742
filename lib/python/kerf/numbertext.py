# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers as people type them."""
import re


def with_point(text):
    """The text with a decimal comma made a point ("120,5" is 120.5, never 1205). Anything else stays as it is, so that
    what reads it refuses it: "1.234,5" or "1,234,5" is no number."""
    return re.sub(r"^(\s*[-+]?\d*),(\d+\s*)$", r"\1.\2", text)
