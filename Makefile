# SPDX-License-Identifier: GPL-2.0-or-later
# One make for the whole tree. Each folder of src/ says what it builds in its
# rules.mk, with the four macros below; nothing here changes when a part is added.
#
#   make            everything, run in place: bin/ lib/ rtlib/ include/
#   make sanitize   the same with ASan and UBSan, into sanitize/
#   make screenshots pictures of the screens into docs/images
#   make fit-matrix  is there room for every text, on every screen, in every language
#   make bench      measurements (never part of the tests)
#   make fuzz       libFuzzer programs, into objects/fuzz (needs clang)
#   make install DESTDIR=...    the documented installed layout
#   make V=1        shows the commands

.DEFAULT_GOAL := all
.SUFFIXES:
.DELETE_ON_ERROR:
SHELL := /bin/bash

ifeq ($(filter clean distclean sanitize,$(MAKECMDGOALS)),)
include Makefile.inc
else
-include Makefile.inc
endif

# T: root of what is built. SAN: sanitizer flags (set by `make sanitize`).
T ?= .
SAN ?=
O := $(T)/objects
Q := $(if $(V),,@)
say = $(if $(V),,@echo '  $(1)  $(2)')

WARN     := -Wall -Wextra $(WERROR)
INCLUDES := -I$(T)/include -Isrc -Isrc/rtapi -Isrc/hal
DEFINES  := -D_GNU_SOURCE -DKERF_VERSION='"$(VERSION)"'
COMMON   := $(WARN) $(SAN) $(DEFINES) $(INCLUDES) -fPIC -MMD -MP
# Realtime modules: bounded stack frames (sanitizers need more), exact sin/cos pairs, no fast-math.
RTFLAGS  := -DRTAPI -DUSPACE -Drealtime -DSIM -D__MODULE__ $(if $(SAN),,-Wframe-larger-than=2560) \
            -fno-builtin-sin -fno-builtin-cos -fno-builtin-sincos
ULFLAGS  := -DULAPI -DUSPACE -fvisibility=default
RPATH     = -Wl,-rpath,'$$ORIGIN/../lib'

# Compile rules: an object's path says its flavour: objects/ul/... or objects/rt/...
$(O)/ul/%.o: %.c | headers
	$(call say,CC,$<)
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/ul/%.o: %.cc | headers
	$(call say,CXX,$<)
	$(Q)mkdir -p $(@D) && $(CXX) -std=c++17 $(CXXFLAGS) $(COMMON) $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/rt/%.o: %.c | headers
	$(call say,CC,$< (rt))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) $(RTFLAGS) $(EXTRA) -c -o $@ $<
$(O)/rt/%.o: %.cc | headers
	$(call say,CXX,$< (rt))
	$(Q)mkdir -p $(@D) && $(CXX) -std=c++17 $(CXXFLAGS) $(COMMON) $(RTFLAGS) $(EXTRA) -c -o $@ $<
# Generated sources live below objects/gen/.
$(O)/rt/gen/%.o: $(O)/gen/%.c | headers
	$(call say,CC,$< (rt))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) $(RTFLAGS) $(EXTRA) -c -o $@ $<
$(O)/ul/gen/%.o: $(O)/gen/%.c | headers
	$(call say,CC,$<)
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/ul/gen/%.o: $(O)/gen/%.cc | headers
	$(call say,CXX,$<)
	$(Q)mkdir -p $(@D) && $(CXX) -std=c++17 $(CXXFLAGS) $(COMMON) $(ULFLAGS) $(EXTRA) -c -o $@ $<

objs = $(addprefix $(O)/$(1)/,$(addsuffix .o,$(basename $(patsubst $(O)/%,%,$(2)))))

