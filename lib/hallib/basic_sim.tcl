# SPDX-License-Identifier: GPL-2.0-or-later
# basic_sim.tcl - a simulated machine for any kinematics and number of joints.
# [HAL]HALFILE = LIB:basic_sim.tcl [-no_make_ddts] [-no_simulated_home]
#                [-no_use_hal_manualtoolchange] [-no_sim_spindle]

source [file join [file dirname [info script]] sim_lib.tcl]

check_ini_items

set sim_joints [ini_value KINS JOINTS]
core_sim [get_traj_coordinates] $sim_joints [ini_value EMCMOT SERVO_PERIOD] \
    [ini_value EMCMOT BASE_PERIOD 0] [ini_value EMCMOT EMCMOT]
if {"-no_make_ddts" ni $::argv} { make_ddts $sim_joints }
if {"-no_simulated_home" ni $::argv} { simulated_home $sim_joints }
if {"-no_use_hal_manualtoolchange" ni $::argv} { use_hal_manualtoolchange }
if {"-no_sim_spindle" ni $::argv} { sim_spindle }

if {[info exists ::env(INI_FILE_NAME)]} {
    save_hal_cmds ./[file rootname [file tail $::env(INI_FILE_NAME)]]_cmds.hal
}
