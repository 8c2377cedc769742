# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += src/hal/hal.h src/hal/hostmot2-serial.h

include src/rtapi/sources.mk
HAL_SOURCES := $(addprefix src/hal/,hal_segment.c hal_index.c hal_recover.c hal_comp.c hal_pin.c \
    hal_signal.c hal_thread.c hal_port.c hal_stream.c)

$(eval $(call library,linuxcnchal,0,$(HAL_SOURCES) src/hal/hal_query.c $(RTAPI_ULAPI_SOURCES),-lpthread))
$(eval $(call rtmodule,hal_lib,$(HAL_SOURCES) src/hal/hal_lib.c))
$(eval $(call rtmodule,threads,src/hal/threads.c))

$(eval $(call rtmodule,sampler,src/hal/stream/sampler.c))
$(eval $(call rtmodule,streamer,src/hal/stream/streamer.c))
HALSTREAM_MAIN := src/hal/stream/halstream_main.c
$(eval $(call program,halsampler,src/hal/stream/halsampler.c $(HALSTREAM_MAIN),linuxcnchal))
$(eval $(call program,halstreamer,src/hal/stream/halstreamer.c $(HALSTREAM_MAIN),linuxcnchal))

$(eval $(call pymodule,_hal,$(addprefix src/hal/python/,_hal.cc component.cc query.cc stream.cc values.cc),linuxcnchal))

# Test program of tests/hal: the library, compiled so that a process can be made to die
# before any store (src/hal/test/stores.h), and what looks into its database.
HAL_ROBUST := $(addprefix src/hal/test/,hal_robust.c hal_check.c) $(HAL_SOURCES) src/hal/hal_query.c
HAL_ROBUST_OBJECTS := $(call objs,stores,$(HAL_ROBUST)) $(call objs,ul,src/hal/test/stores.c $(RTAPI_ULAPI_SOURCES))
$(O)/stores/%.o: %.c | headers
	$(call say,CC,$< (stores))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) -fsanitize=thread $(WARN) -Wno-tsan $(DEFINES) $(INCLUDES) -MMD -MP $(ULFLAGS) -c -o $@ $<
$(O)/test/hal-robust: $(HAL_ROBUST_OBJECTS)
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CC) $(SAN) $(LDFLAGS) -Wl,--wrap=memset,--wrap=memcpy,--wrap=strcpy -o $@ $^ -lpthread
DEPS += $(HAL_ROBUST_OBJECTS:.o=.d)
# It stands in for the runtime of ThreadSanitizer: no other sanitizer may know those names.
$(call objs,ul,src/hal/test/stores.c): EXTRA += -fno-sanitize=all
EXTRA_TARGETS += $(O)/test/hal-robust

# Test program of tests/hal, through the library as anybody uses it.
HAL_API_OBJECTS := $(call objs,ul,src/hal/test/hal_api.c)
$(O)/test/hal-api: $(HAL_API_OBJECTS) $(T)/lib/liblinuxcnchal.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CC) $(SAN) $(LDFLAGS) -o $@ $(HAL_API_OBJECTS) -L$(T)/lib -llinuxcnchal -lpthread -Wl,-rpath,'$$ORIGIN/../../lib'
DEPS += $(HAL_API_OBJECTS:.o=.d)
EXTRA_TARGETS += $(O)/test/hal-api

# Measurements, part of `make bench`.
HAL_BENCH_OBJECTS := $(call objs,ul,src/hal/test/hal_bench.c)
DEPS += $(HAL_BENCH_OBJECTS:.o=.d)
$(O)/test/hal-bench: $(HAL_BENCH_OBJECTS) $(T)/lib/liblinuxcnchal.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CC) $(SAN) $(LDFLAGS) -o $@ $(HAL_BENCH_OBJECTS) -L$(T)/lib -llinuxcnchal -Wl,-rpath,'$$ORIGIN/../../lib'
.PHONY: bench-hal
bench-hal: $(O)/test/hal-bench
	/usr/bin/python3 src/hal/test/hal-bench.py $(T)
.PHONY: bench-components
bench-components:
	/usr/bin/python3 src/hal/test/comp-bench.py $(T)
BENCHES += bench-hal bench-components

# The library under ThreadSanitizer (not in `make sanitize`, which is AddressSanitizer).
HAL_TSAN := src/hal/test/hal_tsan.c $(HAL_SOURCES) src/hal/hal_query.c $(RTAPI_ULAPI_SOURCES)
HAL_TSAN_OBJECTS := $(call objs,tsan,$(HAL_TSAN))
$(O)/tsan/%.o: %.c | headers
	$(call say,CC,$< (tsan))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) -O1 -fsanitize=thread -Wno-tsan $(WARN) $(DEFINES) $(INCLUDES) -MMD -MP $(ULFLAGS) $(EXTRA) -c -o $@ $<
$(O)/test/hal-tsan: $(HAL_TSAN_OBJECTS)
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CC) -fsanitize=thread $(LDFLAGS) -o $@ $^ -lpthread
DEPS += $(HAL_TSAN_OBJECTS:.o=.d)
EXTRA_TARGETS += $(O)/test/hal-tsan
