# SPDX-License-Identifier: GPL-2.0-or-later
# Python module gcode: the interpreter for previews.
GCODE_SOURCES := $(addprefix src/emc/pygcode/,module.cc callbacks.cc preview_canon.cc arc_segments.cc program.cc) src/emc/canon/hal_number.cc
$(eval $(call pymodule,gcode,$(GCODE_SOURCES),rs274 tooldata linuxcncini linuxcnchal,))
