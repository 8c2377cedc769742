# SPDX-License-Identifier: GPL-2.0-or-later
from interpreter import INTERP_OK
from kerf import clock


def stall(self, **words):
    if self.task:
        clock.sleep(9)
    return INTERP_OK
