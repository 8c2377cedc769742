# SPDX-License-Identifier: GPL-2.0-or-later
"""python3 -m halcompile: the same as the command halcompile."""
import sys

from .cli import main

sys.exit(main(sys.argv[1:]))
