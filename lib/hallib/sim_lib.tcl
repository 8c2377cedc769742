# SPDX-License-Identifier: GPL-2.0-or-later
# sim_lib.tcl - procedures that build a simulated machine for any number of joints.
# Source it from a haltcl file that has the INI arrays (::KINS, ::TRAJ, ::JOINT_0 ...).
# Distances in machine units. basic_sim.tcl shows the use.

# First value of an INI variable, or default when it is missing.
proc ini_value {section name {default ""}} {
    if {![info exists ::${section}($name)]} { return $default }
    return [lindex [set ::${section}($name)] 0]
}

# Coordinate letters of [TRAJ]COORDINATES, lower case, without blanks.
proc get_traj_coordinates {} {
    return [string tolower [string map {" " "" "\t" ""} [join $::TRAJ(COORDINATES) ""]]]
}

# Ends the program with a message when a setting that the simulation needs is missing.
proc check_ini_items {} {
    set needed {{KINS KINEMATICS} {KINS JOINTS} {TRAJ COORDINATES} {TRAJ LINEAR_UNITS}
                {EMCMOT EMCMOT} {EMCMOT SERVO_PERIOD}}
    foreach item $needed {
        lassign $item section name
        if {![info exists ::${section}($name)]} {
            puts stderr "[file tail [info script]] ERROR: Missing inifile item: \[$section\]$name"
            exit 1
        }
    }
    for {set j 0} {$j < [ini_value KINS JOINTS]} {incr j} {
        if {![info exists ::JOINT_${j}(TYPE)]} { set ::JOINT_${j}(TYPE) LINEAR }
    }
    set kins [ini_value KINS KINEMATICS]
    if {[info exists ::DISPLAY(LATHE)] && [string is true -strict [ini_value DISPLAY LATHE]]
        && [lindex $kins 0] eq "trivkins" && ![string match -nocase *coordinates=* $kins]} {
        puts stderr "[file tail [info script]] ERROR: a lathe needs trivkins coordinates=...: give the\
            letters in \[KINS\]KINEMATICS"
        exit 1
    }
    return
}

# setp that says which pin failed.
proc do_setp {pin value} {
    if {[catch {hal setp $pin $value} message]} {
        puts stderr "do_setp: cannot set $pin to $value: $message"
        exit 1
    }
    return
}

proc setup_kins {axes} {
    hal loadrt {*}[ini_value KINS KINEMATICS]
    return
}

# Kinematics, motion and, for each joint, a pass-through PID and a mux that holds the feedback
# while motion is off.
proc core_sim {axes number_of_joints servo_period {base_period 0} {emcmot motmod}} {
    setup_kins $axes
    hal loadrt {*}$emcmot base_period_nsec=$base_period servo_period_nsec=$servo_period num_joints=$number_of_joints
    set pids {}
    set muxes {}
    for {set j 0} {$j < $number_of_joints} {incr j} {
        lappend pids J${j}_pid
        lappend muxes J${j}_mux
    }
    hal loadrt pid names=[join $pids ,]
    hal loadrt mux2 names=[join $muxes ,]

    hal addf motion-command-handler servo-thread
    hal addf motion-controller servo-thread
    foreach name $pids { hal addf $name.do-pid-calcs servo-thread }
    foreach name $muxes { hal addf $name servo-thread }

    hal net estop:loop <= iocontrol.0.user-enable-out
    hal net estop:loop => iocontrol.0.emc-enable-in
    hal net tool:prep-loop <= iocontrol.0.tool-prepare
    hal net tool:prep-loop => iocontrol.0.tool-prepared
    hal net tool:change-loop <= iocontrol.0.tool-change
    hal net tool:change-loop => iocontrol.0.tool-changed
    hal net sample:enable <= motion.motion-enabled

    for {set j 0} {$j < $number_of_joints} {incr j} {
        do_setp J${j}_pid.Pgain 0
        do_setp J${j}_pid.Igain 0
        do_setp J${j}_pid.Dgain 0
        do_setp J${j}_pid.bias 0
        do_setp J${j}_pid.FF0 1
        do_setp J${j}_pid.FF1 0
        do_setp J${j}_pid.FF2 0
        do_setp J${j}_pid.deadband 0
        do_setp J${j}_pid.maxoutput 0
        hal net J${j}:enable <= joint.$j.amp-enable-out
        hal net J${j}:enable => J${j}_pid.enable
        hal net J${j}:pos-cmd <= joint.$j.motor-pos-cmd
        hal net J${j}:pos-cmd => J${j}_pid.command
        hal net J${j}:on-pos <= J${j}_pid.output
        hal net J${j}:on-pos => J${j}_mux.in1
        hal net J${j}:pos-fb <= J${j}_mux.out
        hal net J${j}:pos-fb => J${j}_mux.in0 joint.$j.motor-pos-fb
        hal net sample:enable => J${j}_mux.sel
    }
    return
}

