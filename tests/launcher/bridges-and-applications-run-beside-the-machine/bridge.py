#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
import signal
import sys

import hal

component = hal.component("bridge")
component.newpin("arguments", hal.HAL_S32, hal.HAL_OUT)
component["arguments"] = len(sys.argv) - 1
component.ready()
signal.pause()
