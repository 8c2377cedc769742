# SPDX-License-Identifier: GPL-2.0-or-later
# The interpreter and its command line driver.
PUBLIC_HEADERS += src/emc/rs274ngc/interp.hh src/emc/rs274ngc/program_copy.hh
RS274_SOURCES := $(filter-out src/emc/rs274ngc/rs274_%,$(wildcard src/emc/rs274ngc/*.cc)) src/emc/canon/canon.cc src/rtapi/kerf_paths.c
$(eval $(call library,rs274,0,$(RS274_SOURCES),linuxcncini tooldata -ldl -lcrypto,-Isrc/emc/rs274ngc))
$(eval $(call program,rs274,src/emc/rs274ngc/rs274_main.cc src/emc/canon/printer.cc,rs274 tooldata linuxcncini -ldl $(if $(filter yes,$(HAVE_READLINE)),-lreadline),-Isrc/emc/canon))
# Python inside the interpreter; loaded only when an INI asks for it.
PYPLUGIN_SOURCES := $(wildcard src/emc/rs274ngc/pyplugin/*.cc)
$(eval $(call library,pyplugin,0,$(PYPLUGIN_SOURCES),rs274 tooldata linuxcncini $(PYTHON_LIBS),-Isrc/emc/rs274ngc $(PYTHON_CPPFLAGS)))
# Unit tests, run by tests/rs274/unit-tests-of-the-interpreter: objects/test/interp-NAME of rs274_NAME.cc.
define interp_test
$(call objs,ul,src/emc/rs274ngc/rs274_$(1).cc): EXTRA += -Isrc/emc/rs274ngc
DEPS += $(patsubst %.o,%.d,$(call objs,ul,src/emc/rs274ngc/rs274_$(1).cc))
EXTRA_TARGETS += $(O)/test/interp-$(1)
$(O)/test/interp-$(1): $(call objs,ul,src/emc/rs274ngc/rs274_$(1).cc) $(T)/lib/librs274.so
	$$(call say,LINK,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -o $$@ $$< -L$(T)/lib -lrs274 -ltooldata -llinuxcncini -Wl,-rpath,'$$$$ORIGIN/../../lib'
endef
$(foreach t,unit stages,$(eval $(call interp_test,$(t))))
# Measurements, part of `make bench`.
.PHONY: bench-rs274
bench-rs274: all
	PATH=$(abspath $(T)/bin):$$PATH PYTHONPATH=$(abspath $(T)/lib/python) /usr/bin/python3 src/emc/rs274ngc/rs274-bench.py
BENCHES += bench-rs274
