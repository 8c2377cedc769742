#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
../../lib/with-display /usr/bin/python3 -B check.py
rm -rf folder
