# SPDX-License-Identifier: GPL-2.0-or-later
"""Read once, when the interpreter starts: [PYTHON]TOPLEVEL."""
import remap
