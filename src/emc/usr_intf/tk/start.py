#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Starts the window program of this file's name: kerf.tktools.NAME."""
import importlib
import sys
from pathlib import Path

here = Path(__file__).resolve()
if (here.parents[1] / "lib/python/kerf").is_dir():
    sys.path.insert(0, str(here.parents[1] / "lib/python"))
try:
    sys.exit(importlib.import_module(f"kerf.tktools.{here.name.replace('-', '_')}").main(sys.argv[1:]))
except KeyboardInterrupt:
    sys.exit(0)
