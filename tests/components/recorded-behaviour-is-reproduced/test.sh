#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# 160 components on random inputs, two runs each, cycle by cycle.
/usr/bin/python3 -B ../replay.py recordings.tar.xz
