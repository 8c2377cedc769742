# SPDX-License-Identifier: GPL-2.0-or-later
#
# linuxcnc.tcl - package Linuxcnc: places of this installation, INI files for Tcl, the
# command `hal` (loaded on first use), images and fonts.
#
# Thread: [task]. Source: HAL tools reference section 4, INI reference section 4 (Tcl).

package require Tcl 8.6

namespace eval ::linuxcnc {
    # The tree is found from the place of this file: TOP/tcl, or PREFIX/share/tcltk/linuxcnc.
    variable TCL_DIR [file dirname [file normalize [info script]]]
    variable RUN_IN_PLACE [expr {[file isdirectory [file join $TCL_DIR .. rtlib]] ? "yes" : "no"}]
    variable HOME
    variable BIN_DIR
    variable HELP_DIR
    variable RTLIB_DIR
    variable CONFIG_PATH
    variable NCFILES_DIR
    variable LANG_DIR
    variable IMAGEDIR
    variable REALTIME
    variable USER_CONFIG_DIR [file join ~ linuxcnc configs]
    variable TMP_DIR /tmp
    variable TCL_LIB_DIR $TCL_DIR
    variable TCL_BIN_DIR [file join $TCL_DIR bin]
    variable TCL_SCRIPT_DIR [file join $TCL_DIR scripts]
    variable RTS uspace
    variable LINUXCNC_AUX_GLADEVCP /usr/share/linuxcnc/aux_gladevcp
    variable LINUXCNC_AUX_EXAMPLES /usr/share/linuxcnc/aux_examples
    variable CONFIG_DIR

    if {$RUN_IN_PLACE eq "yes"} {
        set HOME [file dirname $TCL_DIR]
        set BIN_DIR [file join $HOME bin]
        set HELP_DIR [file join $HOME docs help]
        set RTLIB_DIR [file join $HOME rtlib]
        set NCFILES_DIR [file join $HOME nc_files]
        set LANG_DIR [file join $HOME src objects]
        set IMAGEDIR $HOME
        set REALTIME [file join $HOME scripts realtime]
        set CONFIG_PATH [list [file normalize $USER_CONFIG_DIR] [file join $HOME configs]]
    } else {
        set HOME [file normalize [file join $TCL_DIR .. .. ..]]
        set BIN_DIR [file join $HOME bin]
        set HELP_DIR [file join $HOME share doc linuxcnc]
        set RTLIB_DIR [file join $HOME lib linuxcnc modules]
        set NCFILES_DIR [file join $HOME share linuxcnc ncfiles]
        set LANG_DIR [file join $TCL_DIR msgs]
        set IMAGEDIR [file join $HOME share linuxcnc]
        set REALTIME [file join $HOME lib linuxcnc realtime]
        set CONFIG_PATH [list [file normalize $USER_CONFIG_DIR] /usr/local/etc/linuxcnc/configs \
                             [file join $HOME share doc linuxcnc examples sample-configs]]
    }
    set CONFIG_DIR $CONFIG_PATH

    variable image_path [list . $IMAGEDIR [file join $HOME share linuxcnc] [file join $HOME share axis images]]
}

load [file join $::linuxcnc::TCL_DIR linuxcnc.so] Linuxcnc

# hal -- the HAL commands; the package Hal is loaded when the first one is given.
if {[info commands ::hal] eq ""} {
    proc ::hal {args} {
        rename ::hal {}
        package require Hal
        uplevel 1 [list ::hal {*}$args]
    }
}

# linuxcnc::image_search -- a Tk photo made of the first file of that name (with or without
# .gif or .png) along the image path. An error names the places when there is none.
proc ::linuxcnc::image_search {name} {
    variable image_path
    foreach dir $image_path {
        foreach ending {"" .gif .png} {
            set file [file join $dir $name$ending]
            if {[file isfile $file]} { return [image create photo -file $file] }
        }
    }
    error "image_search: no $name in $image_path"
}

# linuxcnc::standard_font* -- the fonts that Tk's default text styles have.
proc ::linuxcnc::standard_font_size {} { return [font actual TkDefaultFont -size] }
proc ::linuxcnc::standard_font_family {} { return [font actual TkDefaultFont -family] }
proc ::linuxcnc::standard_font {} { return [list [standard_font_family] [standard_font_size]] }
proc ::linuxcnc::standard_fixed_font_family {} { return [font actual TkFixedFont -family] }
proc ::linuxcnc::standard_fixed_font {} { return [list [standard_fixed_font_family] [standard_font_size]] }

# parse_ini -- makes one array per section in the caller's scope: element VARIABLE is the list
# of all its values in file order. Existing elements are appended to.
proc ::parse_ini {filename} {
    if {[info exists ::env(INI_FILE_NAME)]} {
        if {$filename ne $::env(INI_FILE_NAME)} {
            error "parse_ini: fatal: requested filename ($filename) and env(INI_FILE_NAME)\
                   ($::env(INI_FILE_NAME)) are not the same."
        }
    } elseif {$filename ne [emc_ini_filename]} {
        error "parse_ini: fatal: requested filename ($filename) and underlying filename\
               ([emc_ini_filename]) are not the same."
    }
    if {![emc_ini_load $filename]} {
        error "parse_ini: fatal: cannot parse ($filename)."
    }
    foreach section [emc_ini_sections] {
        foreach pair [emc_ini_variables $section] {
            lassign $pair name value
            uplevel 1 [list lappend ${section}(${name}) $value]
        }
    }
}

package provide Linuxcnc 1.0
