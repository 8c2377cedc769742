# SPDX-License-Identifier: GPL-2.0-or-later
# `make install DESTDIR=...`: the layout of a Debian installation.
D := $(DESTDIR)
install: all $(INSTALL_HOOKS)
