# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/motion/,emcmotcfg.h motion_types.h state_tag.h simple_tp.h \
    motion.h emcmotutil.h homing.h usr/usrmotintf.h) src/emc/tp/tp_types.h src/emc/tp/tp.h
