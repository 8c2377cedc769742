# SPDX-License-Identifier: GPL-2.0-or-later
# Every .c file is a driver module of its name.
DRIVER_DIR := src/hal/drivers
$(foreach c,$(notdir $(wildcard $(DRIVER_DIR)/*.c)),$(eval $(call rtmodule,$(basename $(c)),$(DRIVER_DIR)/$(c))))
