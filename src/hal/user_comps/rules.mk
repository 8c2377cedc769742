# SPDX-License-Identifier: GPL-2.0-or-later
# Components that are programs in Python.
$(eval $(call script,sim-torch,src/hal/user_comps/sim_torch.py))
$(eval $(call script,z_level_compensation,src/hal/user_comps/z_level_compensation.py))
$(eval $(call script,mqtt-publisher,src/hal/user_comps/mqtt_publisher.py))
$(eval $(call script,hal_input,src/hal/user_comps/hal_input.py))
$(eval $(call script,sendkeys,src/hal/user_comps/sendkeys.py))
$(eval $(call script,sim_pin,src/hal/user_comps/sim_pin.py))
$(eval $(call script,simulate_probe,src/hal/user_comps/simulate_probe.py))
$(eval $(call script,hal_bridge,src/hal/user_comps/hal_bridge.py))
$(eval $(call script,moveoff_gui,src/hal/user_comps/moveoff_gui.py))
$(eval $(call script,mitsub_vfd,src/hal/user_comps/mitsub_vfd.py))
$(eval $(call script,panelui,src/hal/user_comps/panelui.py))
$(eval $(call script,pmx485,src/hal/user_comps/pmx485.py))
$(eval $(call script,pmx485-test,src/hal/user_comps/pmx485_test.py))
$(eval $(call script,shuttle,src/hal/user_comps/shuttle.py))
$(eval $(call script,scorbot-er-3,src/hal/user_comps/scorbot_er_3.py))
$(eval $(call script,pyui,src/hal/user_comps/pyui.py))
$(eval $(call script,xhc-hb04-accels,src/hal/user_comps/xhc_hb04_accels.py))

# Programs in C++.
$(eval $(call program,hy_vfd,src/hal/user_comps/vfd/hy_vfd.cc src/hal/user_comps/vfd/hycomm.cc src/hal/user_comps/vfd/spindle_guard.cc,linuxcnchal,-Isrc/hal/user_comps))
ifeq ($(HAVE_LIBMODBUS),yes)
$(eval $(call program,mb2hal,src/hal/user_comps/mb2hal/mb2hal.cc src/hal/user_comps/mb2hal/config.cc,linuxcnchal linuxcncini $(LIBMODBUS_LIBS) -lpthread,$(LIBMODBUS_CFLAGS) -Isrc/emc/ini -Isrc/hal/user_comps))
MODBUS_DRIVE := src/hal/user_comps/vfd/modbus_link.cc src/hal/user_comps/vfd/spindle_guard.cc
$(eval $(call program,gs2_vfd,src/hal/user_comps/vfd/gs2_vfd.cc $(MODBUS_DRIVE),linuxcnchal $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/hal/user_comps))
$(eval $(call program,hy_gt_vfd,src/hal/user_comps/vfd/percent_vfd.cc $(MODBUS_DRIVE),linuxcnchal $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/hal/user_comps))
$(eval $(call program,svd-ps_vfd,src/hal/user_comps/vfd/percent_vfd.cc $(MODBUS_DRIVE),linuxcnchal $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/hal/user_comps))
INI_DRIVE := src/hal/user_comps/vfd/ini_section.cc $(MODBUS_DRIVE)
$(eval $(call program,vfs11_vfd,src/hal/user_comps/vfd/vfs11_vfd.cc $(INI_DRIVE),linuxcnchal linuxcncini $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/emc/ini -Isrc/hal/user_comps))
$(eval $(call program,vfdb_vfd,src/hal/user_comps/vfd/vfdb_vfd.cc $(INI_DRIVE),linuxcnchal linuxcncini $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/emc/ini -Isrc/hal/user_comps))
LINE_DRIVES := src/hal/user_comps/vfd/line_drives.cc $(MODBUS_DRIVE)
$(eval $(call program,wj200_vfd,src/hal/user_comps/vfd/wj200_vfd.cc $(LINE_DRIVES),linuxcnchal $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/hal/user_comps))
$(eval $(call program,pi500_vfd,src/hal/user_comps/vfd/pi500_vfd.cc $(LINE_DRIVES),linuxcnchal $(LIBMODBUS_LIBS),$(LIBMODBUS_CFLAGS) -Isrc/hal/user_comps))
endif
ifeq ($(HAVE_LIBUSB10),yes)
$(eval $(call program,xhc-hb04,src/hal/user_comps/xhc_hb04/xhc_hb04.cc src/hal/user_comps/xhc_hb04/pendant.cc src/hal/user_comps/xhc_usb.cc,linuxcnchal linuxcncini $(LIBUSB10_LIBS),$(LIBUSB10_CFLAGS) -Isrc/emc/ini -Isrc/hal/user_comps))
$(eval $(call program,xhc-whb04b-6,src/hal/user_comps/xhc_whb04b6/xhc_whb04b6.cc src/hal/user_comps/xhc_whb04b6/pendant.cc src/hal/user_comps/xhc_usb.cc,linuxcnchal $(LIBUSB10_LIBS),$(LIBUSB10_CFLAGS) -Isrc/hal/user_comps))
endif
