# SPDX-License-Identifier: GPL-2.0-or-later
#
# twopass.tcl - reads all [HAL]HALFILE entries twice, so that several files may load parts of
# one module. Run by haltcl -i INIFILE (halcmd_twopass, the launcher).
#
#   pass 0  collects loadrt, starts loadusr programs, skips everything else; at its end each
#           module is loaded once with the sum of what was asked for
#   pass 1  executes everything but loadrt and loadusr
#
# .hal files become Tcl files /tmp/tmp_NAME first. [HAL]TWOPASS may say verbose, nodelete.
# Thread: [task]. Source: HAL tools reference section 5, launcher reference section 4.

namespace eval ::tp {
    variable pass 0
    variable options [dict create verbose 0 nodelete 0]
    variable files {}            ;# list of {kind path arguments shown-name}
    variable modules [dict create] ;# name -> dict of collected parameters
    variable before {}           ;# components that were there when we began
    variable addfs {}            ;# functions and threads seen in pass 0
    variable failed 0
    variable temporary {}
    # Commands that stay themselves in pass 0, as Tcl has commands of these names.
    variable untouched {list gets source}
}

proc ::tp::say {text} { puts "twopass:$text" }

# passnumber -- 0 or 1; for user's files.
proc ::tp::passnumber {} {
    variable pass
    return $pass
}

# no_puts, alter_puts, restore_puts -- silence puts, mark its lines with the pass, undo both.
proc ::tp::no_puts {} {
    restore_puts
    rename ::puts ::tp::real_puts
    proc ::puts {args} {}
}
proc ::tp::alter_puts {} {
    restore_puts
    rename ::puts ::tp::real_puts
    proc ::puts {args} {
        set text [lindex $args end]
        ::tp::real_puts {*}[lrange $args 0 end-1] "twopass:pass[::tp::passnumber]: $text"
    }
}
proc ::tp::restore_puts {} {
    if {[info commands ::tp::real_puts] eq ""} return
    rename ::puts {}
    rename ::tp::real_puts ::puts
}

# ---- Files ----

proc ::tp::read_options {} {
    variable options
    set given ""
    if {[info exists ::HAL(TWOPASS)]} { set given [string tolower [join $::HAL(TWOPASS)]] }
    set on {}
    foreach name [dict keys $options] {
        if {[string first $name $given] >= 0} {
            dict set options $name 1
            lappend on $name
        }
    }
    say "invoked with <$on> options"
}

proc ::tp::find_files {} {
    variable files
    if {![info exists ::HAL(HALFILE)]} { return }
    foreach entry $::HAL(HALFILE) {
        set words [regexp -all -inline {\S+} $entry]
        if {![llength $words]} break
        set name [lindex $words 0]
        if {[catch {find_file_in_hallib_path $name} path]} {
            say "CANNOT FIND FILE FOR:$name"
            puts stderr $path
            exit 1
        }
        say "found $path"
        set kind [expr {[file extension $path] eq ".tcl" ? "tcl" : "hal"}]
        lappend files [list $kind $path [lrange $words 1 end]]
    }
}

# ---- From .hal to Tcl ----

proc ::tp::read_file {path} {
    set f [open $path r]
    set text [read $f]
    close $f
    regsub {^(\ufeff|\u00ef\u00bb\u00bf)} $text {} text ;# the byte order mark of some editors, in either encoding
    return $text
}

