# The INI reader and its command line tools.
PUBLIC_HEADERS += src/emc/ini/inifile.h src/emc/ini/inifile.hh
$(eval $(call library,linuxcncini,1,src/emc/ini/inifile.cc,,))
$(eval $(call program,inivalue,src/emc/ini/inivalue.cc,linuxcncini))
$(eval $(call program,inivar,src/emc/ini/inivar.cc,))
