#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
. ../../hal/module-tree.sh
CC="${CC:-gcc} -I$EMC2_HOME/src/hal" module_tree stepgen_days.c
/usr/bin/python3 -B check.py
