# SPDX-License-Identifier: GPL-2.0-or-later
package require Linuxcnc
proc show args {
    foreach c $args {
        if {[catch {uplevel #0 $c} result]} { puts "$c -> error: $result" } else { puts "$c -> $result" }
    }
}
puts "missing: [lmap c {emc_plat emc_ini emc_ini_bool emc_ini_real emc_ini_int emc_ini_wideint emc_ini_sections emc_ini_variables emc_ini_filename emc_ini_load
    emc_debug emc_set_wait emc_wait emc_set_timeout emc_update emc_time emc_error emc_operator_text emc_operator_display emc_estop emc_machine emc_mist emc_flood
    emc_mode emc_spindle emc_brake emc_tool emc_tool_offset emc_load_tool_table emc_set_tool_offset emc_abs_cmd_pos emc_abs_act_pos emc_rel_cmd_pos emc_rel_act_pos
    emc_pos_offset emc_joint_pos emc_joint_limit emc_joint_fault emc_joint_homed emc_override_limit emc_optional_stop emc_mdi emc_home emc_unhome emc_jog_stop emc_jog
    emc_jog_incr emc_feed_override emc_rapid_override emc_spindle_override emc_task_plan_init emc_open emc_run emc_pause emc_resume emc_step emc_abort emc_program
    emc_program_line emc_program_status emc_program_codes emc_joint_type emc_joint_units emc_program_linear_units emc_program_angular_units emc_user_linear_units
    emc_user_angular_units emc_display_linear_units emc_display_angular_units emc_linear_unit_conversion emc_angular_unit_conversion emc_task_command
    emc_task_command_number emc_task_command_status emc_io_command emc_io_command_number emc_io_command_status emc_motion_command emc_motion_command_number
    emc_motion_command_status emc_joint_backlash emc_joint_load_comp emc_joint_enable emc_teleop_enable emc_kinematics_type emc_probe_clear emc_probe_value
    emc_probe_tripped emc_probe_move emc_probed_pos emc_pendant int round multihead emc_init} {if {[info commands $c] eq ""} {set c} else continue}]"
show emc_mode {emc_init -ini mill.ini} {set EMC_INIFILE} emc_plat {emc_ini MACHINE EMC} {emc_ini NOPE EMC dflt} {emc_ini_real SERVO_PERIOD EMCMOT} {emc_ini_int JOINTS KINS} \
    {emc_ini_bool NOPE EMC 1} {llength [emc_ini_sections]} {emc_ini_variables KINS} emc_ini_filename
show emc_estop emc_machine emc_mode {emc_estop maybe} {emc_estop off} {emc_machine on} emc_estop emc_machine {emc_mode 1} {emc_mode manual}
show emc_set_wait {emc_set_wait done} emc_set_wait emc_set_timeout {emc_teleop_enable 0} {emc_home 0} {emc_home 1} {emc_home 2} {emc_joint_homed 0} {emc_teleop_enable 0} {emc_unhome 0} {emc_joint_homed 0} {emc_home -1} {emc_joint_homed 2} {emc_joint_homed x}
for {set i 0} {$i < 20} {incr i} {emc_mist off} ;# teleop follows a moment after the last homing
show emc_teleop_enable {emc_teleop_enable 0} {emc_jog_incr 0 1 600 2} {emc_abs_cmd_pos X} {format %.3f [emc_abs_act_pos 0]} {emc_abs_act_pos Q} {format %.3f [emc_joint_pos 0]} {emc_set_wait received} {emc_jog 0 1 600} {emc_jog_stop 0 1} {emc_set_wait done} {emc_jog 0}
show {emc_spindle forward} emc_spindle {emc_spindle 0 reverse} {emc_spindle 0} {emc_spindle off} {emc_spindle sideways} emc_brake {emc_brake off} {emc_brake 0} {emc_brake 0 on} {emc_mist on} emc_mist {emc_mist off} {emc_flood on} emc_flood {emc_flood off}
show emc_feed_override {emc_feed_override 55} emc_feed_override {emc_feed_override 100} {emc_rapid_override 30} emc_rapid_override {emc_rapid_override 100} {emc_spindle_override 70} emc_spindle_override {emc_spindle_override 0 100} {emc_spindle_override 0}
show emc_joint_limit {emc_joint_limit 0} {emc_joint_fault 1} {emc_joint_type 1} {emc_joint_units 1} {emc_joint_backlash 1} {emc_joint_enable 0} emc_override_limit emc_optional_stop {emc_optional_stop 0} emc_optional_stop {emc_optional_stop 1}
show emc_program_linear_units emc_program_angular_units emc_user_linear_units emc_user_angular_units emc_display_linear_units emc_display_angular_units emc_kinematics_type
show {emc_mode mdi} {emc_mdi G0 X25.4 Y0} {format %.3f [emc_abs_act_pos X]} {emc_linear_unit_conversion inch} emc_linear_unit_conversion {format %.3f [emc_abs_act_pos X]} emc_display_linear_units {emc_linear_unit_conversion auto} {emc_mdi G20} {format %.3f [emc_abs_act_pos X]} emc_display_linear_units {emc_mdi G21}
show {emc_mdi G92 X0} {format %.3f [emc_rel_act_pos X]} {format %.3f [emc_pos_offset X]} {emc_mdi G92.1} {emc_mdi T1 M6} {emc_mdi G43} emc_tool emc_tool_offset {emc_tool_offset X} {emc_rel_act_pos Z} {emc_mdi G49} {emc_set_tool_offset 1 30 8} {emc_load_tool_table mill.tbl}
show emc_program_codes {emc_mdi (MSG,hello there)} emc_operator_display emc_operator_display {emc_mdi G1 F0 X1} emc_error emc_error emc_operator_text {emc_mdi [string repeat X 300]}
show emc_task_command emc_task_command_status {expr {[emc_task_command_number] > 10}} emc_io_command_status emc_motion_command_status
show {emc_set_timeout inf} {emc_mdi G4 P0.1} {emc_set_timeout 0}
show {emc_probe_move 1 2 -1} emc_probe_tripped emc_probe_value {emc_probed_pos X} emc_probe_clear
set f [open t.ngc w]; puts $f "G21 G0 X1\nG0 X2\nG4 P0.2\nM2"; close $f
show {emc_open [string repeat n 300]} {emc_load_tool_table [string repeat n 300]} {emc_joint_load_comp 0 [string repeat n 300] 0}
show emc_program {emc_mode auto} {emc_open t.ngc} {file tail [emc_program]} emc_program_status emc_run emc_program_status {format %.3f [emc_abs_act_pos X]} {emc_set_wait received} emc_run emc_pause emc_program_status emc_resume {emc_wait done} emc_program_status emc_step {emc_set_timeout 0.2} {emc_wait done} emc_abort emc_program_line emc_task_plan_init
show {emc_pendant /dev/null} {int 3.7} {int -3.7} {round 3.7} {emc_debug} {emc_update none} {emc_update} {emc_update auto} {emc_machine off} {emc_estop on} emc_estop
