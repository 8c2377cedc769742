#!/usr/bin/tclsh
lappend auto_path $::env(LINUXCNC_TCL_DIR)
package require Linuxcnc
emc_init -quick -ini mill.ini
puts "[emc_estop] [emc_machine] [emc_mode] [emc_joint_homed 0] [emc_program_status] [emc_tool]"
foreach axis {Y Z} {puts -nonewline [format "%s %.3f " $axis [emc_abs_act_pos $axis]]}
puts ""
emc_mode mdi
emc_set_wait done
emc_mdi G0 X0 Y0 Z0
puts [format %.3f [emc_abs_cmd_pos X]]
emc_mdi G0 X12345
puts [emc_error]
puts "[emc_feed_override] [emc_spindle] [emc_user_linear_units] [lrange [emc_program_codes] 0 2]"
