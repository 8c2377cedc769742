# SPDX-License-Identifier: GPL-2.0-or-later
# The core with its function modules is one module; hm2_NAME.c with its parts hm2_NAME_*.c is a board
# driver of its name.
HM2_DIR := src/hal/drivers/mesa-hostmot2
$(eval $(call rtmodule,hostmot2,$(filter-out $(HM2_DIR)/hm2_%,$(wildcard $(HM2_DIR)/*.c))))
hm2_parts = $(wildcard $(HM2_DIR)/$(1).c $(HM2_DIR)/$(1)_*.c)
$(foreach b,hm2_test hm2_eth hm2_pci hm2_modbus,$(eval $(call rtmodule,$(b),$(call hm2_parts,$(b)))))
$(foreach b,hm2_spi hm2_spix hm2_rpspi,$(eval $(call rtmodule,$(b),$(HM2_DIR)/$(b).c $(HM2_DIR)/hm2_spi_link.c)))
$(eval $(call script,mesambccc,$(HM2_DIR)/mesambccc.py))
$(foreach b,hm2_7i43 hm2_7i90,$(eval $(call rtmodule,$(b),$(HM2_DIR)/$(b).c $(HM2_DIR)/hm2_epp_link.c)))
$(eval $(call script,elbpcom,$(HM2_DIR)/elbpcom.py))
$(eval $(call rtmodule,mesa_uart,$(HM2_DIR)/hm2_mesa_uart.c))
