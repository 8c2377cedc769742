# SPDX-License-Identifier: GPL-2.0-or-later
HALCOMPILE_DIR := src/hal/utils/halcompile
HALCOMPILE_SOURCES := $(wildcard $(HALCOMPILE_DIR)/*.py)
HALCOMPILE := PYTHONPATH=src/hal/utils $(PYTHON) -B -m halcompile

$(eval $(call script,halcompile,$(HALCOMPILE_DIR)/halcompile))

EXTRA_TARGETS += src/Makefile.modinc
src/Makefile.modinc: src/Makefile.modinc.in Makefile.inc
	$(call say,GEN,$@)
	$(Q)sed 's|@RTLIBDIR@|$(moduledir)|' $< > $@

INSTALL_HOOKS += install-halcompile
.PHONY: install-halcompile
install-halcompile:
	install -d $(DESTDIR)$(prefix)/lib/python3/dist-packages/halcompile $(DESTDIR)$(prefix)/lib/linuxcnc
	install -m 644 $(HALCOMPILE_SOURCES) $(DESTDIR)$(prefix)/lib/python3/dist-packages/halcompile
	install -m 755 scripts/export-map $(DESTDIR)$(prefix)/lib/linuxcnc/export-map
