# SPDX-License-Identifier: GPL-2.0-or-later
# Tool data: the shared store, the tool table file, the database program.
PUBLIC_HEADERS += src/emc/tool/tooldata.h
TOOLDATA_SOURCES := $(addprefix src/emc/tool/,toolstore.cc toolfile.cc tooltext.cc tooldb.cc)
$(eval $(call library,tooldata,0,$(TOOLDATA_SOURCES),linuxcncini))
$(eval $(call program,tool_mmap_read,src/emc/tool/tool_mmap_read.cc,tooldata linuxcncini,))
$(eval $(call pymodule,kerf_tooltext,src/emc/tool/tooltext_module.cc,tooldata linuxcncini,))
