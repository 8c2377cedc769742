# SPDX-License-Identifier: GPL-2.0-or-later
# xhc-hb04.tcl - connects the wireless pendant xhc-hb04: wheel, display and buttons.
# [HAL]HALFILE = LIB:xhc-hb04.tcl, with [HAL]HALUI = halui.
#
# [XHC_HB04_CONFIG]
#   layout          1 (16 buttons, default) or 2 (18 buttons)
#   coords          letters for the positions x y z a of the rotary switch (default: x y z a); a
#                   letter that the switch lacks gets a position that is free
#   coefs, scales   per letter: filter of the wheel, 0 to 1 (1), and factor of its counts (1)
#   mpg_accels      per letter: acceleration of the wheel, units/s^2 (that of the axis)
#   threadname      thread for the filter (servo-thread)
#   sequence        list of step sizes, 1 to 5 (1)
#   jogmode         normal, vnormal (stops with the wheel) or plus-minus (wheel as a speed)
#   require_pendant yes or no (yes): without it the machine starts also when no pendant is there
#   inch_or_mm      what the display shows (that of [TRAJ]LINEAR_UNITS)
# [XHC_HB04_BUTTONS]
#   NAME = PIN      a button of the layout, without `button-`, and the pin that it drives.
#                   "" is unused; start-pause = std_start_pause runs, pauses and resumes.
# Signals are called pendant:NAME. TWOPASS: loaded in pass 0, connected in pass 1.

source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]
source [file join $::env(HALLIB_DIR) util_lib.tcl]

namespace eval xhc {
    variable switch {x y z a}

    proc say {message} { puts "xhc-hb04.tcl: $message" }

    proc fail {message} {
        puts stderr "xhc-hb04.tcl: $message"
        exit 1
    }

    # First of the values of [SECTION]NAME for the pairs given, or default.
    proc setting {pairs {default ""}} {
        foreach {section name} $pairs {
            if {[info exists ::${section}($name)]} { return [lindex [set ::${section}($name)] 0] }
        }
        return $default
    }

    proc config {name {default ""}} { return [setting [list XHC_HB04_CONFIG $name] $default] }

    # One of the words that a setting allows.
    proc choice {name default allowed} {
        set value [config $name $default]
        if {$value ni $allowed} { fail "\[XHC_HB04_CONFIG\]$name = $value: one of [join $allowed {, }]" }
        return $value
    }

    # Connects a writing pin to others: its signal when it has one, else a new one of that name.
    proc drive {name source args} {
        if {![pin_exists $source]} { fail "no pin $source" }
        set signal ""
        if {[is_connected $source signal] eq "not_connected"} { set signal pendant:$name }
        hal net $signal $source
        foreach target $args {
            if {![pin_exists $target]} {
                say "$target does not exist: not connected to $source"
            } elseif {[is_connected $target] ne "not_connected"} {
                say "$target is connected already: not to $source"
            } else {
                hal net $signal => $target
            }
        }
    }

    # Letter of the machine for each position of the switch: a list of position letter index pairs.
    proc positions {} {
        variable switch
        set taken {}
        set homeless {}
        set index 0
        foreach letter [string tolower [config coords "x y z a"]] {
            if {$letter ni [split xyzabcuvw {}]} { fail "\[XHC_HB04_CONFIG\]coords: no axis '$letter'" }
            if {$letter in $switch} { dict set taken $letter [list $letter $index] } else { lappend homeless $letter $index }
            incr index
        }
        foreach {letter index} $homeless {
            set place [lindex [lmap p $switch { if {[dict exists $taken $p]} continue; set p }] 0]
            if {$place eq ""} { fail "\[XHC_HB04_CONFIG\]coords: the switch has no position left for $letter" }
            say "axis $letter is at the switch's position $place"
            dict set taken $place [list $letter $index]
        }
        return $taken
    }

