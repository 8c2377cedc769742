# SPDX-License-Identifier: GPL-2.0-or-later
# Translations: LANGUAGE.po -> share/locale/LANGUAGE/LC_MESSAGES/linuxcnc.mo (gettext domain linuxcnc).
LANGUAGES := $(patsubst src/po/%.po,%,$(wildcard src/po/*.po))
CATALOGUES := $(foreach l,$(LANGUAGES),$(T)/share/locale/$(l)/LC_MESSAGES/linuxcnc.mo)
EXTRA_TARGETS += $(CATALOGUES)
INSTALL_HOOKS += install-translations

$(T)/share/locale/%/LC_MESSAGES/linuxcnc.mo: src/po/%.po
	$(call say,MO,$@)
	$(Q)mkdir -p $(@D) && msgfmt --check-format -o $@ $<

.PHONY: install-translations
install-translations: $(CATALOGUES)
	for l in $(LANGUAGES); do \
	    install -d $(DESTDIR)$(datarootdir)/locale/$$l/LC_MESSAGES && \
	    install -m 644 $(T)/share/locale/$$l/LC_MESSAGES/linuxcnc.mo $(DESTDIR)$(datarootdir)/locale/$$l/LC_MESSAGES/ || exit 1; done
