# SPDX-License-Identifier: GPL-2.0-or-later
include src/rtapi/sources.mk

PUBLIC_HEADERS += $(addprefix src/rtapi/,rtapi.h rtapi_app.h rtapi_atomic.h rtapi_bitops.h \
    rtapi_bool.h rtapi_byteorder.h rtapi_ctype.h rtapi_device.h rtapi_errno.h rtapi_firmware.h \
    rtapi_gfp.h rtapi_io.h rtapi_limits.h rtapi_list.h rtapi_math.h rtapi_math_i386.h \
    rtapi_math64.h rtapi_mutex.h rtapi_parport.h rtapi_pci.h rtapi_slab.h rtapi_stdint.h \
    rtapi_string.h rtapi_vsnprintf.h linuxcnc.h kerf_clock.h kerf_instance.h kerf_paths.h)

# Installed modules: below the prefix wherever that is, or at an absolute place.
KERF_MODULE_DIR := $(if $(filter $(prefix)/%,$(moduledir)),$(patsubst $(prefix)%,%,$(moduledir)),=$(moduledir))
KERF_PATHS_OBJECTS := $(foreach f,ul host tsan,$(call objs,$(f),src/rtapi/kerf_paths.c))
$(KERF_PATHS_OBJECTS): EXTRA += -DKERF_MODULE_DIR='"$(KERF_MODULE_DIR)"'

# The realtime host. Its parts are compiled with RTAPI defined (objects/host). What it offers to
# modules is listed in host.exports. It must not link liblinuxcnchal: modules bring HAL's names.
RTAPI_HOST_SOURCES := $(addprefix src/rtapi/,kerf_instance.c kerf_paths.c kerf_clock.c kerf_vclock.c rtapi_common.c \
    rtapi_shmem.c $(addprefix host/,host_main.c host_module.c host_task.c host_posix.c host_virtual.c host_rt.c \
    host_msg.c host_device.c))
# The EVL core of Xenomai 4, where configure found its headers.
ifeq ($(HAVE_EVL),yes)
RTAPI_HOST_SOURCES += src/rtapi/host/host_evl.c
RTAPI_HOST_LIBS := -levl
$(call objs,host,$(RTAPI_HOST_SOURCES)): EXTRA += -DKERF_EVL
endif
RTAPI_HOST_OBJECTS := $(call objs,host,$(RTAPI_HOST_SOURCES))
DEPS += $(RTAPI_HOST_OBJECTS:.o=.d)
$(O)/host/%.o: %.c | headers
	$(call say,CC,$< (host))
	$(Q)mkdir -p $(@D) && $(CC) -std=gnu11 $(CFLAGS) $(COMMON) -DRTAPI -DUSPACE $(EXTRA) -c -o $@ $<
PROGRAMS += $(T)/bin/rtapi_app
$(T)/bin/rtapi_app: $(RTAPI_HOST_OBJECTS) src/rtapi/host/host.exports
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -Wl,--dynamic-list=src/rtapi/host/host.exports -o $@ \
	    $(RTAPI_HOST_OBJECTS) $(RTAPI_HOST_LIBS) -ldl -lpthread -lm

# Rights for realtime: capabilities (preferred) or a setuid program. Run by root after the build.
.PHONY: setcap setuid
setcap: $(T)/bin/rtapi_app
	chmod 755 $<
	setcap cap_ipc_lock,cap_net_admin,cap_sys_rawio,cap_sys_nice+ep $<
setuid: $(T)/bin/rtapi_app
	chown root $<
	chmod 4750 $<

$(eval $(call pymodule,kerf_clock,src/rtapi/python/kerf_clock.cc,linuxcnchal))
$(eval $(call program,kerf-clock,src/rtapi/kerf-clock.c,linuxcnchal))

# Test program of tests/rtapi: objects/test/clock-test CASE.
$(O)/test/clock-test: $(call objs,ul,src/rtapi/test/clock_test.c) $(T)/lib/liblinuxcnchal.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CC) $(SAN) $(LDFLAGS) -o $@ $< -L$(T)/lib -llinuxcnchal -lpthread -Wl,-rpath,'$$ORIGIN/../../lib'
DEPS += $(patsubst %.o,%.d,$(call objs,ul,src/rtapi/test/clock_test.c))
EXTRA_TARGETS += $(O)/test/clock-test
