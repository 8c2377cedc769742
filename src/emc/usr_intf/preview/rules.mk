# SPDX-License-Identifier: GPL-2.0-or-later
# Python module kerf_raster: pictures of tool paths.
$(eval $(call pymodule,kerf_raster,$(addprefix src/emc/usr_intf/preview/,module.cc raster.cc),,))
