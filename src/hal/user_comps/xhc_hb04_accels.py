#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A program of old configurations: the accelerations of the pendant's jogs are set by LIB:xhc-hb04.tcl now."""
print("xhc-hb04-accels is not needed any more: remove it from the INI file ([APPLICATIONS] or [HAL])")
