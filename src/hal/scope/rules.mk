# SPDX-License-Identifier: GPL-2.0-or-later
# The oscilloscope: its realtime part and the Python module that the screen
# (lib/python/kerf/halscope) reaches it by.
$(eval $(call rtmodule,scope_rt,src/hal/scope/scope_rt.c))
$(eval $(call pymodule,kerf_scope,src/hal/scope/scope_py.cc,linuxcnchal))
$(eval $(call script,halscope,src/hal/scope/halscope))
