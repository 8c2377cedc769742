# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += $(addprefix src/emc/nml/,messages.hh messages.def)
