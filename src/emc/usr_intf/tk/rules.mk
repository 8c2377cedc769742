# Tk programs of operators.
$(eval $(call script,hal_manualtoolchange,src/emc/usr_intf/tk/hal_manualtoolchange.py))

$(foreach s,tooledit halshow emccalib halmeter,$(eval $(call script,$(s),src/emc/usr_intf/tk/start.py)))
