# SPDX-License-Identifier: GPL-2.0-or-later
"""M400 holds task up for 9 s."""
import remap  # noqa: F401
