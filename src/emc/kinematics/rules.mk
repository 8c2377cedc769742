# SPDX-License-Identifier: GPL-2.0-or-later
KINS := src/emc/kinematics
PUBLIC_HEADERS += $(KINS)/kinematics.h $(KINS)/switchkins.h
KINS_UTIL := $(KINS)/kins_util.c src/emc/posemath/posemath.c src/emc/posemath/emcpose.c
KINS_GEN := $(O)/gen/emc/kinematics

# `userkfuncs=FILE make`: FILE has the functions of type 2. The generated file changes when FILE's name does.
userkfuncs ?= $(KINS)/userkfuncs.c
SWITCHKINS_FRAME := $(KINS)/switchkins.c $(KINS)/switchkins_util.c $(KINS_UTIL)
SWITCHKINS := $(SWITCHKINS_FRAME) $(KINS_GEN)/userkfuncs.c
$(KINS_GEN)/userkfuncs.c: userkfuncs_chosen
	@mkdir -p $(@D) && echo '#include "$(abspath $(userkfuncs))"' | cmp -s - $@ || echo '#include "$(abspath $(userkfuncs))"' > $@
.PHONY: userkfuncs_chosen
userkfuncs_chosen: ; @test -r '$(userkfuncs)' || { echo 'userkfuncs=$(userkfuncs): no such file' >&2; exit 1; }

$(eval $(call rtmodule,trivkins,$(KINS)/trivkins.c $(KINS_UTIL)))
KINS_MAIN := $(KINS)/kins_main.c $(KINS_UTIL)
KINS_PLAIN := corexykins rotatekins maxkins rosekins tripodkins scorbot-kins lineardeltakins rotarydeltakins \
    xyzab_tdr_kins millturn matrixkins
$(foreach k,$(KINS_PLAIN),$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS_MAIN))))
$(foreach k,xyzacb_trsrn xyzbca_trsrn,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS)/trsrn.c $(KINS_MAIN))))
$(eval $(call rtmodule,pentakins,$(KINS)/pentakins.c $(KINS)/kins_solve.cc $(KINS_MAIN),$(EIGEN_CFLAGS)))

# $(call switchable,NAMES,FURTHER SOURCES). What is not the frame's or the user's is also kept as one object, of which
# switchkins.mk makes the module anew where the sources are not there.
define switchable_module
$(call rtmodule,$(1),$(KINS)/$(1).c $(2) $(SWITCHKINS))
$(call switchkins_part,$(1),$(KINS)/$(1).c $(2))
endef
define switchkins_part
SWITCHKINS_PARTS += $(T)/lib/switchkins/$(1).o
$(T)/lib/switchkins/$(1).o: $(call objs,rt,$(2))
	$$(Q)mkdir -p $$(@D) && $$(CC) -r -nostdlib -Wl,-S -o $$@ $(call objs,rt,$(2))
endef
switchable = $(foreach k,$(1),$(eval $(call switchable_module,$(k),$(2))))
$(call switchable,5axiskins scarakins)
$(call switchable,xyzac-trt-kins xyzbc-trt-kins,$(KINS)/trtfuncs.c)
$(call switchable,pumakins three21kins,$(KINS)/arm6.c)
$(call switchable,genserkins genhexkins,$(KINS)/kins_solve.cc)
$(eval $(call switchkins_part,frame,$(SWITCHKINS_FRAME)))
$(eval $(call switchkins_part,userkfuncs,$(KINS)/userkfuncs.c))
EXTRA_TARGETS += $(SWITCHKINS_PARTS)

# A tool for writers of kinematics, and for the tests.
$(eval $(call rtmodule,kinscheck,$(KINS)/kinscheck.c src/emc/posemath/emcpose.c))

# The same geometry for Python: lineardeltakins, rotarydeltakins.
$(foreach k,lineardeltakins rotarydeltakins,$(eval $(call pymodule,$(k),$(KINS)/python/$(k).cc)))

# Template of a user's module, built as a user builds it.
$(KINS_GEN)/userkins.c: $(KINS)/userkins.comp $(wildcard src/hal/utils/halcompile/*.py)
	$(call say,HALCOMPILE,$<)
	$(Q)mkdir -p $(@D) && $(HALCOMPILE) --preprocess --output-dir=$(@D) $<
$(eval $(call rtmodule,userkins,$(KINS_GEN)/userkins.c))
