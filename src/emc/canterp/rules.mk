# SPDX-License-Identifier: GPL-2.0-or-later
# canterp.so: an interpreter of canonical calls, for [TASK]INTERPRETER and rs274 -p.
CANTERP_SOURCES := $(wildcard src/emc/canterp/*.cc)
DEPS += $(patsubst %.o,%.d,$(call objs,ul,$(CANTERP_SOURCES)))
$(call objs,ul,$(CANTERP_SOURCES)): EXTRA += -Isrc/emc/rs274ngc
INTERPRETERS += $(T)/lib/linuxcnc/canterp.so
EXTRA_TARGETS += $(T)/lib/linuxcnc/canterp.so
$(T)/lib/linuxcnc/canterp.so: $(call objs,ul,$(CANTERP_SOURCES)) $(T)/lib/librs274.so
	$(call say,LIB,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -shared -o $@ $(filter %.o,$^) -L$(T)/lib -lrs274 -ltooldata -llinuxcncini -Wl,-rpath,'$$ORIGIN/..'
