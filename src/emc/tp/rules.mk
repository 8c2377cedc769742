# SPDX-License-Identifier: GPL-2.0-or-later
TP_SOURCES := $(addprefix src/emc/tp/,path.c limits.c join.c cell.c pace.c traj.c follow.c tp.c tp_cycle.c tp_sync.c tp_tap.c)
$(eval $(call rtmodule,tpmod,src/emc/tp/module.c $(TP_SOURCES)))

# Test programs of tests/tp: objects/test/tp-NAME.
define tp_test
$(O)/test/tp-$(1): $(call objs,ul,src/emc/tp/test/$(1).c src/emc/tp/test/bench.c src/emc/tp/test/machines.c $(TP_SOURCES))
	$$(call say,LINK,$$@)
	$$(Q)mkdir -p $$(@D) && $$(CC) $$(SAN) $$(LDFLAGS) -o $$@ $$^ -lm
DEPS += $(patsubst %.o,%.d,$(call objs,ul,src/emc/tp/test/$(1).c src/emc/tp/test/bench.c src/emc/tp/test/machines.c $(TP_SOURCES)))
EXTRA_TARGETS += $(O)/test/tp-$(1)
endef
$(eval $(call tp_test,property))
$(eval $(call tp_test,api))
$(eval $(call tp_test,optimum))
$(eval $(call tp_test,quality))
$(eval $(call tp_test,cycle))

.PHONY: bench-tp
bench-tp: $(O)/test/tp-cycle $(O)/test/tp-optimum
	/usr/bin/python3 src/emc/tp/test/cycle-bench.py $(O)/test/tp-cycle
	$(O)/test/tp-optimum
	$(O)/test/tp-optimum -j 50000
BENCHES += bench-tp

# Template of a user's planner, built as a user builds it.
TP_GEN := $(O)/gen/emc/tp
$(TP_GEN)/tpcomp.c: src/emc/tp/tpcomp.comp $(wildcard src/hal/utils/halcompile/*.py)
	$(call say,HALCOMPILE,$<)
	$(Q)mkdir -p $(@D) && $(HALCOMPILE) --preprocess --output-dir=$(@D) $<
$(eval $(call rtmodule,tpcomp,$(TP_GEN)/tpcomp.c))
