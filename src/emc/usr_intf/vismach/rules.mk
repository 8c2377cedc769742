# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures of machines (vismach).
VISMACH := 5axisgui hbmgui hexagui lineardelta rotarydelta maho600gui max5gui melfagui millturngui puma560gui pumagui scaragui \
    scorbot-er-3-gui xyzab-tdr-gui xyzac-trt-gui xyzbc-trt-gui
$(foreach m,$(VISMACH),$(eval $(call script,$(m),src/emc/usr_intf/vismach/$(m))))
