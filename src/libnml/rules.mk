# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/libnml/,linklist.hh nml.hh nml_code.hh nml_config.hh rcs_print.hh sem.hh shm.hh timer.hh)
LIBNML_SOURCES := $(addprefix src/libnml/,nml.cc nml_code.cc nml_config.cc nml_shm.cc nml_tcp.cc nml_server.cc nml_auth.cc rcs_print.cc linklist.cc timer.cc sem.cc shm.cc)
$(eval $(call library,nml,0,$(LIBNML_SOURCES),linuxcnchal -lpthread -lcrypto))

# Test program of tests/nml: objects/test/nml-test CASE.
NML_TEST_OBJECTS := $(call objs,ul,src/libnml/test/nml_test.cc src/emc/nml/messages.cc)
$(NML_TEST_OBJECTS): EXTRA += -Isrc/libnml -Isrc/emc/nml
$(O)/test/nml-test: $(NML_TEST_OBJECTS) $(T)/lib/libnml.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -o $@ $(NML_TEST_OBJECTS) -L$(T)/lib -lnml -llinuxcnchal -lpthread -Wl,-rpath,'$$ORIGIN/../../lib'
NML_CLASSES_OBJECTS := $(call objs,ul,src/libnml/test/classes_test.cc)
$(NML_CLASSES_OBJECTS): EXTRA += -Isrc/libnml
$(O)/test/nml-classes-test: $(NML_CLASSES_OBJECTS) $(T)/lib/libnml.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -o $@ $(NML_CLASSES_OBJECTS) -L$(T)/lib -lnml -llinuxcnchal -lpthread -Wl,-rpath,'$$ORIGIN/../../lib'
DEPS += $(NML_TEST_OBJECTS:.o=.d) $(NML_CLASSES_OBJECTS:.o=.d)
EXTRA_TARGETS += $(O)/test/nml-test $(O)/test/nml-classes-test
