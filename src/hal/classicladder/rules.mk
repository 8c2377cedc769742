# SPDX-License-Identifier: GPL-2.0-or-later
LADDER_DIR := src/hal/classicladder
LADDER_CORE := $(addprefix $(LADDER_DIR)/,ladder_data.c ladder_expr.c ladder_scan.c ladder_seq.c)
$(eval $(call rtmodule,classicladder_rt,$(LADDER_DIR)/classicladder_rt.c $(LADDER_CORE)))
$(eval $(call program,classicladder,$(addprefix $(LADDER_DIR)/,classicladder.c clp.c modbus_pdu.c modbus_link.c) $(LADDER_CORE),linuxcnchal -lpthread))
