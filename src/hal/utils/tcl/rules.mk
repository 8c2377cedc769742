# SPDX-License-Identifier: GPL-2.0-or-later
# Tcl packages Hal and Linuxcnc: binary parts beside the scripts in tcl/. A sanitized library
# cannot be loaded by the system's tclsh, so `make sanitize` leaves them out.
ifeq ($(HAVE_TCL)-$(T),yes-.)
HAL_TCL_OBJS := $(call objs,ul,src/hal/utils/tcl/hal_tcl.cc $(addprefix src/hal/utils/halcmd/,text.cc session.cc \
	table.cc format.cc config.cc load.cc rtapi_client.cc snapshot.cc show.cc save.cc json.cc graph.cc))
INI_TCL_OBJS := $(call objs,ul,src/hal/utils/tcl/ini_tcl.cc src/emc/usr_intf/tcl/emc_tcl.cc src/emc/usr_intf/client.cc src/emc/nml/messages.cc src/emc/nml/emc_args.cc)
$(INI_TCL_OBJS): EXTRA += -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task -Isrc/emc/usr_intf -Isrc/emc/usr_intf/tcl
DEPS += $(patsubst %.o,%.d,$(HAL_TCL_OBJS) $(INI_TCL_OBJS))
$(HAL_TCL_OBJS) $(INI_TCL_OBJS): EXTRA += $(TCL_CFLAGS) -DUSE_TCL_STUBS
EXTRA_TARGETS += tcl/hal.so tcl/linuxcnc.so
TCL_STUB := $(filter -ltclstub%,$(TCL_LIBS))
TCL_LINK = $(CXX) $(LDFLAGS) -shared -o $@ $^ -Llib $(TCL_STUB) -Wl,-rpath,'$$ORIGIN/../lib' -Wl,-rpath,'$$ORIGIN/../../../lib'
tcl/hal.so: $(HAL_TCL_OBJS) lib/liblinuxcnchal.so lib/liblinuxcncini.so
	$(call say,LIB,$@)
	$(Q)$(TCL_LINK)
tcl/linuxcnc.so: $(INI_TCL_OBJS) lib/liblinuxcncini.so lib/libnml.so lib/liblinuxcnchal.so
	$(call say,LIB,$@)
	$(Q)$(TCL_LINK)
endif
