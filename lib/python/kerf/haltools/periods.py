# SPDX-License-Identifier: GPL-2.0-or-later
"""Thread periods as people write them."""

import re

UNITS_NS = {"s": 1e9, "ms": 1e6, "us": 1e3, "µs": 1e3, "μs": 1e3, "ns": 1}


def period_ns(text: str) -> int:
    """Nanoseconds of '25us', '1ms', '25000' (ns), '25' (below 1000: us); '-' is 0: no thread.

    Raises ValueError with the text and what was expected.
    """
    if text == "-":
        return 0
    match = re.fullmatch(r"([0-9]*\.?[0-9]+)(s|ms|us|µs|μs|ns)?", text)
    if not match:
        raise ValueError(f"'{text}' is not a period: expected a number with s, ms, us or ns, or -")
    number, unit = float(match[1]), match[2]
    if unit is None:
        unit = "us" if number < 1000 else "ns"
    return round(number * UNITS_NS[unit])


def two_periods(words: list[str], base_ns: int = 25000, servo_ns: int = 1000000) -> tuple[int, int]:
    """Base and servo period of a command line: none, SERVO, or BASE SERVO. 0: no such thread."""
    if len(words) > 2:
        raise ValueError("at most two periods may be given")
    if len(words) == 1:
        base_ns, servo_ns = 0, period_ns(words[0])
    elif words:
        base_ns, servo_ns = period_ns(words[0]), period_ns(words[1])
    if base_ns > servo_ns > 0:
        base_ns, servo_ns = servo_ns, base_ns
    if base_ns == servo_ns or servo_ns == 0:
        base_ns, servo_ns = 0, base_ns or servo_ns
    if servo_ns <= 0:
        raise ValueError("a period must be greater than 0")
    return base_ns, servo_ns
