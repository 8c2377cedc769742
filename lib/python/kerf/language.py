# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts in the user's language (gettext, domain linuxcnc). scripts/message-strings finds what is given to _ and N_."""

import functools
import gettext

from .tree import Tree


@functools.cache
def catalogue():
    return gettext.translation("linuxcnc", Tree.find().locale, fallback=True)


def _(text):
    """The text in the user's language, as it is where the catalogue lacks it."""
    return catalogue().gettext(text)


def N_(text):
    """Marks a text that is translated where it is used."""
    return text
