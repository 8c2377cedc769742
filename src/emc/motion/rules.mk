# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/motion/,emcmotcfg.h motion_types.h state_tag.h simple_tp.h \
    motion.h emcmotutil.h homing.h homing.c homing_joint.c homing_priv.h homing_custom.h usr/usrmotintf.h) src/emc/tp/tp_types.h src/emc/tp/tp.h

MOTMOD_SOURCES := $(addprefix src/emc/motion/,motion.c state.c pins.c report.c command.c command_move.c command_spindle.c command_jog.c command_joint.c range.c cycle.c mode.c \
    position.c axis.c eoffset.c offset_share.c teleop_scale.c jog.c input.c probe.c spindle.c comp.c io.c output.c override.c simple_tp.c cubic.c emcmotutil.c)
$(eval $(call rtmodule,motmod,$(MOTMOD_SOURCES) src/emc/posemath/emcpose.c src/emc/tp/path.c))
$(eval $(call rtmodule,homemod,$(addprefix src/emc/motion/,homemod.c homing.c homing_joint.c)))
$(eval $(call rtmodule,limitcheck,src/emc/motion/limitcheck.c))

# The user-space side of the shared segment, for programs that talk to motmod.
USRMOT_SOURCES := src/emc/motion/usr/usrmotintf.c src/emc/motion/emcmotutil.c
$(eval $(call pymodule,kerf_motion,src/emc/motion/usr/kerf_motion.cc $(USRMOT_SOURCES) src/emc/posemath/emcpose.c,linuxcnchal))
$(eval $(call program,motion-logger,src/emc/motion/usr/motion_logger.c $(USRMOT_SOURCES),linuxcnchal))

# Template of a user's homing module, built as a user builds it.
MOTION_GEN := $(O)/gen/emc/motion
$(MOTION_GEN)/homecomp.c: src/emc/motion/homecomp.comp $(wildcard src/hal/utils/halcompile/*.py)
	$(call say,HALCOMPILE,$<)
	$(Q)mkdir -p $(@D) && $(HALCOMPILE) --preprocess --output-dir=$(@D) $<
$(eval $(call rtmodule,homecomp,$(MOTION_GEN)/homecomp.c))

# Test program of tests/motion: objects/test/motion-handover.
HANDOVER_OBJECTS := $(call objs,ul,src/emc/motion/test/handover.c src/emc/motion/emcmotutil.c)
$(HANDOVER_OBJECTS): EXTRA += -Isrc/emc/motion
$(O)/test/motion-handover: $(HANDOVER_OBJECTS) $(T)/lib/liblinuxcnchal.so
	$(call say,LINK,$@)
	$(Q)mkdir -p $(@D) && $(CXX) $(SAN) $(LDFLAGS) -o $@ $(HANDOVER_OBJECTS) -L$(T)/lib -llinuxcnchal -lpthread -lm -Wl,-rpath,'$$ORIGIN/../../lib'
DEPS += $(HANDOVER_OBJECTS:.o=.d)
EXTRA_TARGETS += $(O)/test/motion-handover

.PHONY: bench-motion
bench-motion: modules
	/usr/bin/python3 src/emc/motion/test/phase-bench.py $(CURDIR)
BENCHES += bench-motion

# Random sequences on the bench machines, at the lowest priority.
.PHONY: property
property: all
	. scripts/rip-environment; nice -n 19 tests/motion/lib/bench-test tests/motion/lib/property.py $(or $(SEEDS),1-100) $(MACHINES)
