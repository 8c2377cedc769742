# SPDX-License-Identifier: GPL-2.0-or-later
# hookup_moveoff.tcl - puts the component moveoff, named mv, between motion and the drives.
# [HAL]HALFILE = LIB:hookup_moveoff.tcl, after the files that connect the joints.
#
# Every joint with [JOINT_n]TYPE gets an offset:
#   joint.n.motor-pos-cmd -> mv.pos-n, mv.pos-plusoffset-n -> what read the command before
#   what wrote the feedback -> mv.fb-n, mv.fb-minusoffset-n -> joint.n.motor-pos-fb
# Limits: [MOVEOFF_n] MAX_VELOCITY MAX_ACCELERATION MAX_LIMIT MIN_LIMIT, else those of [JOINT_n].
# [MOVEOFF] EPSILON WAYPOINT_SAMPLE_SECS WAYPOINT_THRESHOLD BACKTRACK_ENABLE.
# With [HAL]TWOPASS the connections are made in pass 1, when everything is loaded.

source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]

namespace eval moveoff {

    # First of the values of [SECTION]NAME for the sections given, or default.
    proc setting {sections name {default ""}} {
        foreach section $sections {
            if {[info exists ::${section}($name)]} { return [lindex [set ::${section}($name)] 0] }
        }
        return $default
    }

    # Numbers of the joints that get an offset.
    proc joints {} {
        set found {}
        for {set j 0} {$j < 9} {incr j} {
            if {[info exists ::JOINT_${j}(TYPE)]} { lappend found $j }
        }
        return $found
    }

    proc fail {message} {
        puts stderr "hookup_moveoff.tcl: $message"
        exit 1
    }

    # The signal of a pin; a pin that has none is an error, since there is nothing to splice.
    proc signal_of {pin} {
        set signal ""
        if {[is_connected $pin signal] eq "not_connected"} {
            fail "$pin is not connected: put LIB:hookup_moveoff.tcl behind the \[HAL\]HALFILEs that connect the joints"
        }
        return $signal
    }

    # Adds both functions behind motion-controller, so that an offset acts in the same cycle.
    proc add_functions {} {
        thread_info threads
        foreach thread [dict get $threads threadnames] {
            set at [lsearch -exact [dict get $threads $thread,addf] motion-controller]
            if {$at >= 0} {
                hal addf mv.read-inputs $thread [expr {$at + 2}]
                hal addf mv.write-outputs $thread [expr {$at + 3}]
                return
            }
        }
        fail "motion-controller is in no thread: addf it before this file"
    }

    proc splice {joint} {
        set command [signal_of joint.$joint.motor-pos-cmd]
        set feedback [signal_of joint.$joint.motor-pos-fb]
        hal unlinkp joint.$joint.motor-pos-cmd
        hal unlinkp joint.$joint.motor-pos-fb
        hal net mv:pos-$joint joint.$joint.motor-pos-cmd => mv.pos-$joint
        hal net $command <= mv.pos-plusoffset-$joint
        hal net $feedback => mv.fb-$joint
        hal net mv:fb-$joint mv.fb-minusoffset-$joint => joint.$joint.motor-pos-fb
    }

    proc limits {joint} {
        set sections [list MOVEOFF_$joint JOINT_$joint]
        foreach {pin name} {vel MAX_VELOCITY accel MAX_ACCELERATION min MIN_LIMIT max MAX_LIMIT} {
            set value [setting $sections $name]
            if {$value eq ""} { fail "\[MOVEOFF_$joint\]$name and \[JOINT_$joint\]$name are both missing: set one" }
            setp mv.offset-$pin-$joint $value
        }
    }

    proc connect {} {
        add_functions
        foreach joint [joints] {
            splice $joint
            limits $joint
        }
        foreach {pin name} {
            epsilon EPSILON waypoint-sample-secs WAYPOINT_SAMPLE_SECS
            waypoint-threshold WAYPOINT_THRESHOLD backtrack-enable BACKTRACK_ENABLE
        } {
            set value [setting MOVEOFF $name]
            if {$value ne ""} { setp mv.$pin $value }
        }
        if {[is_connected motion.motion-enabled enabled] eq "not_connected"} { set enabled mv:power-on }
        hal net $enabled motion.motion-enabled => mv.power-on
    }
}

# loadrt is carried out in pass 0 of TWOPASS, the rest of the HAL commands in pass 1.
set moveoff_pass [expr {[llength [info commands ::tp::passnumber]] ? [::tp::passnumber] : -1}]
if {$moveoff_pass <= 0} {
    loadrt moveoff names=mv personality=[expr {[lindex [moveoff::joints] end] + 1}]
}
if {$moveoff_pass != 0} { moveoff::connect }
