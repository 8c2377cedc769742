# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows of the small programs: halshow, halmeter, emccalib, tooledit and others.

Each program has a model without Tk and a window on it; `main(arguments)` returns the exit status.
"""
