# SPDX-License-Identifier: GPL-2.0-or-later
KINS := src/emc/kinematics
PUBLIC_HEADERS += $(KINS)/kinematics.h $(KINS)/switchkins.h
KINS_UTIL := $(KINS)/kins_util.c src/emc/posemath/posemath.c src/emc/posemath/emcpose.c
SWITCHKINS := $(KINS)/switchkins.c $(KINS)/switchkins_util.c $(KINS)/userkfuncs.c $(KINS_UTIL)

$(eval $(call rtmodule,trivkins,$(KINS)/trivkins.c $(KINS_UTIL)))
KINS_MAIN := $(KINS)/kins_main.c $(KINS_UTIL)
KINS_PLAIN := corexykins rotatekins maxkins rosekins tripodkins scorbot-kins lineardeltakins rotarydeltakins \
    xyzab_tdr_kins millturn matrixkins
$(foreach k,$(KINS_PLAIN),$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS_MAIN))))
$(foreach k,xyzacb_trsrn xyzbca_trsrn,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS)/trsrn.c $(KINS_MAIN))))
$(eval $(call rtmodule,pentakins,$(KINS)/pentakins.c $(KINS)/kins_solve.cc $(KINS_MAIN),$(EIGEN_CFLAGS)))

$(foreach k,5axiskins scarakins,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(SWITCHKINS))))
$(foreach k,xyzac-trt-kins xyzbc-trt-kins,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS)/trtfuncs.c $(SWITCHKINS))))
$(foreach k,pumakins three21kins,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS)/arm6.c $(SWITCHKINS))))
$(foreach k,genserkins genhexkins,$(eval $(call rtmodule,$(k),$(KINS)/$(k).c $(KINS)/kins_solve.cc $(SWITCHKINS))))

# A tool for writers of kinematics, and for the tests.
$(eval $(call rtmodule,kinscheck,$(KINS)/kinscheck.c src/emc/posemath/emcpose.c))

# The same geometry for Python: lineardeltakins, rotarydeltakins.
$(foreach k,lineardeltakins rotarydeltakins,$(eval $(call pymodule,$(k),$(KINS)/python/$(k).cc)))

# Template of a user's module, built as a user builds it.
KINS_GEN := $(O)/gen/emc/kinematics
$(KINS_GEN)/userkins.c: $(KINS)/userkins.comp $(wildcard src/hal/utils/halcompile/*.py)
	$(call say,HALCOMPILE,$<)
	$(Q)mkdir -p $(@D) && $(HALCOMPILE) --preprocess --output-dir=$(@D) $<
$(eval $(call rtmodule,userkins,$(KINS_GEN)/userkins.c))
