# SPDX-License-Identifier: GPL-2.0-or-later
# Manual pages: an .adoc file here for each program, module or family of them that is no HAL component. A page is
# found by every name in its NAME section; `:source:` names the files that read its options (tests/docs compares them).
# Pages of functions (section 3) are made of the comments in public headers. All, those of components too
# (MANUAL_PAGES), go into docs/build/man.
MANUAL_PAGES += $(sort $(wildcard docs/man/*.adoc)) $(O)/gen/man/halcmd.adoc
MANUAL_PAGES += src/emc/motion/homecomp.comp src/emc/tp/tpcomp.comp src/emc/kinematics/userkins.comp
$(O)/gen/man/halcmd.adoc: docs/man/halcmd_commands.py docs/man/halcmd.adoc.in $(T)/bin/halcmd
	$(Q)mkdir -p $(@D) && $(PYTHON) -B $< $(T)/bin/halcmd docs/man/halcmd.adoc.in > $@
MANUAL_HEADERS = $(filter src/rtapi/%.h src/hal/%.h,$(PUBLIC_HEADERS))
EXTRA_TARGETS += $(T)/docs/build/man/.pages
$(T)/docs/build/man/.pages: $(MANUAL_PAGES) $(MANUAL_HEADERS) $(COMP_DIR)/manuals.py docs/man/headers.py \
    $(HALCOMPILE_SOURCES)
	$(call say,MAN,$(words $(MANUAL_PAGES)) pages)
	$(Q)rm -rf $(@D)/man[139] && mkdir -p $(@D) && $(MANUALS) man $(@D) $(MANUAL_PAGES)
	$(Q)PYTHONPATH=src/hal/utils $(PYTHON) -B docs/man/headers.py $(@D) $(MANUAL_HEADERS) && touch $@
INSTALL_HOOKS += install-manuals
.PHONY: install-manuals
install-manuals: $(T)/docs/build/man/.pages
	for s in 1 3 9; do to=$(DESTDIR)$(mandir)/man$$s; install -d $$to && install -m 644 $(<D)/man$$s/*.$$s $$to; done