# $(eval $(call program,NAME,SOURCES,LIBS,FLAGS)): bin/NAME. LIBS: names of our
# shared libraries (nml) or linker flags (-lm).
define program
PROGRAMS += $(T)/bin/$(1)
DEPS += $(patsubst %.o,%.d,$(call objs,ul,$(2)))
$(call objs,ul,$(2)): EXTRA += $(4)
$(T)/bin/$(1): $(call objs,ul,$(2)) $(foreach l,$(filter-out -%,$(3)),$(T)/lib/lib$(l).so)
	$$(call say,LINK,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -o $$@ $(call objs,ul,$(2)) -L$(T)/lib $(addprefix -l,$(filter-out -%,$(3))) $(filter -%,$(3)) $$(RPATH)
endef
# $(eval $(call library,NAME,VERSION,SOURCES,LIBS,FLAGS)): lib/libNAME.so.VERSION and its .so link.
define library
LIBRARIES += $(T)/lib/lib$(1).so
LIBRARY_FILES += $(T)/lib/lib$(1).so.$(2)
DEPS += $(patsubst %.o,%.d,$(call objs,ul,$(3)))
$(call objs,ul,$(3)): EXTRA += $(5)
$(T)/lib/lib$(1).so: $(call objs,ul,$(3)) $(foreach l,$(filter-out -%,$(4)),$(T)/lib/lib$(l).so)
	$$(call say,LIB,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -shared -Wl,-soname,lib$(1).so.$(2) -o $$@.$(2) $(call objs,ul,$(3)) -L$(T)/lib $(addprefix -l,$(filter-out -%,$(4))) $(filter -%,$(4)) -Wl,-rpath,'$$$$ORIGIN'
	$$(Q)ln -sf lib$(1).so.$(2) $$@
endef
# $(eval $(call rtmodule,NAME,SOURCES,FLAGS,LIBS)): rtlib/NAME.so; exports what EXPORT_SYMBOL
# and the RTAPI_MP_ macros name (section .rtapi_export), hides the rest.
define rtmodule
RTMODULES += $(T)/rtlib/$(1).so
DEPS += $(patsubst %.o,%.d,$(call objs,rt,$(2)))
$(call objs,rt,$(2)): EXTRA += $(3)
$(T)/rtlib/$(1).so: $(call objs,rt,$(2)) scripts/export-map
	$$(call say,MODULE,$$@)
	$$(Q)mkdir -p $$(@D) $(O)/maps && scripts/export-map $$(OBJCOPY) $(call objs,rt,$(2)) > $(O)/maps/$(1).ver
	$$(Q)$$(CXX) $$(SAN) $$(LDFLAGS) -shared -Wl,-Bsymbolic -Wl,--version-script,$(O)/maps/$(1).ver -o $$@ $(call objs,rt,$(2)) $(4) -lm
endef
# $(eval $(call pymodule,NAME,SOURCES,LIBS,FLAGS)): lib/python/NAME.so (pybind11).
define pymodule
PYMODULES += $(T)/lib/python/$(1).so
DEPS += $(patsubst %.o,%.d,$(call objs,ul,$(2)))
$(call objs,ul,$(2)): EXTRA += $$(PYTHON_CPPFLAGS) $(4)
$(T)/lib/python/$(1).so: $(call objs,ul,$(2)) $(foreach l,$(filter-out -%,$(3)),$(T)/lib/lib$(l).so)
	$$(call say,PYMOD,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -shared -o $$@ $(call objs,ul,$(2)) -L$(T)/lib $(addprefix -l,$(filter-out -%,$(3))) $(filter -%,$(3)) -Wl,-rpath,'$$$$ORIGIN/..' -Wl,-rpath,'$$$$ORIGIN/../..' -Wl,-rpath,'$$$$ORIGIN/../../lib'
endef
# $(eval $(call script,NAME,SOURCE)): bin/NAME, an executable copy of a script.
define script
SCRIPTS += $(T)/bin/$(1)
$(T)/bin/$(1): $(2)
	$$(call say,SCRIPT,$$@)
	$$(Q)mkdir -p $$(@D) && install -m 755 $$< $$@
endef

# Each rules.mk may also add to: PUBLIC_HEADERS (copied to include/), EXTRA_TARGETS,
# BENCHES (targets of `make bench`), MANUAL_PAGES (.comp and .adoc), INSTALL_HOOKS (targets run by `make install`).
RULES := $(sort $(shell find src -name rules.mk)) docs/man/rules.mk
include $(RULES)
include src/hal/test/fuzz.mk

PUBLIC := $(addprefix $(T)/include/,$(notdir $(PUBLIC_HEADERS)))
define public_header
$(T)/include/$(notdir $(1)): $(1)
	@mkdir -p $(T)/include && install -m 644 $$< $$@
endef
$(foreach h,$(PUBLIC_HEADERS),$(eval $(call public_header,$(h))))

.PHONY: all headers programs modules clean distclean sanitize bench install screenshots fit-matrix
screenshots: all
	scripts/screenshots
fit-matrix: all
	scripts/fit-matrix
headers: $(PUBLIC) src/config.h
all: headers $(LIBRARIES) $(PROGRAMS) $(SCRIPTS) $(RTMODULES) $(PYMODULES) $(O)/python/python3 $(EXTRA_TARGETS)

# The Python that our modules are made for, for scripts that take the first one on PATH.
$(O)/python/python3: | Makefile.inc
	$(Q)mkdir -p $(@D) && ln -sfn $(PYTHON) $@

Makefile.inc src/config.h &: configure.ac Makefile.inc.in
	autoreconf -fi
	if [ -x config.status ]; then ./config.status --recheck && ./config.status; else ./configure $(CONFIGURE_FLAGS); fi
	touch Makefile.inc src/config.h

-include $(DEPS)

sanitize:
	$(MAKE) sanitize-links T=sanitize
	$(MAKE) all T=sanitize SAN='-fsanitize=address,undefined -fno-omit-frame-pointer'
sanitize-links:
	@mkdir -p sanitize/lib sanitize/src
	@for d in scripts configs nc_files share tcl tests docs; do ln -sfn ../$$d sanitize/$$d; done
	@ln -sfn ../../lib/hallib sanitize/lib/hallib
	@mkdir -p sanitize/lib/python && for f in lib/python/*; do case $$f in *.so) ;; *) ln -sfn ../../../$$f sanitize/$$f;; esac; done

bench: all $(BENCHES)

include scripts/desktop.mk
include scripts/install.mk

clean:
	rm -rf objects bin rtlib include sanitize docs/build lib/switchkins lib/linuxcnc lib/*.so lib/*.so.* lib/python/*.so
distclean: clean
	rm -rf autom4te.cache build-aux configure config.log config.status Makefile.inc src/config.h src/config.h.in src/config.h.in~ configure~
