# SPDX-License-Identifier: GPL-2.0-or-later
TASK_FLAGS := -Isrc/libnml -Isrc/emc/nml -Isrc/emc/task
EMC_CLIENT_SOURCES := src/emc/nml/messages.cc src/emc/nml/emc_args.cc
$(eval $(call program,milltask,$(addprefix src/emc/task/,main.cc task.cc task_plan.cc task_execute.cc task_restore.cc dry_run.cc accept.cc control.cc jog_owners.cc journal.cc task_canon.cc \
    task_canon_curves.cc motion_link.cc ini_settings.cc io_control.cc user_codes.cc fault_stop.cc) src/emc/canon/hal_number.cc src/emc/motion/usr/usrmotintf.c src/emc/motion/emcmotutil.c $(EMC_CLIENT_SOURCES), \
    nml linuxcncini rs274 tooldata linuxcnchal,$(TASK_FLAGS)))
$(eval $(call program,linuxcncsvr,src/emc/task/linuxcncsvr.cc $(EMC_CLIENT_SOURCES),nml linuxcncini linuxcnchal,$(TASK_FLAGS)))
$(eval $(call program,kerf-safe-stop,src/emc/task/safe_stop.cc src/emc/motion/usr/usrmotintf.c src/emc/motion/emcmotutil.c $(EMC_CLIENT_SOURCES),nml linuxcncini linuxcnchal,$(TASK_FLAGS)))

# Test programs of tests/task: objects/test/task-NAME.
define task_test
TASK_TEST_OBJECTS_$(1) := $(call objs,ul,src/emc/task/test/$(1).cc src/emc/usr_intf/client.cc src/emc/nml/messages.cc)
$(call objs,ul,src/emc/task/test/$(1).cc): EXTRA += $(TASK_FLAGS) -Isrc/emc/usr_intf
$(O)/test/task-$(1): $$(TASK_TEST_OBJECTS_$(1)) $(T)/lib/libnml.so $(T)/lib/liblinuxcnchal.so
	$$(call say,LINK,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CXX) $$(SAN) $$(LDFLAGS) -o $$@ $$(TASK_TEST_OBJECTS_$(1)) -L$(T)/lib -lnml -llinuxcnchal -Wl,-rpath,'$$$$ORIGIN/../../lib'
DEPS += $(patsubst %.o,%.d,$(call objs,ul,src/emc/task/test/$(1).cc))
EXTRA_TARGETS += $(O)/test/task-$(1)
endef
$(eval $(call task_test,command_table))

# FP-135 in full: LINES lines (ten million) executed in virtual time; lines a second, CPU and memory by the way in REPORT.
# Five minutes on an idle machine, hours on a busy one: not among the benches of every day.
.PHONY: bench-long-program
bench-long-program: all
	bash -c '. scripts/rip-environment && cd src/emc/task/bench && LINES=$(or $(LINES),10000000) \
	    REPORT=$(abspath $(or $(REPORT),$(O)/long-program.txt)) MACHINE_TEST_S=360000 KERF_INSTANCE=longprogram \
	    nice -n 19 ../../../../tests/task/lib/machine-test long_program_bench.py TASK.CYCLE_TIME=0.05'; status=$$?; \
	    cat $(or $(REPORT),$(O)/long-program.txt); exit $$status
