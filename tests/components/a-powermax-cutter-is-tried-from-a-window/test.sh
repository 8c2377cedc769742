#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH" ../../lib/with-display timeout 100 /usr/bin/python3 -B check.py
