# SPDX-License-Identifier: GPL-2.0-or-later
# plasmac.tcl - loads the component plasmac and connects it to motion, halui and the machine.
# [HAL]HALFILE = LIB:plasmac.tcl, behind the file that loads motion; needs [HAL]HALUI = halui.
#
# Signals for the machine's own files: plasmac:arc-voltage-raw (volts, scale and offset are set in
# plasmac), plasmac:arc-ok-in, plasmac:float-switch, plasmac:breakaway, plasmac:ohmic-sense-in,
# plasmac:move-up, plasmac:move-down (inputs); plasmac:torch-on, plasmac:ohmic-enable,
# plasmac:scribe-arm, plasmac:scribe-on (outputs).
# Spindles of the program: 0 cuts, 1 scribes, 2 spots ([TRAJ]SPINDLES = 3).
# [QTPLASMAC]PM_PORT or [PLASMAC]PM_PORT: serial port of a Powermax; pmx485 is loaded for it.

source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]

namespace eval plasmac {

    # First value of an INI variable in one of the sections, or default.
    proc setting {sections name {default ""}} {
        foreach section $sections {
            if {[info exists ::${section}($name)]} { return [lindex [set ::${section}($name)] 0] }
        }
        return $default
    }

    # Joint of the Z axis: its place in [TRAJ]COORDINATES.
    proc z_joint {} {
        set letters [string toupper [string map {" " ""} [join $::TRAJ(COORDINATES) ""]]]
        set joint [string first Z $letters]
        if {$joint < 0} {
            puts stderr "plasmac.tcl: \[TRAJ\]COORDINATES = $letters has no Z, which plasmac moves"
            exit 1
        }
        return $joint
    }

    # Connects a pin that writes to pins that read, with the writer's signal where it has one.
    proc wire {signal from args} {
        set present ""
        if {[is_connected $from present] eq "not_connected"} { set present $signal }
        hal net $present $from
        foreach to $args { hal net $present $to }
    }

    proc connect {} {
        # limits, positions and offsets of the axes
        limits
        wire plasmac:axis-x-position axis.x.pos-cmd plasmac.axis-x-position
        wire plasmac:axis-y-position axis.y.pos-cmd plasmac.axis-y-position
        set joint [z_joint]
        hal net [feedback_of $joint] plasmac.axis-z-position
        foreach letter {x y z} {
            wire plasmac:$letter-offset-current axis.$letter.eoffset plasmac.$letter-offset-current
            wire plasmac:$letter-offset-counts plasmac.$letter-offset-counts axis.$letter.eoffset-counts
        }
        wire plasmac:offset-scale plasmac.offset-scale axis.x.eoffset-scale axis.y.eoffset-scale axis.z.eoffset-scale
        wire plasmac:xy-offset-enable plasmac.xy-offset-enable axis.x.eoffset-enable axis.y.eoffset-enable
        wire plasmac:z-offset-enable plasmac.z-offset-enable axis.z.eoffset-enable
        # motion
        wire plasmac:current-velocity motion.current-vel plasmac.current-velocity
        wire plasmac:feed-upm motion.feed-upm plasmac.feed-upm
        wire plasmac:feed-reduction motion.analog-out-03 plasmac.feed-reduction
        wire plasmac:motion-type motion.motion-type plasmac.motion-type
        wire plasmac:offsets-active motion.eoffset-active plasmac.offsets-active
        wire plasmac:offsets-limited motion.eoffset-limited plasmac.offsets-limited
        wire plasmac:adaptive-feed plasmac.adaptive-feed motion.adaptive-feed
        wire plasmac:feed-hold plasmac.feed-hold motion.feed-hold
        wire plasmac:jog-inhibit plasmac.jog-inhibit motion.jog-inhibit
        wire plasmac:probe-out plasmac.probe-out motion.probe-input
        foreach {spindle pin} {0 cutting-start 1 scribe-start 2 spotting-start} {
            if {$spindle < [setting TRAJ SPINDLES 1]} { wire plasmac:$pin spindle.$spindle.on plasmac.$pin }
        }
        # halui
        wire plasmac:feed-override halui.feed-override.value plasmac.feed-override
        wire plasmac:units-per-mm halui.machine.units-per-mm plasmac.units-per-mm
        wire plasmac:machine-is-on halui.machine.is-on plasmac.machine-is-on
        foreach state {is-idle is-paused is-running} {
            wire plasmac:program-$state halui.program.$state plasmac.program-$state
        }
        foreach action {pause resume run stop} {
            wire plasmac:program-$action plasmac.program-$action halui.program.$action
        }
        wire plasmac:cutting-stop plasmac.cutting-stop halui.spindle.0.stop
        # the machine
        foreach {signal pin} {
            arc-voltage-raw arc-voltage-in arc-ok-in arc-ok-in float-switch float-switch
            breakaway breakaway ohmic-sense-in ohmic-sense-in move-up move-up move-down move-down
            torch-on torch-on ohmic-enable ohmic-enable scribe-arm scribe-arm scribe-on scribe-on
        } {
            hal net plasmac:$signal plasmac.$pin
        }
    }

    # The signal of a joint's feedback; the loop of a bare joint is closed.
    proc feedback_of {joint} {
        set signal plasmac:axis-z-position
        if {[is_connected joint.$joint.motor-pos-fb signal] eq "not_connected"} {
            puts stderr "plasmac.tcl: joint.$joint.motor-pos-fb is not connected: put this file behind those that connect the joints"
            exit 1
        }
        return $signal
    }

    # The axes' soft limits of the INI file.
    proc limits {} {
        foreach letter {x y z} {
            foreach bound {min max} {
                set value [setting AXIS_[string toupper $letter] [string toupper $bound]_LIMIT]
                if {$value ne ""} { setp plasmac.axis-$letter-$bound-limit $value }
            }
        }
    }
}

set plasmac_pass [expr {[llength [info commands ::tp::passnumber]] ? [::tp::passnumber] : -1}]
if {$plasmac_pass <= 0} {
    loadrt plasmac
    set plasmac_port [plasmac::setting {QTPLASMAC PLASMAC} PM_PORT]
    if {$plasmac_port ne ""} { loadusr -Wn pmx485 pmx485 $plasmac_port }
}
if {$plasmac_pass != 0} {
    hal addf plasmac servo-thread
    plasmac::connect
}
