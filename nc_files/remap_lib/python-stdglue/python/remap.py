# SPDX-License-Identifier: GPL-2.0-or-later
"""The handlers of this machine's remapped codes: those of the library, and your own."""
from stdglue import *
