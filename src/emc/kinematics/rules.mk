# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/kinematics/,kinematics.h switchkins.h)
KINS_UTIL := src/emc/kinematics/kins_util.c src/emc/posemath/posemath.c src/emc/posemath/emcpose.c
$(eval $(call rtmodule,trivkins,src/emc/kinematics/trivkins.c $(KINS_UTIL)))
