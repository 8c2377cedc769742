# SPDX-License-Identifier: GPL-2.0-or-later
# Python module kerf_raster: pictures of tool paths, and paths made ready for OpenGL.
$(eval $(call pymodule,kerf_raster,$(addprefix src/emc/usr_intf/preview/,module.cc raster.cc drawing.cc drawing_module.cc),,))
# Python module kerf_glx: OpenGL in a widget. Screens draw in memory where it is not there.
ifeq ($(HAVE_GL),yes)
$(eval $(call pymodule,kerf_glx,src/emc/usr_intf/preview/glx_window.cc,$(GL_LIBS),$(GL_CFLAGS)))
endif