    # The wheel at one position of the switch moves an axis and, in joint mode, its joint.
    proc wheel {place letter index} {
        set n [lsearch {x y z a} $place]
        set owners axis.$letter
        if {![catch {joint_number_for_axis $letter} joint]} { lappend owners joint.$joint }
        set coef [expr {abs([lindex [config coefs] $index] + 0)}]
        if {[llength [config coefs]] <= $index} { set coef 1 }
        if {$coef > 1} {
            say "coefficient $coef of $letter is above 1: 0.5 is used"
            set coef 0.5
        }
        set scale [lindex [concat [config scales] {1 1 1 1 1 1 1 1 1}] $index]
        setp pendant_util.coef$n $coef
        setp pendant_util.scale$n [expr {100.0 * $scale}]
        drive pos-abs-$place halui.axis.$letter.pos-feedback xhc-hb04.$place.pos-absolute
        drive pos-rel-$place halui.axis.$letter.pos-relative xhc-hb04.$place.pos-relative
        if {[choice jogmode normal {normal vnormal plus-minus}] eq "plus-minus"} {
            drive plus-$place xhc-hb04.jog.plus-$place halui.axis.$letter.plus
            drive minus-$place xhc-hb04.jog.minus-$place halui.axis.$letter.minus
            return
        }
        drive wheel-counts xhc-hb04.jog.counts pendant_util.in$n
        set accel [lindex [config mpg_accels] $index]
        set most [setting [list AXIS_[string toupper $letter] MAX_ACCELERATION]]
        foreach owner $owners {
            drive wheel-$place pendant_util.out$n $owner.jog-counts
            drive jog-scale pendant_util.divide-by-k-out $owner.jog-scale
            drive enable-$place xhc-hb04.jog.enable-$place $owner.jog-enable
            setp $owner.jog-vel-mode [expr {[config jogmode normal] eq "vnormal"}]
            setp $owner.jog-accel-fraction [expr {$accel ne "" && $most ne "" ? min(1.0, double($accel) / $most) : 1.0}]
        }
    }

    # Display, overrides and what all positions share.
    proc common {} {
        setp pendant_util.k 100
        drive jog-step xhc-hb04.jog.scale pendant_util.divide-by-k-in
        drive feed-value motion.current-vel xhc-hb04.feed-value
        drive spindle-rps spindle.0.speed-out-rps-abs xhc-hb04.spindle-rps
        drive feed-override halui.feed-override.value xhc-hb04.feed-override
        drive spindle-override halui.spindle.0.override.value xhc-hb04.spindle-override
        foreach {name owner} {feed-override halui.feed-override spindle-override halui.spindle.0.override} {
            drive wheel-counts xhc-hb04.jog.counts $owner.counts
            drive $name-enable xhc-hb04.jog.enable-$name $owner.count-enable
            setp $owner.scale 0.01
        }
        set units [string tolower [config inch_or_mm [setting {TRAJ LINEAR_UNITS} mm]]]
        setp xhc-hb04.inch-icon [expr {$units in {in inch imperial}}]
        if {[config jogmode normal] eq "plus-minus"} {
            drive jog-speed xhc-hb04.jog.velocity halui.axis.jog-speed
            setp xhc-hb04.jog.max-velocity [setting {DISPLAY MAX_LINEAR_VELOCITY TRAJ MAX_LINEAR_VELOCITY} 1]
        }
    }

    # Run when idle, pause when running, resume when paused.
    proc start_pause {} {
        drive start-pause xhc-hb04.button-start-pause pendant_util.start-or-pause
        foreach state {idle paused running} { drive is-$state halui.program.is-$state pendant_util.is-$state }
        drive run pendant_util.run halui.program.run halui.mode.auto
        drive pause pendant_util.pause halui.program.pause
        drive resume pendant_util.resume halui.program.resume
    }

    proc buttons {} {
        if {![array exists ::XHC_HB04_BUTTONS]} return
        foreach name [lsort [array names ::XHC_HB04_BUTTONS]] {
            set pin [lindex $::XHC_HB04_BUTTONS($name) 0]
            set button xhc-hb04.button-$name
            if {$pin in {"" "\"\""}} {
                continue
            } elseif {$pin eq "caution"} {
                say "button $name is left out (caution)"
            } elseif {![pin_exists $button]} {
                say "the layout has no button $name: \[XHC_HB04_BUTTONS\]$name = $pin is left out"
            } elseif {$pin eq "std_start_pause"} {
                if {$name ne "start-pause"} { fail "std_start_pause is for the button start-pause, not for $name" }
                start_pause
            } else {
                drive button-$name $button $pin
            }
        }
    }

    proc load {} {
        if {[setting {HAL HALUI}] eq ""} { fail "the pendant needs \[HAL\]HALUI = halui" }
        set layout [file join $::env(HALLIB_DIR) xhc-hb04-layout[choice layout 1 {1 2}].cfg]
        set sequence [choice sequence 1 {1 2 3 4 5}]
        set wait [expr {[choice require_pendant yes {yes no}] ? "-x" : ""}]
        hal loadusr -W xhc-hb04 {*}$wait -I $layout -H -s $sequence
        hal loadrt xhc_hb04_util names=pendant_util
    }

    proc connect {} {
        hal addf pendant_util [config threadname servo-thread]
        dict for {place owner} [positions] { wheel $place {*}$owner }
        common
        buttons
    }
}

set xhc_pass [expr {[llength [info commands ::tp::passnumber]] ? [::tp::passnumber] : -1}]
if {$xhc_pass <= 0} { xhc::load }
if {$xhc_pass != 0} { xhc::connect }
