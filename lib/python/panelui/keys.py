# SPDX-License-Identifier: GPL-2.0-or-later
"""Scan codes of an 8x8 keypad: 0xC0 + key pressed, 0x80 + key released, 0x40 nothing."""

FLAGS, DOWN, UP, NOTHING = 0xC0, 0xC0, 0x80, 0x40
ROLLOVER = 2            # keys at once


class CodeError(Exception):
    """A code that no keypad of this kind sends."""


class Keypad:
    """Which keys are down."""

    def __init__(self):
        self.held = []

    def take(self, code):
        """The change of a code: (row, column, pressed), or None. Raises CodeError."""
        kind, number = code & FLAGS, code & 0x3F
        if kind == NOTHING or code == 0:
            return None
        if code > 0xFF or kind not in (DOWN, UP):
            raise CodeError(f"code 0x{code:02X}: rows and columns 0 to 7, pressed (0xC0) or released "
                            "(0x80), are expected")
        key = number >> 3, number & 7
        if kind == UP:
            if key not in self.held:
                return None
            self.held.remove(key)
            return *key, False
        if key in self.held:
            return None
        if len(self.held) >= ROLLOVER:
            raise CodeError(f"code 0x{code:02X}: more than {ROLLOVER} keys at once, ignored")
        self.held.append(key)
        return *key, True
