# The INI reader and its command line tools.
PUBLIC_HEADERS += src/emc/ini/inifile.h src/emc/ini/inifile.hh src/emc/ini/replace_file.hh
INIFILE_SOURCES := $(addprefix src/emc/ini/,inifile.cc replace_file.cc)
$(eval $(call library,linuxcncini,1,$(INIFILE_SOURCES),,))
$(eval $(call program,inivalue,src/emc/ini/inivalue.cc,linuxcncini))
$(eval $(call program,inivar,src/emc/ini/inivar.cc,))
