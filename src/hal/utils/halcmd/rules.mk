# SPDX-License-Identifier: GPL-2.0-or-later
# halcmd. HALCMD_CORE: all of it but its main(), for other programs that give commands.
HALCMD_DIR := src/hal/utils/halcmd
HALCMD_CORE := $(addprefix $(HALCMD_DIR)/,text.cc session.cc table.cc format.cc config.cc load.cc \
	rtapi_client.cc snapshot.cc show.cc save.cc json.cc graph.cc complete.cc)
$(eval $(call program,halcmd,$(HALCMD_DIR)/main.cc $(HALCMD_CORE),linuxcnchal linuxcncini $(if $(filter yes,$(HAVE_READLINE)),-lreadline)))
