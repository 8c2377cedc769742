# SPDX-License-Identifier: GPL-2.0-or-later
# util_lib.tcl - procedures that show what a haltcl file was given, and joints of axis letters.

# Prints every variable of the INI file that is known, as ::SECTION(NAME) = list of values.
proc show_ini {} {
    foreach array [lsort [info globals]] {
        if {![array exists ::$array] || $array in {env auto_index tcl_platform tcl_pkgPath}} continue
        if {[string toupper $array] ne $array} continue
        foreach name [lsort [array names ::$array]] {
            puts "::${array}($name) = [set ::${array}($name)]"
        }
    }
    return
}

# Prints where the file runs: script, arguments, directory, version of Tcl.
proc show_context {} {
    puts "script      = [info script]"
    puts "argv0       = [expr {[info exists ::argv0] ? $::argv0 : ""}]"
    puts "argv        = [expr {[info exists ::argv] ? $::argv : ""}]"
    puts "pwd         = [pwd]"
    puts "tcl_version = $::tcl_version"
    return
}

# Prints the environment.
proc show_env {} {
    foreach name [lsort [array names ::env]] { puts "$name = $::env($name)" }
    return
}

# joint_number_for_axis -- number of the (first) joint of an axis letter with trivkins, from the
# variables TRAJ_COORDINATES and KINS_KINEMATICS of the environment. Other kinematics: an error.
proc joint_number_for_axis {letter} {
    set kinematics $::env(KINS_KINEMATICS)
    if {[lindex $kinematics 0] ne "trivkins"} {
        error "joint_number_for_axis: joints of '[lindex $kinematics 0]' do not belong to one axis each"
    }
    set letters [string toupper [string map {" " "" "\t" ""} $::env(TRAJ_COORDINATES)]]
    set plain XYZABCUVW
    foreach word [lrange $kinematics 1 end] {
        if {[regexp -nocase {^coordinates=(.+)$} $word -> given]} { set plain [string toupper $given] }
    }
    set letter [string toupper $letter]
    set joint [string first $letter $plain]
    if {$joint < 0 || [string first $letter $letters] < 0} {
        error "joint_number_for_axis: no axis '$letter' in '$letters'"
    }
    return $joint
}
