# SPDX-License-Identifier: GPL-2.0-or-later
TASK_FLAGS := -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task
EMC_CLIENT_SOURCES := src/emc/nml/messages.cc src/emc/nml/emc_args.cc
ifneq ($(wildcard src/emc/motion/usr/usrmotintf.c),)
$(eval $(call program,milltask,$(addprefix src/emc/task/,main.cc task.cc task_plan.cc task_execute.cc accept.cc task_canon.cc \
    task_canon_curves.cc motion_link.cc ini_settings.cc io_control.cc user_codes.cc) src/emc/motion/usr/usrmotintf.c src/emc/motion/emcmotutil.c $(EMC_CLIENT_SOURCES), \
    nml linuxcncini rs274 tooldata linuxcnchal,$(TASK_FLAGS)))
endif
$(eval $(call program,linuxcncsvr,src/emc/task/linuxcncsvr.cc $(EMC_CLIENT_SOURCES),nml linuxcncini linuxcnchal,$(TASK_FLAGS)))
