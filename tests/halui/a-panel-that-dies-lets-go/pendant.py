#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A pendant whose buttons are pressed as soon as the file "press" is there, until it ends."""
import signal
import sys
import time
from pathlib import Path

import hal

signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
panel = hal.component("pendant")
panel.newpin("button", hal.HAL_BIT, hal.HAL_OUT)
panel.newpin("stick", hal.HAL_FLOAT, hal.HAL_OUT)
panel.newpin("lamp", hal.HAL_BIT, hal.HAL_OUT)
panel.ready()
while True:
    if Path("press").exists() and not panel["button"]:
        panel["button"] = panel["lamp"] = True
        panel["stick"] = 0.9
    time.sleep(0.01)
