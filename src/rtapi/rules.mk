# SPDX-License-Identifier: GPL-2.0-or-later
include src/rtapi/sources.mk

PUBLIC_HEADERS += $(addprefix src/rtapi/,rtapi.h rtapi_app.h rtapi_atomic.h rtapi_bitops.h \
    rtapi_bool.h rtapi_byteorder.h rtapi_ctype.h rtapi_device.h rtapi_errno.h rtapi_firmware.h \
    rtapi_gfp.h rtapi_io.h rtapi_limits.h rtapi_list.h rtapi_math.h rtapi_math_i386.h \
    rtapi_math64.h rtapi_mutex.h rtapi_parport.h rtapi_pci.h rtapi_slab.h rtapi_stdint.h \
    rtapi_string.h rtapi_vsnprintf.h kerf_clock.h kerf_instance.h kerf_paths.h)

# The realtime host. Its RTAPI objects are exported to the modules it loads.
RTAPI_HOST_SOURCES := $(addprefix src/rtapi/,kerf_instance.c kerf_paths.c kerf_clock.c kerf_vclock.c rtapi_common.c \
    rtapi_shmem.c host/host_tasks.c host/host_setup.c host/rtapi_app.cc)
RTAPI_HOST_OBJECTS := $(call objs,host,$(RTAPI_HOST_SOURCES))
DEPS += $(RTAPI_HOST_OBJECTS:.o=.d)
$(O)/host/%.o: %.c | headers
	$(call say,CC,$< (host))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) -DRTAPI -DUSPACE -c -o $@ $<
$(O)/host/%.o: %.cc | headers
	$(call say,CXX,$< (host))
	$(Q)mkdir -p $(@D) && $(CXX) -std=c++17 $(CXXFLAGS) $(COMMON) -DRTAPI -DUSPACE -c -o $@ $<
PROGRAMS += $(T)/bin/rtapi_app
$(T)/bin/rtapi_app: $(RTAPI_HOST_OBJECTS)
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -rdynamic -o $@ $^ -ldl -lpthread

$(eval $(call pymodule,kerf_clock,src/rtapi/python/kerf_clock.cc,linuxcnchal))
$(eval $(call program,kerf-clock,src/rtapi/kerf-clock.c,linuxcnchal))
