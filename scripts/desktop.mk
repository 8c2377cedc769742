# SPDX-License-Identifier: GPL-2.0-or-later
# `make install-menu DESTDIR=...`, part of `make install`: what a desktop and udev know of the programs.
INSTALL_HOOKS += install-menu
.PHONY: install-menu
install-menu:
	install -d $(addprefix $(DESTDIR)$(datarootdir)/,applications desktop-directories icons/hicolor/scalable/apps metainfo mime/packages) \
	    $(DESTDIR)$(sysconfdir)/xdg/menus/applications-merged $(DESTDIR)$(sysconfdir)/security/limits.d $(DESTDIR)$(prefix)/lib/udev/rules.d
	$(INST) share/desktop/*.desktop $(DESTDIR)$(datarootdir)/applications
	$(INST) share/desktop/*.directory $(DESTDIR)$(datarootdir)/desktop-directories
	$(INST) share/desktop/linuxcncicon.svg $(DESTDIR)$(datarootdir)/icons/hicolor/scalable/apps
	$(INST) share/desktop/*.metainfo.xml $(DESTDIR)$(datarootdir)/metainfo
	$(INST) share/desktop/linuxcnc.xml $(DESTDIR)$(datarootdir)/mime/packages
	$(INST) share/desktop/CNC.menu $(DESTDIR)$(sysconfdir)/xdg/menus/applications-merged
	$(INST) share/system/limits.conf $(DESTDIR)$(sysconfdir)/security/limits.d/linuxcnc.conf
	$(INST) share/system/*.rules $(DESTDIR)$(prefix)/lib/udev/rules.d
