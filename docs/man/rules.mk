# SPDX-License-Identifier: GPL-2.0-or-later
# Manual pages: an .adoc file here for each program, module or family of them that is no HAL component. A page is
# found by every name in its NAME section; `:source:` names the files that read its options (tests/docs compares them).
# All pages, of components too (MANUAL_PAGES), go into docs/build/man.
MANUAL_PAGES += $(sort $(wildcard docs/man/*.adoc)) $(O)/gen/man/halcmd.adoc
$(O)/gen/man/halcmd.adoc: docs/man/halcmd_commands.py docs/man/halcmd.adoc.in $(T)/bin/halcmd
	$(Q)mkdir -p $(@D) && $(PYTHON) -B $< $(T)/bin/halcmd docs/man/halcmd.adoc.in > $@
EXTRA_TARGETS += $(T)/docs/build/man/.pages
$(T)/docs/build/man/.pages: $(MANUAL_PAGES) $(COMP_DIR)/manuals.py $(HALCOMPILE_SOURCES)
	$(call say,MAN,$(words $(MANUAL_PAGES)) pages)
	$(Q)rm -rf $(@D)/man[19] && mkdir -p $(@D) && $(MANUALS) man $(@D) $(MANUAL_PAGES) && touch $@
INSTALL_HOOKS += install-manuals
.PHONY: install-manuals
install-manuals: $(T)/docs/build/man/.pages
	for s in 1 9; do to=$(DESTDIR)$(mandir)/man$$s; install -d $$to && install -m 644 $(<D)/man$$s/*.$$s $$to; done
