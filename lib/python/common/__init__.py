# SPDX-License-Identifier: GPL-2.0-or-later
"""What the graphical user interfaces share."""
