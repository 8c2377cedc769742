# SPDX-License-Identifier: GPL-2.0-or-later
"""G-code previews in Python: canons for gcode.parse, the record of a program, a G-code writer."""
from rs274 import interpret, options
from rs274.interpret import ArcsToSegmentsMixin, PrintCanon, StatMixin, Translated

__all__ = ["ArcsToSegmentsMixin", "PrintCanon", "StatMixin", "Translated", "interpret", "options"]
