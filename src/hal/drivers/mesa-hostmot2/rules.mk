# SPDX-License-Identifier: GPL-2.0-or-later
# The core with its function modules is one module; hm2_NAME.c with its parts hm2_NAME_*.c is a board
# driver of its name.
HM2_DIR := src/hal/drivers/mesa-hostmot2
HM2_BOARDS := hm2_test hm2_eth
$(eval $(call rtmodule,hostmot2,$(filter-out $(HM2_DIR)/hm2_%,$(wildcard $(HM2_DIR)/*.c))))
$(foreach b,$(HM2_BOARDS),$(eval $(call rtmodule,$(b),$(wildcard $(HM2_DIR)/$(b).c $(HM2_DIR)/$(b)_*.c))))
