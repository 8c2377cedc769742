# SPDX-License-Identifier: GPL-2.0-or-later
$(eval $(call rtmodule,lateness,src/hal/lateness/lateness.c))
