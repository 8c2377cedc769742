#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The program pyvcp on a low screen: every widget can be reached by wheel, scroll bar and keyboard.
../../lib/with-display 500x400 /usr/bin/python3 -B check.py
