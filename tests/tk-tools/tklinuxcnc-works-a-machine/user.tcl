# A user's own file: Tcl with the commands of package Linuxcnc.
button .mine -text "machine [emc_ini MACHINE EMC]"
pack .mine
