# SPDX-License-Identifier: GPL-2.0-or-later
import remap


def __init__(self):
    remap.init_stdglue(self)
    remap.build_hal(self)
