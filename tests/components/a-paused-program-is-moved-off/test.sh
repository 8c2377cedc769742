#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
exec ../../lib/with-display ../../task/lib/machine-test script.py "HAL.HALFILE=mill.hal
HALFILE = LIB:hookup_moveoff.tcl" HAL.HALUI=halui
