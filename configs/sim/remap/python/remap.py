# SPDX-License-Identifier: GPL-2.0-or-later
"""The handlers of this machine's own codes: those of stdglue, and M454."""
import emccanon
from interpreter import INTERP_EXECUTE_FINISH, INTERP_OK
from stdglue import *


def m454(self, **words):
    """M454 P<job> [Q<piece>]: waits until the machine stands, then tells the operator.

    The preview runs the same handler; self.task tells the two apart.
    """
    yield INTERP_EXECUTE_FINISH
    if self.task:
        piece = f", piece {int(words['q'])}" if "q" in words else ""
        emccanon.MESSAGE(f"job {int(words['p'])}{piece}: tool {self.current_tool} done")
    yield INTERP_OK
