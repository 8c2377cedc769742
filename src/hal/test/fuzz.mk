# SPDX-License-Identifier: GPL-2.0-or-later
# Fuzzing. A target NAME is a set of sources with LLVMFuzzerTestOneInput() among them:
#   objects/test/NAME-fuzz FILE...   runs the files of a corpus (tests/fuzz/NAME), any compiler
#   make fuzz                        libFuzzer programs objects/fuzz/NAME-fuzz (clang): docs/testing.md
# FUZZ_SANITIZERS=undefined: many runs in little time (a build of its own: make FUZZ_DIR=fuzz-fast ...).
FUZZ_SANITIZERS ?= address,undefined
FUZZ_DIR ?= fuzz
FUZZ_PARTS := $(HALCMD_CORE) $(INIFILE_SOURCES) $(HAL_SOURCES) src/hal/hal_query.c $(RTAPI_ULAPI_SOURCES)
FUZZ_halcmd := src/hal/utils/halcmd/fuzz.cc $(FUZZ_PARTS)
FUZZ_parsers := $(addprefix src/hal/test/,fuzz_parsers.cc fuzz_stream.c) $(addprefix src/hal/utils/halrmt/,server.cc \
    commands.cc) src/hal/stream/halstream_main.c $(filter-out src/emc/ini/inifile.cc,$(FUZZ_PARTS))
FUZZ_host := src/hal/test/fuzz_host.c $(filter-out %/host_main.c %/host_module.c,$(RTAPI_HOST_SOURCES))
FUZZ_rs274 := src/emc/rs274ngc/rs274_fuzz.cc $(RS274_SOURCES) $(TOOLDATA_SOURCES) $(INIFILE_SOURCES)
FUZZ_FLAVOUR_halcmd := ul
FUZZ_FLAVOUR_parsers := ul
FUZZ_FLAVOUR_rs274 := ul
FUZZ_LIBS_rs274 := -lcrypto
FUZZ_FLAVOUR_host := host
FUZZ_CFLAGS := -g -O1 -fsanitize=fuzzer-no-link,$(FUZZ_SANITIZERS) -fno-sanitize-recover=undefined

$(O)/$(FUZZ_DIR)/ul/%.o: %.c | headers
	$(call say,CLANG,$<)
	$(Q)mkdir -p $(@D) && clang -std=gnu11 $(FUZZ_CFLAGS) $(DEFINES) $(INCLUDES) -MMD -MP $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/$(FUZZ_DIR)/ul/%.o: %.cc | headers
	$(call say,CLANG,$<)
	$(Q)mkdir -p $(@D) && clang++ -std=c++17 $(FUZZ_CFLAGS) $(DEFINES) $(INCLUDES) -MMD -MP $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/$(FUZZ_DIR)/host/%.o: %.c | headers
	$(call say,CLANG,$< (host))
	$(Q)mkdir -p $(@D) && clang -std=gnu11 $(FUZZ_CFLAGS) $(DEFINES) $(INCLUDES) -MMD -MP -DRTAPI -DUSPACE $(EXTRA) -c -o $@ $<
$(call objs,$(FUZZ_DIR)/ul,$(FUZZ_rs274)): EXTRA += -O2 -fno-sanitize-coverage=trace-cmp -fsanitize=float-cast-overflow -fno-sanitize-recover=float-cast-overflow
$(foreach f,$(FUZZ_DIR)/ul ul,$(call objs,$(f),src/emc/rs274ngc/rs274_fuzz.cc)): EXTRA += -Isrc/emc/rs274ngc
$(foreach f,ul host,$(call objs,$(FUZZ_DIR)/$(f),src/rtapi/kerf_paths.c)): EXTRA += -DKERF_MODULE_DIR='"$(KERF_MODULE_DIR)"'

define fuzz_target
FUZZ_OBJECTS_$(1) := $(call objs,$(FUZZ_FLAVOUR_$(1)),$(FUZZ_$(1))) $(call objs,ul,src/hal/test/fuzz_main.c)
DEPS += $$(FUZZ_OBJECTS_$(1):.o=.d)
$(O)/test/$(1)-fuzz: $$(FUZZ_OBJECTS_$(1))
	$$(call say,LINK,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -rdynamic -o $$@ $$^ -ldl -lpthread -lm $(FUZZ_LIBS_$(1))
EXTRA_TARGETS += $(O)/test/$(1)-fuzz
$(O)/$(FUZZ_DIR)/$(1)-fuzz: $(call objs,$(FUZZ_DIR)/$(FUZZ_FLAVOUR_$(1)),$(FUZZ_$(1)))
	$$(call say,LINK,$$@)
	$$(Q)clang++ -g -fsanitize=fuzzer,$(FUZZ_SANITIZERS) -rdynamic -o $$@ $$^ -ldl -lpthread -lm $(FUZZ_LIBS_$(1))
DEPS += $(patsubst %.o,%.d,$(call objs,$(FUZZ_DIR)/$(FUZZ_FLAVOUR_$(1)),$(FUZZ_$(1))))
fuzz: $(O)/$(FUZZ_DIR)/$(1)-fuzz
endef
.PHONY: fuzz
$(foreach t,halcmd parsers host rs274,$(eval $(call fuzz_target,$(t))))