# Velocity and acceleration of every joint, and the path speed when x, y and z exist.
proc make_ddts {number_of_joints} {
    set names {}
    for {set j 0} {$j < $number_of_joints} {incr j} { lappend names J${j}_vel J${j}_accel }
    hal loadrt ddt names=[join $names ,]
    foreach name $names { hal addf $name servo-thread }
    for {set j 0} {$j < $number_of_joints} {incr j} {
        hal net J${j}:pos-fb => J${j}_vel.in
        hal net J${j}:vel <= J${j}_vel.out
        hal net J${j}:vel => J${j}_accel.in
        hal net J${j}:acc <= J${j}_accel.out
    }
    set letters [get_traj_coordinates]
    set x [string first x $letters]
    set y [string first y $letters]
    set z [string first z $letters]
    if {$x < 0 || $y < 0 || $z < 0 || max($x, $y, $z) >= $number_of_joints} { return }
    hal loadrt hypot names=hyp_xy,hyp_xyz
    hal addf hyp_xy servo-thread
    hal addf hyp_xyz servo-thread
    hal net J${x}:vel => hyp_xy.in0
    hal net J${y}:vel => hyp_xy.in1
    hal net xy:vel <= hyp_xy.out
    hal net xy:vel => hyp_xyz.in0
    hal net J${z}:vel => hyp_xyz.in1
    hal net xyz:vel <= hyp_xyz.out
    return
}

# A home switch and an index for every joint that searches one.
proc simulated_home {number_of_joints} {
    set names {}
    for {set j 0} {$j < $number_of_joints} {incr j} { lappend names J${j}_switch }
    hal loadrt sim_home_switch names=[join $names ,]
    foreach name $names { hal addf $name servo-thread }
    set inch [expr {[string tolower [ini_value TRAJ LINEAR_UNITS]] in {in inch imperial}}]
    for {set j 0} {$j < $number_of_joints} {incr j} {
        set linear [expr {[string toupper [ini_value JOINT_$j TYPE LINEAR]] eq "LINEAR"}]
        set hysteresis [expr {$inch && $linear ? 0.05 : 0.1}]
        set home_pos [expr {$inch && $linear ? 0.10 : 1.0}]
        if {[ini_value JOINT_$j HOME_SEARCH_VEL 0] < 0} { set home_pos [expr {-$home_pos}] }
        do_setp J${j}_switch.hysteresis $hysteresis
        do_setp J${j}_switch.home-pos $home_pos
        hal net J${j}:pos-fb => J${j}_switch.cur-pos
        hal net J${j}:homesw <= J${j}_switch.home-sw
        hal net J${j}:homesw => joint.$j.home-sw-in
        if {[string is true -strict [ini_value JOINT_$j HOME_USE_INDEX no]]} {
            hal net J${j}:index-enable <=> joint.$j.index-enable
            hal net J${j}:index-enable <=> J${j}_switch.index-enable
        }
    }
    return
}

# The operator's window for tool changes instead of the loop.
proc use_hal_manualtoolchange {} {
    hal loadusr -W hal_manualtoolchange
    hal delsig tool:change-loop
    hal net tool:change <= iocontrol.0.tool-change
    hal net tool:change => hal_manualtoolchange.change
    hal net tool:changed <= hal_manualtoolchange.changed
    hal net tool:changed => iocontrol.0.tool-changed
    hal net tool:prep-number <= iocontrol.0.tool-prep-number
    hal net tool:prep-number => hal_manualtoolchange.number
    return
}

# A spindle with acceleration limit, inertia, at-speed, index and orientation.
proc sim_spindle {} {
    hal loadrt limit2 names=limit_speed
    hal loadrt lowpass names=spindle_mass
    hal loadrt near names=near_speed
    hal loadrt sim_spindle names=sim_spindle
    hal loadrt scale names=rpm_rps
    foreach name {limit_speed spindle_mass near_speed rpm_rps sim_spindle} { hal addf $name servo-thread }
    do_setp sim_spindle.scale 0.01666667
    do_setp limit_speed.maxv 5000.0
    do_setp spindle_mass.gain .07
    do_setp near_speed.scale 1.1
    do_setp near_speed.difference 10
    do_setp rpm_rps.gain .0167
    hal net spindle-speed-cmd <= spindle.0.speed-out
    hal net spindle-speed-cmd => limit_speed.in near_speed.in1
    hal net spindle-speed-limited <= limit_speed.out
    hal net spindle-speed-limited => sim_spindle.velocity-cmd spindle_mass.in
    hal net spindle-rpm-filtered <= spindle_mass.out
    hal net spindle-rpm-filtered => rpm_rps.in near_speed.in2
    hal net spindle-rps-filtered <= rpm_rps.out
    hal net spindle-rps-filtered => spindle.0.speed-in
    hal net spindle-index-enable <=> spindle.0.index-enable
    hal net spindle-index-enable <=> sim_spindle.index-enable
    hal net spindle-pos <= sim_spindle.position-fb
    hal net spindle-pos => spindle.0.revs
    hal net spindle-at-speed <= near_speed.out
    hal net spindle-at-speed => spindle.0.at-speed
    hal net spindle-orient <= spindle.0.orient
    hal net spindle-orient => spindle.0.is-oriented
    return
}

# Writes the HAL commands that would make the present state again (not in the first pass of
# TWOPASS, when there is none yet).
proc save_hal_cmds {savefile {options ""}} {
    if {[llength [info commands ::tp::passnumber]] && [::tp::passnumber] == 0} return
    set how [expr {[llength $::HAL(HALFILE)] > 1 ? "allu" : "all"}]
    if {[catch {
        set out [open $savefile w]
        puts $out "# HAL commands of [ini_value EMC MACHINE machine], written by basic_sim.tcl; a copy to read, not loaded"
        close $out
        hal save $how $savefile.new
        set in [open $savefile.new]
        set out [open $savefile a]
        fcopy $in $out
        close $in
        close $out
        file delete $savefile.new
    } message]} {
        catch {file delete $savefile.new}
        puts "save_hal_cmds: $savefile not written: $message"
    }
    return
}