# convert_line -- a logical line of a .hal file as Tcl: references become variables, other
# characters that mean something to Tcl are protected, a comment at the end is kept.
proc ::tp::convert_line {line} {
    set out ""
    set quote ""
    while {$line ne ""} {
        if {$quote eq "" && [regexp {^#} $line]} { return "[string trimright $out] ;$line" }
        if {[regexp {^\[([^\]]*)\]\(([^)]*)\)(.*)$} $line -> section name line] ||
            [regexp {^\[([^\]]*)\]([0-9A-Za-z._-]+)(.*)$} $line -> section name line]} {
            append out "\$::${section}(${name})"
            continue
        }
        if {[regexp {^\$\(([^)]*)\)(.*)$} $line -> name line] ||
            [regexp {^\$([0-9A-Za-z._-]+)(.*)$} $line -> name line]} {
            append out "\$::env(${name})"
            continue
        }
        set c [string index $line 0]
        set line [string range $line 1 end]
        if {$quote eq "" && $c in {\" '}} { set quote $c } elseif {$c eq $quote} { set quote "" }
        if {$c in {\[ \] \$ \{ \} ; \\}} { append out \\ }
        append out $c
    }
    return $out
}

# convert -- the Tcl text of a .hal file, or "" if it says #NOTWOPASS.
proc ::tp::convert {path} {
    set out "# made of $path\n"
    set pending ""
    foreach line [split [read_file $path] "\n"] {
        set line [string trimright $line "\r"]
        if {[string match -nocase "#notwopass*" [string map {" " "" "\t" ""} $line]]} { return "" }
        if {[string index $line end] eq "\\"} {
            append pending [string range $line 0 end-1]
            continue
        }
        set line [string trim $pending$line]
        set pending ""
        if {$line eq "" || [string index $line 0] eq "#"} continue
        switch -- [lindex [split $line " \t"] 0] {
            list {
                puts stderr "twopass: note: 'list' in $path is executed as 'puts \[hal list ...\]'"
                append out "puts \[hal [convert_line $line]\]\n"
            }
            gets {
                puts stderr "twopass: $path: 'gets' cannot be used with TWOPASS: $line"
                exit 1
            }
            source {
                set inner [convert_to_file [string trim [string range $line 6 end]]]
                if {$inner ne ""} { append out "source [list $inner]\n" }
            }
            default { append out "[convert_line $line]\n" }
        }
    }
    return $out
}

# convert_to_file -- the path of the Tcl file made of a .hal file; "" if it was run at once.
proc ::tp::convert_to_file {path} {
    variable temporary
    set text [convert $path]
    if {$text eq ""} {
        say "NOTWOPASS: $path"
        exec halcmd -vkf $path >@stdout 2>@stderr &
        return ""
    }
    set to /tmp/tmp_[file tail $path]
    if {[info exists ::env(KERF_INSTANCE)] && $::env(KERF_INSTANCE) ne ""} { append to .$::env(KERF_INSTANCE) }
    file delete $to
    set f [open $to {WRONLY CREAT EXCL} 0600]
    puts -nonewline $f $text
    close $f
    if {$to ni $temporary} { lappend temporary $to }
    return $to
}

proc ::tp::convert_files {} {
    variable files
    set converted {}
    foreach file $files {
        lassign $file kind path arguments
        if {$kind eq "hal"} { set path [convert_to_file $path] }
        if {$path ne ""} { lappend converted [list $path $arguments [lindex $file 1]] }
    }
    set files $converted
}

# ---- Pass 0 ----

# words -- arguments as halcmd would see them: values of INI variables are lists, and a value
# with blanks counts as several words.
proc ::tp::words {arguments} {
    set all {}
    foreach argument $arguments {
        foreach value $argument { foreach word [regexp -all -inline {\S+} $value] { lappend all $word } }
    }
    return $all
}

# loadrt_substitute -- adds the parameters of one loadrt to those of its module.
proc ::tp::loadrt_substitute {args} {
    variable modules
    variable before
    set arguments [lassign [words $args] module]
    if {$module in $before} { error "loadrt_substitute: $module already loaded" }
    if {![dict exists $modules $module]} {
        dict set modules $module [dict create form "" count 0 names {} personality {} debug "" other {}]
    }
    foreach argument $arguments {
        if {![regexp {^([^=]*)=(.*)$} $argument -> key value]} {
            dict set modules $module other [linsert [dict get $modules $module other] end $argument]
            continue
        }
        switch -- $key {
            count - num_chan - names {
                set form [dict get $modules $module form]
                if {$form eq ""} { dict set modules $module form $key } elseif {$form ne $key} {
                    error "loadrt_substitute: cannot mix count=, num_chan= and names= forms\
                           (module=$module, first used form=$form=, now $key=)"
                }
                if {$key eq "names"} { append_to $module names $value } else {
                    dict set modules $module count [expr {[dict get $modules $module count] + $value}]
                }
            }
            personality { append_to $module personality $value }
            debug {
                set debug [dict get $modules $module debug]
                dict set modules $module debug [expr {$debug eq "" ? $value : $debug | $value}]
            }
            default { append_to $module other $argument }
        }
    }
}

proc ::tp::append_to {module key value} {
    variable modules
    dict set modules $module $key [linsert [dict get $modules $module $key] end $value]
}

proc ::tp::load_modules {} {
    variable modules
    dict for {module want} $modules {
        set arguments {}
        switch -- [dict get $want form] {
            count - num_chan { lappend arguments [dict get $want form]=[dict get $want count] }
            names { lappend arguments names=[join [dict get $want names] ,] }
        }
        if {[llength [dict get $want personality]]} {
            lappend arguments personality=[join [dict get $want personality] ,]
        }
        if {[dict get $want debug] ne ""} { lappend arguments debug=[dict get $want debug] }
        lappend arguments {*}[dict get $want other]
        verbose "pass0: loadrt $module $arguments"
        hal loadrt $module {*}$arguments
    }
}

proc ::tp::verbose {text} {
    variable options
    if {[dict get $options verbose]} { say $text }
}

proc ::tp::loadusr_substitute {args} {
    set arguments [words $args]
    say "pass0: loadusr $arguments"
    set program ""
    for {set i 0} {$i < [llength $arguments]} {incr i} {
        set word [lindex $arguments $i]
        if {![string match -* $word]} {
            set program $word
            break
        }
        if {[string match *n $word]} { incr i }
    }
    set file [string map [list ~/ $::env(HOME)/] $program]
    if {$program ne "" && [auto_execok $file] eq "" && [auto_execok [regsub {\.py$} $file ""]] eq ""} {
        say "loadusr <$program> not found"
        puts "Continuing"
        return
    }
    hal loadusr {*}$arguments
}

proc ::tp::addf_substitute {args} {
    variable addfs
    lappend addfs [words $args]
}

# ---- The commands of each pass ----

proc ::tp::set_commands {how} {
    variable untouched
    foreach name [hal --commands] {
        if {$name in $untouched} continue
        if {[info commands ::tp::saved_$name] eq "" && [info commands ::$name] ne ""} {
            rename ::$name ::tp::saved_$name
        }
        if {[info commands ::$name] ne ""} { rename ::$name {} }
        switch -- $how/$name {
            0/loadrt { interp alias {} ::loadrt {} ::tp::loadrt_substitute }
            0/loadusr { interp alias {} ::loadusr {} ::tp::loadusr_substitute }
            0/addf { interp alias {} ::addf {} ::tp::addf_substitute }
            1/loadrt - 1/loadusr { proc ::$name {args} {} }
            default {
                if {$how == 0} { proc ::$name {args} {} } else {
                    proc ::$name {args} "uplevel 1 \[list ::tp::run_command [list $name] {*}\$args\]"
                }
            }
        }
    }
    # The command hal itself does the same as the commands: in pass 0 nothing but questions and the
    # substitutes, in pass 1 all but loading.
    if {[info commands ::tp::real_hal] eq ""} { rename ::hal ::tp::real_hal }
    if {$how == 0} {
        proc ::hal {args} {
            if {[lindex $args 0] in {list show getp ptype stype --commands}} { return [::tp::real_hal {*}$args] }
            if {[lindex $args 0] in {loadrt loadusr addf}} {
                return [::tp::[lindex $args 0]_substitute {*}[lrange $args 1 end]]
            }
        }
    } else {
        proc ::hal {args} {
            if {[lindex $args 0] in {loadrt loadusr}} return
            uplevel 1 [list ::tp::real_hal {*}$args]
        }
    }
}

# run_command -- a command of a file in pass 1: INI values with blanks are several words.
proc ::tp::run_command {name args} {
    if {$name in {setp sets show}} { return [uplevel 1 [list ::tp::saved_$name {*}$args]] }
    return [hal $name {*}[words $args]]
}

proc ::tp::source_files {} {
    variable files
    variable failed
    foreach file $files {
        lassign $file path arguments name
        set ::argv $arguments
        set ::argc [llength $arguments]
        if {[catch {uplevel #0 [list source $path]} message]} {
            puts stderr "twopass: Error in file $name:\n    $message"
            verbose $::errorInfo
            set failed 1
        }
    }
    restore_puts
    if {$failed} { finish 1 }
}

proc ::tp::finish {status} {
    variable temporary
    variable options
    if {![dict get $options nodelete]} { file delete {*}$temporary }
    exit $status
}

proc ::tp::main {} {
    variable pass
    variable failed
    variable before
    read_options
    find_files
    convert_files
    set before [hal list comp]
    set pass 0
    set_commands 0
    # Our own loading must reach HAL.
    interp alias {} ::tp::hal {} ::tp::real_hal
    source_files
    if {[catch load_modules message]} {
        puts stderr "twopass: Error in pass 0:\n    $message"
        finish 1
    }
    set pass 1
    foreach name [array names ::HAL] { unset ::HAL($name) }
    foreach section [emc_ini_sections] { catch { uplevel #0 [list array unset $section] } }
    uplevel #0 [list parse_ini $::env(INI_FILE_NAME)]
    set_commands 1
    source_files
    finish 0
}

if {![info exists ::env(HALLIB_DIR)]} {
    set ::env(HALLIB_DIR) [expr {$::linuxcnc::RUN_IN_PLACE eq "yes" ?
        [file join $::linuxcnc::HOME lib hallib] : [file join $::linuxcnc::HOME share linuxcnc hallib]}]
}
source [file join $::env(HALLIB_DIR) hal_procs_lib.tcl]
::tp::main
