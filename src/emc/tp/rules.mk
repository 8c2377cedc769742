# SPDX-License-Identifier: GPL-2.0-or-later
TP_SOURCES := $(addprefix src/emc/tp/,path.c traj.c tp.c)
$(eval $(call rtmodule,tpmod,src/emc/tp/module.c $(TP_SOURCES)))
