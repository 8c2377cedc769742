# SPDX-License-Identifier: GPL-2.0-or-later
# halcheck.tcl [nopopup] - last [HAL]HALFILE or POSTGUI_HALFILE: reports functions in no thread and
# signals that nothing reads or nothing writes. With a display also in a window.

source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]

namespace eval halcheck {

    # Lines that report functions which no thread calls.
    proc unused_functions {} {
        thread_info threads
        set used {}
        foreach thread [dict get $threads threadnames] { lappend used {*}[dict get $threads $thread,addf] }
        set lines {}
        foreach function [hal list funct] {
            if {$function ni $used} { lappend lines "halcheck: Functions with no addf: $function" }
        }
        return $lines
    }

    # Lines that report signals without a reader or without a writer.
    proc loose_signals {} {
        set lines {}
        foreach signal [hal list sig] {
            get_netlist inputs outputs ios $signal
            set value [hal gets $signal]
            if {![llength $inputs] && ![llength $ios]} {
                lappend lines "halcheck: Signal: $signal <$value> NO inputs"
            }
            if {![llength $outputs] && ![llength $ios]} {
                lappend lines "halcheck: Signal: $signal <$value> NO output"
            }
        }
        return $lines
    }

    # Shows the lines in a window of its own process, so that start-up goes on.
    proc popup {lines} {
        set script {
            wm title . halcheck
            text .t -width 78 -height 20 -wrap none -yscrollcommand {.s set}
            ttk::scrollbar .s -command {.t yview}
            ttk::button .b -text OK -command exit
            pack .b -side bottom -pady 4
            pack .s -side right -fill y
            pack .t -fill both -expand 1
            .t insert end [join $argv "\n"]
            .t configure -state disabled
        }
        set pipe [open "|wish8.6 - [list {*}$lines]" w]
        puts $pipe $script
        close $pipe
    }
}

set halcheck_lines [concat [halcheck::unused_functions] [halcheck::loose_signals]]
foreach line $halcheck_lines { puts $line }
if {[llength $halcheck_lines] && "nopopup" ni $::argv && [info exists ::env(DISPLAY)]} {
    if {[catch {halcheck::popup $halcheck_lines} message]} { puts "halcheck: no window: $message" }
}
