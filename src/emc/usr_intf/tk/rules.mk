# Tk programs of operators.

$(foreach s,tooledit halshow emccalib halmeter linuxcnctop debuglevel teach-in mdro tklinuxcnc hal_manualtoolchange,$(eval $(call script,$(s),src/emc/usr_intf/tk/start.py)))
