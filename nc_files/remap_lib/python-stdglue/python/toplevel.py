# SPDX-License-Identifier: GPL-2.0-or-later
"""Read once, when the interpreter starts: [PYTHON]TOPLEVEL."""
import remap


def __init__(self):
    """Each interpreter, the one of the preview too (self.task is 0 there)."""
    remap.init_stdglue(self)


def __delete__(self):
    """Before an interpreter goes."""
