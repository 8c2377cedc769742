# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/posemath/,posemath_types.h posemath.h posemath.hh emcpos.h emcpose.h)
POSEMATH_SOURCES := src/emc/posemath/posemath.c src/emc/posemath/emcpose.c
$(eval $(call library,posemath,0,$(POSEMATH_SOURCES),-lm))
