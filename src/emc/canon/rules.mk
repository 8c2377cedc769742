# SPDX-License-Identifier: GPL-2.0-or-later
# The canonical functions; the printer is linked by rs274 (src/emc/rs274ngc/rules.mk).
PUBLIC_HEADERS += src/emc/canon/canon.hh
