# SPDX-License-Identifier: GPL-2.0-or-later
#
# hal_procs_lib.tcl - questions about HAL for Tcl files that are run by haltcl.
#
# They read what `hal show` prints: two lines of headings, then one row for each item.
# Thread: [task].

# pin_exists -- 1 if there is a pin of that name, else 0.
proc pin_exists {name} {
    return [expr {[llength [hal list pin $name]] && $name in [hal list pin $name]}]
}

# find_file_in_hallib_path -- the path of a file: LIB:x is HALLIB_DIR/x, an absolute path
# stands as it is, others are looked for along HALLIB_PATH (default: . and HALLIB_DIR).
# Words after the name are ignored.
proc find_file_in_hallib_path {filename {only_hallib_path 0}} {
    set file [lindex [split $filename] 0]
    if {[string match LIB:* $file]} {
        set file [file join $::env(HALLIB_DIR) [string range $file 4 end]]
        if {[file readable $file]} { return $file }
        error "find_file_in_hallib_path: cannot find: <$filename>"
    }
    if {[string match ~/* $file]} { set file $::env(HOME)[string range $file 1 end] }
    if {[file pathtype $file] eq "absolute"} {
        if {[file readable $file]} { return $file }
        error "find_file_in_hallib_path: cannot find: <$filename>"
    }
    if {[info exists ::env(HALLIB_PATH)]} {
        set dirs [split $::env(HALLIB_PATH) :]
    } else {
        set dirs [list . $::env(HALLIB_DIR)]
    }
    foreach dir $dirs {
        set path [file join $dir $file]
        if {[file readable $path] && ![file isdirectory $path]} { return $path }
    }
    error "find_file_in_hallib_path: cannot find: <$filename>"
}

# hal_rows -- the rows of `hal show TYPE PATTERN`, each a list of its columns.
proc hal_rows {type {pattern ""}} {
    set text [expr {$pattern eq "" ? [hal show $type] : [hal show $type $pattern]}]
    set rows {}
    foreach line [lrange [split $text "\n"] 2 end] {
        set row [regexp -all -inline {\S+} $line]
        if {[llength $row]} { lappend rows $row }
    }
    return $rows
}

# connection_info -- sets the variable named by result to a dict of the pin's owner, type, dir,
# value, and of its signal (if linked) arrow and signame, inputs, outputs and ios of that
# signal. Returns 1, or 0 if there is no such pin.
proc connection_info {result pinname} {
    upvar 1 $result info
    set info [dict create]
    foreach row [hal_rows pin $pinname] {
        lassign $row owner type dir value name arrow signal
        if {$name ne $pinname} continue
        set info [dict create owner $owner type $type dir $dir value $value pinname $name \
                      arrow $arrow signame $signal inputs {} outputs {} ios {}]
        if {$signal ne ""} { signal_pins info $signal }
        return 1
    }
    return 0
}

# signal_pins -- appends the pins of a signal to inputs, outputs and ios of a dict.
proc signal_pins {dictname signal} {
    upvar 1 $dictname info
    set current ""
    foreach row [hal_rows sig $signal] {
        switch -- [lindex $row 0] {
            ==> { set list inputs }
            <== { set list outputs }
            <=> { set list ios }
            default {
                set current [lindex $row 2]
                continue
            }
        }
        if {$current eq $signal} { dict lappend info $list [lindex $row 1] }
    }
}

# is_connected -- how a pin is linked: is_input, is_output, is_io or not_connected. The variable
# named by signal_var is set to the name of its signal.
proc is_connected {pinname {signal_var ""}} {
    if {![connection_info info $pinname]} { error "is_connected: no pin $pinname" }
    if {$signal_var ne ""} {
        upvar 1 $signal_var signal
        set signal [dict get $info signame]
    }
    switch -- [dict get $info arrow] {
        <== { return is_input }
        ==> { return is_output }
        <=> { return is_io }
        default { return not_connected }
    }
}

# thread_info -- sets the variable named by result to a dict with the names of threads
# (threadnames, the fastest first) and for each thread NAME,period (ns) and NAME,addf (its
# functions in order); returns the names.
proc thread_info {result} {
    upvar 1 $result info
    set info [dict create threadnames {}]
    set name ""
    foreach row [hal_rows thread] {
        if {[llength $row] >= 4} {
            lassign $row period fp name
            dict set info threadnames [linsert [dict get $info threadnames] 0 $name]
            dict set info $name,period $period
            dict set info $name,fp $fp
            dict set info $name,addf {}
        } elseif {$name ne ""} {
            dict lappend info $name,addf [lindex $row 1]
        }
    }
    return [dict get $info threadnames]
}

# get_netlist -- sets the variables named by inputs, outputs and ios to the pins of a signal.
proc get_netlist {inputs outputs ios signal} {
    upvar 1 $inputs in $outputs out $ios io
    set info [dict create inputs {} outputs {} ios {}]
    signal_pins info $signal
    set in [dict get $info inputs]
    set out [dict get $info outputs]
    set io [dict get $info ios]
}
