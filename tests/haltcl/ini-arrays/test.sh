#!/bin/bash
# haltcl -i: one array per section, every element a list of all values.
printf '[KINS]\nKINEMATICS = trivkins coordinates=XZ\nJOINTS = 2\n[HAL]\nHALFILE = a.hal\nHALFILE = b.tcl 1 2\n[ODD]\nV = {[$x]}\n' > t.ini
cat > t.tcl <<'TCL'
puts "args <$argv>"
puts [lsort [info vars ::KINS]]
puts "<$::KINS(JOINTS)> <[lindex $::KINS(KINEMATICS) 0]> [llength $::HAL(HALFILE)] <[lindex $::HAL(HALFILE) 1]>"
puts "<[lindex $::ODD(V) 0]>"
puts "[emc_ini JOINTS KINS] [emc_ini NONE KINS] [emc_ini NONE KINS 5] [emc_ini_int JOINTS KINS] [emc_ini_sections]"
puts "[catch {emc_ini_real NONE KINS} m] $m"
puts [emc_ini_variables HAL]
puts "[catch {parse_ini other.ini} m] $m"
TCL
unset INI_FILE_NAME
haltcl -i t.ini t.tcl x 'y z'; echo "=> $?"
haltcl -ini t.ini t.tcl | head -1
INI_FILE_NAME=t.ini haltcl -i t.ini t.tcl | head -1
INI_FILE_NAME=other.ini haltcl -i t.ini t.tcl 2>&1 | head -1
haltcl -i none.ini t.tcl 2>&1 | head -2
rm -f t.ini t.tcl
