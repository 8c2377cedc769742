# Tk programs of operators.

$(foreach s,tooledit halshow emccalib halmeter linuxcnctop debuglevel teach-in mdro tklinuxcnc ngcgui halconfig monitor-xhc-hb04 hal_manualtoolchange image-to-gcode,$(eval $(call script,$(s),src/emc/usr_intf/tk/start.py)))
