# SPDX-License-Identifier: GPL-2.0-or-later
#
# start.tcl - sourced by NAME.tcl beside it: starts the program NAME with the same arguments. The
# programs are called under these names from menus and from HAL files (exec wish .../NAME.tcl).

catch { wm withdraw . }
set bin [file join [file dirname [info script]] .. .. bin]
if {![file isdirectory $bin]} { set bin [file join [file dirname [info script]] .. .. .. .. bin] }
set program [file join $bin [file rootname [file tail $argv0]]]
if {[catch { exec $program {*}$argv <@stdin >@stdout 2>@stderr } message options]} {
    set code [dict get $options -errorcode]
    if {[lindex $code 0] eq "CHILDSTATUS"} { exit [lindex $code 2] }
    puts stderr $message
    exit 1
}
exit 0
