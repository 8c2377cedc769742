# SPDX-License-Identifier: GPL-2.0-or-later
"""Finds tests of a probe's success that cannot fail: G38.2 and G38.4 end the program where there is no contact."""

import re

PROBE = re.compile(r"G0*38\.([2-5])")
TEST = re.compile(r"(IF|WHILE|ELSEIF)\[.*#5070(?!\d)")


def dead_tests(text):
    """[(line, code)]: branches on #5070 whose last probe move before, in the same sub, was G38.2 or G38.4."""
    found, code = [], None
    for number, line in enumerate(text.splitlines(), 1):
        words = re.sub(r"\([^)]*\)|;.*|\s", "", line).upper()
        if TEST.search(words) and code in ("2", "4"):
            found.append((number, f"G38.{code}"))
        if re.match(r"O.+?SUB$", words):
            code = None
        if probes := PROBE.findall(words):
            code = probes[-1]
    return found
