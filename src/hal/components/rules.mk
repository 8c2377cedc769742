# SPDX-License-Identifier: GPL-2.0-or-later
# Every .comp file becomes a module of its name, and so does every .c file that
# is not named in COMP_C_PARTS. halcompile runs once over all files that changed;
# it keeps files whose content is the same, so only what differs is compiled.
COMP_DIR := src/hal/components
COMP_GEN := $(O)/gen/hal/components
COMP_CONV := $(addprefix $(COMP_GEN)/comp/,$(addsuffix .comp,$(filter-out conv_float_bit,\
    $(foreach x,bit float s32 s64 u32 u64,$(foreach y,$(filter-out $(x),bit float s32 s64 u32 u64),conv_$(x)_$(y))))))
COMP_FILES := $(sort $(wildcard $(COMP_DIR)/*.comp)) $(COMP_CONV)
COMP_NAMES := $(notdir $(basename $(COMP_FILES)))
COMP_GENERATED := $(addprefix $(COMP_GEN)/,$(addsuffix .c,$(COMP_NAMES)))

$(COMP_GEN)/comp/.stamp: $(COMP_DIR)/conv_gen.py
	$(call say,GEN,conv_*.comp)
	$(Q)$(PYTHON) $< $(COMP_GEN)/comp && touch $@
$(COMP_CONV): $(COMP_GEN)/comp/.stamp ;

$(COMP_GEN)/.stamp: $(COMP_FILES) $(HALCOMPILE_SOURCES)
	$(call say,HALCOMPILE,$(words $(filter %.comp,$(if $(filter %.py,$?),$^,$?))) files)
	$(Q)mkdir -p $(@D) && $(HALCOMPILE) --preprocess --output-dir=$(@D) $(filter %.comp,$(if $(filter %.py,$?),$^,$?)) && touch $@
$(COMP_GENERATED): $(COMP_GEN)/.stamp ;

# Components with `option userspace` are programs.
COMP_USER := thermistor
$(foreach n,$(filter-out $(COMP_USER),$(COMP_NAMES)),$(eval $(call rtmodule,$(n),$(COMP_GEN)/$(n).c)))
$(foreach n,$(COMP_USER),$(eval $(call program,$(n),$(COMP_GEN)/$(n).c,linuxcnchal -lm)))

# Modules in C.
COMP_C_PARTS :=
COMP_C := $(filter-out $(COMP_C_PARTS),$(notdir $(wildcard $(COMP_DIR)/*.c)))
$(foreach c,$(COMP_C),$(eval $(call rtmodule,$(basename $(c)),$(COMP_DIR)/$(c))))

# Manual pages (docs/man/rules.mk makes them), and docs/components.md (kept in the tree: tests/docs checks it).
COMP_PAGES := $(sort $(COMP_FILES) $(wildcard $(COMP_DIR)/man/*.adoc))
MANUALS := PYTHONPATH=src/hal/utils $(PYTHON) -B $(COMP_DIR)/manuals.py
MANUAL_PAGES += $(COMP_PAGES)
.PHONY: component-list
component-list: $(COMP_PAGES)
	$(call say,LIST,docs/components.md)
	$(Q)$(MANUALS) list $(COMP_PAGES) > docs/components.md
