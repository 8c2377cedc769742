# SPDX-License-Identifier: GPL-2.0-or-later
"""HAL pins and the controller's status as GObjects: see common.hal_glib."""

from common.hal_glib import *  # noqa: F401,F403
