# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/nml/,messages.hh messages.def rcs.hh emc.hh emc_nml.hh nml_oi.hh)
# The messages, for client programs of others: g++ client.cc -llinuxcnc -lnml.
ARCHIVES += $(T)/lib/liblinuxcnc.a
$(T)/lib/liblinuxcnc.a: $(call objs,ul,src/emc/nml/messages.cc)
	$(call say,LIB,$@)
	$(Q)mkdir -p $(@D) && rm -f $@ && $(AR) rcs $@ $^
EXTRA_TARGETS += $(ARCHIVES)

# Documents made from the descriptions: docs/nml-messages.md (tests/docs checks it), Python's stubs.
NML_DESCRIBE_OBJECTS := $(call objs,ul,src/emc/nml/nml_describe.cc src/emc/nml/messages.cc)
$(NML_DESCRIBE_OBJECTS): EXTRA += -Isrc/libnml -Isrc/emc/nml -Isrc/emc/usr_intf/python
$(O)/test/nml-describe: $(NML_DESCRIBE_OBJECTS) $(T)/lib/libnml.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -o $@ $(NML_DESCRIBE_OBJECTS) -L$(T)/lib -lnml -llinuxcnchal -lpthread -Wl,-rpath,'$$ORIGIN/../../lib'
DEPS += $(NML_DESCRIBE_OBJECTS:.o=.d)
$(T)/lib/python/linuxcnc.pyi: src/emc/usr_intf/python/linuxcnc.pyi.in $(O)/test/nml-describe
	$(call say,GEN,$@)
	$(Q)mkdir -p $(@D) && $(O)/test/nml-describe pyi $< > $@
EXTRA_TARGETS += $(O)/test/nml-describe $(T)/lib/python/linuxcnc.pyi
