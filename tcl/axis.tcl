# SPDX-License-Identifier: GPL-2.0-or-later
# axis.tcl -- widgets of the AXIS screen. Built once by lib/python/axis/app.py, which provides the
# commands that menus, buttons and keys call, the variables they show, and `_` (translation).
#
# The paths of the widgets are an interface: panels and user files refer to them (GUI reference,
# section 2). Nothing here decides; update_state shows what is possible in the present state.

package require BWidget

namespace eval ::axis {
    variable accel_pattern {_(.)}
    variable homed_extra {}
    variable jog_held 0
}

# -- labels with accelerators --------------------------------------------------------------

# The text without its underscore, and the place of the accelerator letter (-1: none).
proc ::axis::split_accel {text} {
    set at [string first _ $text]
    if {$at < 0 || $at == [string length $text] - 1} { return [list $text -1] }
    return [list [string replace $text $at $at] $at]
}

proc setup_widget_accel {w text} {
    lassign [::axis::split_accel $text] label at
    $w configure -text $label
    if {$at >= 0} {
        catch {$w configure -underline $at}
        bind . <Alt-[string tolower [string index $label $at]]> [list ::axis::accel $w]
    }
}

proc ::axis::enabled {w} { return [expr {[$w cget -state] ne "disabled"}] }

proc ::axis::accel {w} {
    if {[winfo viewable $w] && [enabled $w]} { catch {$w invoke} }
}

# The entry's label with its accelerator letter.
proc setup_menu_accel {m entry text} {
    lassign [::axis::split_accel $text] label at
    $m entryconfigure $entry -label $label -underline $at
}

# -- state of widgets ----------------------------------------------------------------------

# state EXPRESSION WIDGET... -- enables or disables widgets; a list {menu label} is a menu entry. User code may have removed any.
proc state {condition args} {
    set value [expr {[uplevel #0 [list expr $condition]] ? "normal" : "disabled"}]
    foreach w $args {
        if {[llength $w] > 1} {
            lassign $w menu label
            set at [::axis::menu_entry $menu [_ $label]]
            if {$at >= 0} { $menu entryconfigure $at -state $value }
        } elseif {[winfo exists $w] && [$w cget -state] ne $value} {
            $w configure -state $value
        }
    }
}

# Index of the entry with this label, or -1.
proc ::axis::menu_entry {menu label} {
    set wanted [lindex [::axis::split_accel $label] 0]
    set last [$menu index end]
    for {set i 0} {$last ne "none" && $i <= $last} {incr i} {
        if {[$menu type $i] ni {separator tearoff} && [$menu entrycget $i -label] eq $wanted} { return $i }
    }
    return -1
}

# relief EXPRESSION WIDGET -- shows a button pressed.
proc relief {condition w} {
    if {![winfo exists $w]} return
    set ::axis::pressed($w) $condition
    set pressed [uplevel #0 [list expr $condition]]
    $w configure -relief [expr {$pressed ? "sunken" : "flat"}] \
        -background [expr {$pressed ? $::axis::colour(chosen) : $::axis::colour(face)}]
}

# When the mouse is let go or leaves, Tk gives a button the relief back that it had before it was pressed: that of a
# machine which has done meanwhile what the button says.
proc ::axis::relief_again {w} {
    if {[info exists ::axis::pressed($w)]} { relief $::axis::pressed($w) $w }
}

# -- what users remove -----------------------------------------------------------------------

# A user's file may destroy widgets of the screen. The screen goes on to configure them: they only go out of sight.
proc ::axis::keep {w} {
    set ::axis::kept($w) 1
    foreach child [winfo children $w] { keep $child }
}

proc ::axis::replace_destroy {} {
    foreach w [winfo children .] { keep $w }
    rename ::destroy ::axis::really_destroy
    proc ::destroy {args} {
        foreach w $args {
            if {[info exists ::axis::kept($w)]} { ::axis::out_of_sight $w } else { ::axis::really_destroy $w }
        }
    }
}

proc ::axis::out_of_sight {w} {
    set parent [winfo parent $w]
    if {$w eq ".menu"} {
        . configure -menu {}
    } elseif {[winfo class $w] eq "Menu"} {
        for {set i [$parent index end]} {$i ne "none" && $i >= 0} {incr i -1} {
            if {[$parent type $i] eq "cascade" && [$parent entrycget $i -menu] eq $w} { $parent delete $i }
        }
    } else {
        switch [winfo manager $w] {
            wm { wm withdraw $w }
            panedwindow { $parent forget $w }
            pack - grid - place { [winfo manager $w] forget $w }
        }
    }
}

# -- tool bar ------------------------------------------------------------------------------

# Tk dims the picture of a disabled button with dots in the colour that the ground had when the button was made; all
# buttons share these dots. They get the colour of the present ground when a chosen and disabled one is drawn.
proc ::axis::renew_dots {} {
    variable first_face
    set w .toolbar.dots
    radiobutton $w -image [load_image stop] -indicatoron 0 -state disabled -variable ::axis::dots -value 1 -background $first_face
    set ::axis::dots 1
    place $w -x -200 -y 0
    update idletasks
    $w configure -background $::axis::colour(face) -selectcolor $::axis::colour(face)
    update idletasks
    destroy $w
    set f .pane.top.tabs.fmanual
    foreach drawn [concat [winfo children .toolbar] [winfo children $f.spindlef] [winfo children $f.axes] [winfo children $f.joints]] {
        $drawn configure -background [$drawn cget -background]
    }
}

proc load_image {name} { return [::axis::icon $name] }

proc ::axis::tool {name image command help} {
    set w .toolbar.$name
    button $w -image [load_image $image] -command $command -relief flat -takefocus 0 -padx 2 -pady 2
    pack $w -side left -padx 1 -pady 2
    foreach event {<ButtonRelease-1> <Leave>} { bind $w $event {after idle {::axis::relief_again %W}} }
    DynamicHelp::add $w -text $help
}

proc ::axis::rule {n} {
    frame .toolbar.rule$n -width 1 -relief flat -background $::axis::colour(line)
    pack .toolbar.rule$n -side left -fill y -padx 6 -pady 4
}

proc pause_image_normal {} { .toolbar.program_pause configure -image [load_image pause] }
proc pause_image_override {} { .toolbar.program_pause configure -image [load_image pause_inhibited] }

proc ::axis::build_toolbar {} {
    variable first_face $::axis::colour(face)
    frame .toolbar
    tool machine_estop estop {} [_ "Toggle Emergency Stop \[F1\]"]
    .toolbar.machine_estop configure -command {}
    bind .toolbar.machine_estop <Button-1> estop_clicked
    tool machine_power power onoff_clicked [_ "Toggle machine power \[F2\]"]
    rule 0
    tool file_open open {open_file} [_ "Open G-code file \[O\]"]
    tool reload reload {reload_file} [_ "Reopen current file \[Control-R\]"]
    rule 4
    tool program_run run {task_run} [_ "Begin executing current file \[R\]"]
    tool program_step step {task_step} [_ "Execute next line \[T\]"]
    tool program_pause pause {task_pauseresume} [_ "Pause \[P\] / resume \[S\] execution"]
    tool program_stop stop {task_stop} [_ "Stop program execution \[ESC\]"]
    rule 8
    tool program_blockdelete blockdelete {set ::block_delete [expr {!$::block_delete}]; toggle_block_delete} \
        [_ "Toggle skip lines with '/'"]
    tool program_optpause optpause {set ::optional_stop [expr {!$::optional_stop}]; toggle_optional_stop} \
        [_ "Toggle optional pause \[M1\]"]
    rule 9
    tool view_zoomin zoomin zoomin [_ "Zoom in"]
    tool view_zoomout zoomout zoomout [_ "Zoom out"]
    foreach {name help} {
        z "Top view" z2 "Rotated Top view" x "Side view" y "Front view" y2 "Inverted front view" p "Perspective view"
    } { tool view_$name view_$name set_view_$name [_ $help] }
    tool rotate rotate {set ::rotate_mode [expr {!$::rotate_mode}]; ::axis::show_rotate} \
        [_ "Toggle between Drag and Rotate Mode \[D\]"]
    rule 12
    tool clear_plot clear clear_live_plot [_ "Clear live plot \[Ctrl-K\]"]
    frame .toolbar.rule16
}

proc ::axis::show_rotate {} { relief {$::rotate_mode} .toolbar.rotate }

# -- menus ---------------------------------------------------------------------------------

proc ::axis::add {menu kind text args} {
    $menu add $kind {*}$args
    setup_menu_accel $menu end [_ $text]
}

proc ::axis::build_menu {} {
    menu .menu
    . configure -menu .menu
    foreach {name text} {file _File machine _Machine view _View help _Help} {
        menu .menu.$name -tearoff [expr {$name eq "machine"}]
        add .menu cascade $text -menu .menu.$name
    }
    set m .menu.file
    add $m command "_Open..." -accelerator [_ "O"] -command open_file
    menu $m.recent -tearoff 0
    add $m cascade "Recent _Files" -menu $m.recent
    add $m command "_Edit..." -command edit_program
    add $m command "_Reload" -accelerator [_ "Ctrl-R"] -command reload_file
    add $m command "_Save G-code as..." -accelerator [_ "Ctrl-S"] -command save_gcode
    add $m command "G-code _properties..." -command gcode_properties
    $m add separator
    add $m command "Edit _tool data..." -command edit_tooltable
    add $m command "Reload tool _data" -command reload_tool_table
    $m add separator
    add $m command "_Ladder Editor..." -command {::axis::tool_program classicladder}
    $m add separator
    add $m command "_Quit" -command {destroy .}

    set m .menu.machine
    add $m command "Toggle _Emergency Stop" -accelerator F1 -command estop_clicked
    add $m command "Toggle _Machine Power" -accelerator F2 -command onoff_clicked
    $m add separator
    add $m command "_Run program" -accelerator R -command task_run
    add $m command "Ru_n from selected line" -command {task_run_line}
    add $m command "S_tep" -accelerator T -command task_step
    add $m command "_Pause" -accelerator P -command task_pause
    add $m command "Re_sume" -accelerator S -command task_resume
    add $m command "Stop" -accelerator ESC -command task_stop
    add $m checkbutton "Stop at M_1" -variable optional_stop -command toggle_optional_stop
    add $m checkbutton "Skip lines with '_/'" -variable block_delete -command toggle_block_delete
    $m add separator
    add $m command "Clear MDI h_istory" -accelerator Ctrl-M -command clear_mdi_history
    add $m command "Copy from MDI history" -accelerator Ctrl-H -command mdi_history_hist2clip
    add $m command "Paste to MDI history" -accelerator Ctrl-Shift-H -command mdi_history_clip2hist
    $m add separator
    add $m command "_Calibration" -command {::axis::tool_program emccalib.tcl -- -ini $::emcini}
    add $m command "Show _Hal Configuration" -command {::axis::tool_program halshow.tcl}
    add $m command "H_al Meter" -command {::axis::tool_program halmeter}
    add $m command "Ha_l Scope" -command {::axis::tool_program halscope -- -ini $::emcini}
    add $m command "Sho_w LinuxCNC Status" -command {::axis::tool_program linuxcnctop -ini $::emcini}
    add $m command "Set _Debug Level" -command {::axis::tool_program debuglevel -ini $::emcini}
    $m add separator
    foreach {name text} {home Homin_g unhome Unhoming clearoffset "_Zero coordinate system"} {
        menu $m.$name -tearoff [expr {$name ne "clearoffset"}]
        add $m cascade $text -menu $m.$name
    }
    menu $m.touchoff -tearoff 0
    set systems {G54 G55 G56 G57 G58 G59 G59.1 G59.2 G59.3}
    for {set i 0} {$i < 9} {incr i} {
        set n [expr {$i + 1}]
        $m.clearoffset add command -label "P$n [lindex $systems $i]" -underline 1 -command [list clear_offset $n]
    }
    $m.clearoffset add command -label G92 -command {clear_offset G92}
    $m add separator
    add $m radiobutton "Tool touch off to workpiece" -variable tto_g11 -value 0 -command toggle_tto_g11
    add $m radiobutton "Tool touch off to fixture" -variable tto_g11 -value 1 -command toggle_tto_g11
    $m add separator
    add $m command "Undo touch off" -command undo_touch_off

    build_view_menu
    add .menu.help command "_About AXIS" -command {::axis::show_window .about}
    add .menu.help command "Quick _Reference" -command {::axis::show_window .keys}
}

proc ::axis::build_view_menu {} {
    set m .menu.view
    foreach {text value name} {
        "_Top view" 1 z "_Rotated Top view" 2 z2 "_Side view" 3 x "_Front view" 4 y "_Perspective view" 5 p
    } { add $m radiobutton $text -variable view_type -value $value -accelerator V -command set_view_$name }
    $m add separator
    add $m radiobutton "Display _Inches" -variable metric -value 0 -accelerator ! -command redraw
    add $m radiobutton "Display _MM" -variable metric -value 1 -accelerator ! -command redraw
    $m add separator
    foreach {text name} {
        "S_how program" show_program "Show program r_apids" show_rapids "Alpha-_blend program" program_alpha
        "Sho_w live plot" show_live_plot "Show too_l" show_tool "Show e_xtents" show_extents
    } { add $m checkbutton $text -variable $name -command toggle_$name }
    menu $m.grid -tearoff 1
    add $m cascade "_Grid" -menu $m.grid
    foreach {text name} {
        "Show offs_ets" show_offsets "Show machine limits" show_machine_limits
        "Show _velocity" show_machine_speed "Show _distance to go" show_distance_to_go
        "Large coordinate fo_nt" dro_large_font
    } { add $m checkbutton $text -variable $name -command toggle_$name }
    add $m command "_Clear live plot" -accelerator Ctrl-K -command clear_live_plot
    add $m checkbutton "Show P_yVCP panel" -variable show_pyvcppanel -accelerator Ctrl-E -command toggle_show_pyvcppanel
    $m add separator
    add $m radiobutton "Show commanded position" -variable display_type -value 1 -accelerator @ -command redraw
    add $m radiobutton "Show actual position" -variable display_type -value 0 -accelerator @ -command redraw
    $m add separator
    add $m radiobutton "Show machine position" -variable coord_type -value 0 -accelerator # -command redraw
    add $m radiobutton "Show relative position" -variable coord_type -value 1 -accelerator # -command redraw
    $m add separator
    add $m radiobutton "_Joint mode" -variable teleop_mode -value 0 -accelerator \$ -command set_teleop_mode
    add $m radiobutton "World mode" -variable teleop_mode -value 1 -accelerator \$ -command set_teleop_mode
}

# What Kerf adds, behind the documented entries.
proc ::axis::add_looks_menu {scales} {
    set m .menu.view
    $m add separator
    add $m checkbutton "Dark theme" -variable dark_theme -command ::axis::dark_theme
    add $m checkbutton "Large touch targets" -variable large_touch_targets -command ::axis::large_touch_targets
    menu $m.size -tearoff 0
    add $m cascade "Size of the interface" -menu $m.size
    foreach scale $scales {
        set label [expr {$scale == 0 ? [_ "As the screen needs"] : "[expr {round(100 * $scale)}] %"}]
        $m.size add radiobutton -label $label -variable interface_scale -value $scale -command ::axis::interface_scale
    }
}

# Starts a tool of the integrator; a missing one is told, not fatal.
proc ::axis::tool_program {name args} {
    set words [list $name {*}$args]
    foreach dir [list $::axis::tcl_dir/bin $::axis::tcl_dir] {
        if {[file readable $dir/$name] && [string match *.tcl $name]} { set words [list wish8.6 $dir/$name {*}$args] }
    }
    if {[catch {exec {*}$words &} message]} { ::axis::notify_error "$name: $message" }
}

# A radio or check button with a mark as large as the letters: Tk's own does not grow with the screen.
proc ::axis::marked {w kind} {
    $w configure -indicatoron 0 -image [load_image ${kind}_off] -selectimage [load_image ${kind}_on] -compound left -padx 4 \
        -borderwidth 0 -relief flat -offrelief flat -overrelief flat -selectcolor $::axis::colour(face)
}

# -- left side: manual control, MDI, overrides ---------------------------------------------

proc ::axis::build_manual {f} {
    label $f.axis -text [_ "Axis:"] -anchor w
    frame $f.axes
    foreach letter {x y z a b c u v w} {
        radiobutton $f.axes.axis$letter -text [string toupper $letter] -value $letter -variable ja_rbutton \
            -command axis_activated -anchor w -takefocus 0
        marked $f.axes.axis$letter radio
    }
    foreach {letter row column} {x 0 0 y 0 1 z 0 2 a 1 0 b 1 1 c 1 2 u 2 0 v 2 1 w 2 2} {
        grid $f.axes.axis$letter -row $row -column $column -padx 6 -sticky w
    }
    frame $f.joints
    for {set j 0} {$j < $::MAX_JOINTS} {incr j} {
        radiobutton $f.joints.joint$j -text $j -value $j -variable ja_rbutton -command axis_activated -anchor w -takefocus 0
        marked $f.joints.joint$j radio
        grid $f.joints.joint$j -row [expr {$j / 4}] -column [expr {$j % 4}] -padx 6 -sticky w
    }
    frame $f.jogf
    frame $f.jogf.jog
    button $f.jogf.jog.jogminus -text - -width 3 -takefocus 0
    button $f.jogf.jog.jogplus -text + -width 3 -takefocus 0
    combobox $f.jogf.jog.jogincr
    # continuous while the button is held, an increment for a whole click
    foreach {w command} {jogminus jog_minus jogplus jog_plus} {
        set b $f.jogf.jog.$w
        $b configure -command "if {!\[is_continuous\] && !\$::axis::jog_held} { $command 1 }"
        bind $b <Button-1> "if {\[is_continuous\] && \[::axis::enabled $b\]} { set ::axis::jog_held 1; $command 1 }"
        bind $b <ButtonRelease-1> {jog_stop; after idle {set ::axis::jog_held 0}}
        bind $b <Leave> {jog_stop}
    }
    pack $f.jogf.jog.jogminus $f.jogf.jog.jogplus -side left -padx 2
    pack $f.jogf.jog.jogincr -side left -padx 6 -fill x -expand 1
    frame $f.jogf.zerohome
    button $f.jogf.zerohome.home -command home_joint -takefocus 0
    setup_widget_accel $f.jogf.zerohome.home [_ "Home Axis"]
    button $f.jogf.zerohome.zero -command touch_off_system -takefocus 0
    setup_widget_accel $f.jogf.zerohome.zero [_ "Touch Off"]
    button $f.jogf.zerohome.tooltouch -command touch_off_tool -takefocus 0
    setup_widget_accel $f.jogf.zerohome.tooltouch [_ "Tool Touch Off"]
    pack $f.jogf.zerohome.home $f.jogf.zerohome.zero $f.jogf.zerohome.tooltouch -side left -padx 2
    checkbutton $f.jogf.override -variable override_limits -command toggle_override_limits -anchor w -takefocus 0
    setup_widget_accel $f.jogf.override [_ "Override Limits"]
    marked $f.jogf.override check
    pack $f.jogf.jog -fill x -pady 2
    pack $f.jogf.zerohome -fill x -pady 2
    pack $f.jogf.override -fill x

    frame $f.space1 -height $::axis::gap
    label $f.spindlel -text [_ "Spindle:"] -anchor w
    frame $f.spindlef
    frame $f.spindlef.row1
    frame $f.spindlef.row2
    foreach {w image value} {ccw spindle_ccw -1 stop spindle_stop 0 cw spindle_cw 1} {
        radiobutton $f.spindlef.$w -image [load_image $image] -indicatoron 0 -value $value -variable spindledir \
            -command spindle -takefocus 0 -selectcolor $::axis::colour(chosen) -padx 4 -pady 4
        pack $f.spindlef.$w -in $f.spindlef.row1 -side left -padx 2
    }
    button $f.spindlef.spindleminus -text - -width 2 -takefocus 0
    button $f.spindlef.spindleplus -text + -width 2 -takefocus 0
    foreach {w command} {spindleminus spindle_decrease spindleplus spindle_increase} {
        set b $f.spindlef.$w
        bind $b <Button-1> "if {\[::axis::enabled $b\]} { $command; set ::axis::spindle_held 1 }"
        bind $b <ButtonRelease-1> {if {[info exists ::axis::spindle_held]} { spindle_constant; unset ::axis::spindle_held }}
    }
    pack $f.spindlef.spindleminus $f.spindlef.spindleplus -in $f.spindlef.row2 -side left -padx 2
    checkbutton $f.spindlef.brake -variable brake -command brake -anchor w -takefocus 0
    setup_widget_accel $f.spindlef.brake [_ "Brake"]
    marked $f.spindlef.brake check
    pack $f.spindlef.brake -in $f.spindlef.row2 -side left -padx 6
    pack $f.spindlef.row1 $f.spindlef.row2 -anchor w -pady 2
    frame $f.space2 -height $::axis::gap
    label $f.coolant -text [_ "Coolant:"] -anchor w
    checkbutton $f.mist -variable mist -command mist -anchor w -takefocus 0
    checkbutton $f.flood -variable flood -command flood -anchor w -takefocus 0
    setup_widget_accel $f.mist [_ "Mist"]
    setup_widget_accel $f.flood [_ "Flood"]
    marked $f.mist check
    marked $f.flood check

    set row -1
    foreach {label content} {
        axis axes {} jogf {} space1 spindlel spindlef {} space2 coolant mist {} flood
    } {
        incr row
        if {$label ne ""} { grid $f.$label -row $row -column 0 -sticky nw -padx 4 -pady 2 }
        grid $f.$content -row $row -column 1 -sticky ew -pady 1
    }
    grid $f.joints -row 0 -column 1 -sticky ew
    grid remove $f.joints
    grid columnconfigure $f 1 -weight 1
}

proc combobox {w} {
    ttk::combobox $w -textvariable jogincrement -state readonly -width 12 -takefocus 0
    bind $w <<ComboboxSelected>> {focus .}
    bind $w <FocusIn> {after idle {::axis::give_back_focus %W}}
}

# A list that was closed without a choice does not keep the keyboard.
proc ::axis::give_back_focus {w} {
    if {[winfo exists $w] && [focus] eq $w && !([winfo exists $w.popdown] && [winfo ismapped $w.popdown])} { focus . }
}

proc ::axis::build_mdi {f} {
    label $f.historyl -text [_ "History:"] -anchor w
    listbox $f.history -selectmode extended -exportselection 0 -yscrollcommand [list $f.history.sby set] -takefocus 0 \
        -width 28 -height 6
    scrollbar $f.history.sby -command [list $f.history yview] -takefocus 0
    pack $f.history.sby -side right -fill y
    pack propagate $f.history 0
    frame $f.vs1 -height 4
    label $f.commandl -text [_ "MDI Command:"] -anchor w
    entry $f.command -textvariable mdi_command
    button $f.go -command send_mdi -takefocus 0 -padx 6
    setup_widget_accel $f.go [_ "Go"]
    frame $f.vs2 -height 4
    grid $f.historyl -row 0 -column 0 -columnspan 2 -sticky w
    grid $f.history -row 1 -column 0 -columnspan 2 -sticky nsew
    grid $f.vs1 -row 2
    grid $f.commandl -row 3 -column 0 -columnspan 2 -sticky w
    grid $f.command -row 4 -column 0 -sticky ew
    grid $f.go -row 4 -column 1 -padx 4
    label $f.waitingl -text [_ "Waiting (double click cancels):"] -anchor w
    listbox $f.waiting -exportselection 0 -takefocus 0 -width 28 -height 3
    grid rowconfigure $f 1 -weight 1
    grid columnconfigure $f 0 -weight 1
    bind $f.waiting <Double-Button-1> {mdi_cancel %x %y; break}
    bind $f.command <Key-Return> {send_mdi; break}
    bind $f.command <Key-KP_Enter> {send_mdi; break}
    foreach {key command} {Up mdi_up_cmd Down mdi_down_cmd KP_Up mdi_up_cmd KP_Down mdi_down_cmd} {
        bind $f.command <Key-$key> "$command; break"
    }
    bind $f.command <Control-Key-m> {clear_mdi_history; break}
    bind $f.command <Control-Key-h> {mdi_history_hist2clip; break}
    bind $f.command <Control-Shift-Key-H> {mdi_history_clip2hist; break}
    bind $f.history <ButtonRelease-1> "mdi_history_butt_1 %x %y; focus $f.command"      ;# its keys work on what was chosen
    bind $f.history <Double-Button-1> {mdi_history_double_butt_1 %x %y; break}
}

# The MDI lines that wait; without any the list is not there.
proc ::axis::show_waiting {lines} {
    set f .pane.top.tabs.fmdi
    $f.waiting delete 0 end
    $f.waiting insert end {*}$lines
    if {[llength $lines] == 0} { grid remove $f.waitingl $f.waiting; return }
    grid $f.waitingl -row 5 -column 0 -columnspan 2 -sticky w
    grid $f.waiting -row 6 -column 0 -columnspan 2 -sticky ew
}

# Override slider: percent, with an entry-like label.
proc ::axis::build_override {w text variable max command} {
    frame $w
    label $w.l -text $text -anchor w -width $::axis::name_width
    scale $w.foscale -from 0 -to $max -orient horizontal -showvalue 0 -variable $variable -command $command -takefocus 0
    label $w.foentry -textvariable $variable -width 4 -anchor e
    label $w.m -text %
    pack $w.l -side left
    pack $w.m $w.foentry -side right
    pack $w.foscale -side left -fill x -expand 1
}

# Speed slider: position 0..1, value shown in units/min.
proc ::axis::build_speed {w text value variable command} {
    frame $w
    label $w.l0 -text $text -anchor w -width $::axis::name_width
    scale $w.s -from 0.06 -to 1 -resolution 0.005 -orient horizontal -showvalue 0 -variable $variable -command $command -takefocus 0
    label $w.l -textvariable $value -width 6 -anchor e
    label $w.l1 -width [longest 7 [_ "deg/min"]] -anchor w
    pack $w.l0 -side left
    pack $w.l1 $w.l -side right
    pack $w.s -side left -fill x -expand 1
}

# Letters of the longest text, at least so many; more where they are wide ones (widths are rounded at every size anew).
proc ::axis::longest {least args} {
    set digit [expr {[font measure TkDefaultFont 0] / 1.08}]
    foreach text $args {
        set least [expr {max($least, [string length $text], int(ceil([font measure TkDefaultFont $text] / $digit)))}]
    }
    return $least
}

proc ::axis::build_left {top} {
    NoteBook $top.tabs -side top -internalborderwidth 4
    $top.tabs insert end manual -text [_ "Manual Control \[F3\]"] -raisecmd ::axis::raised_manual
    $top.tabs insert end mdi -text [_ "MDI \[F5\]"] -raisecmd ::axis::raised_mdi
    build_manual [$top.tabs getframe manual]
    build_mdi [$top.tabs getframe mdi]
    $top.tabs raise manual
    set ::axis::name_width [longest 15 [_ "Feed Override:"] [_ "Rapid Override:"] [_ "Spindle Override:"] [_ "Jog Speed:"] [_ "Max Velocity:"]]
    build_override $top.feedoverride [_ "Feed Override:"] feedrate 120 set_feedrate
    build_override $top.rapidoverride [_ "Rapid Override:"] rapidrate 100 set_rapidrate
    build_override $top.spinoverride [_ "Spindle Override:"] spindlerate 120 set_spindlerate
    build_speed $top.jogspeed [_ "Jog Speed:"] jog_speed jog_slider_val ::axis::jog_slider
    build_speed $top.ajogspeed [_ "Jog Speed:"] jog_aspeed ajog_slider_val ::axis::ajog_slider
    build_speed $top.maxvel [_ "Max Velocity:"] maxvel_speed maxvel_slider_val ::axis::maxvel_slider
    label $top.gcodel -text [_ "Active G-Codes:"] -anchor w
    text $top.gcodes -height 2 -width 20 -wrap word -state disabled -relief flat -takefocus 0
    bind $top.gcodes <Configure> {::axis::room_for_codes %W}
}

proc ::axis::build_right {top} {
    NoteBook $top.right -side top -internalborderwidth 2
    $top.right insert end preview -text [_ "Preview"]
    $top.right insert end numbers -text [_ "DRO"]
    set f [$top.right getframe numbers]
    text $f.text -width 1 -height 1 -wrap none -state disabled -relief flat -takefocus 0 \
        -background $::axis::colour(dro_back) -foreground $::axis::colour(dro)
    pack $f.text -fill both -expand 1
    $top.right raise preview
}

proc ::axis::build_pane {} {
    panedwindow .pane -orient vertical -borderwidth 0 -sashwidth 6 -sashrelief flat
    frame .pane.top
    frame .pane.bottom
    .pane add .pane.top -stretch always
    .pane add .pane.bottom -stretch never
    build_left .pane.top
    build_right .pane.top
    set row -1
    foreach w {tabs feedoverride rapidoverride spinoverride jogspeed ajogspeed maxvel gcodel gcodes} {
        grid .pane.top.$w -row [incr row] -column 0 -sticky [expr {$w eq "tabs" ? "nsew" : "ew"}] -padx 4 -pady 1
    }
    grid .pane.top.right -row 0 -column 1 -rowspan [expr {$row + 1}] -sticky nsew -padx 4
    grid rowconfigure .pane.top 0 -weight 1
    grid columnconfigure .pane.top 1 -weight 1

    frame .pane.bottom.t
    text .pane.bottom.t.text -height $::axis::code_lines -wrap none -state disabled -takefocus 0 -yscrollcommand {.pane.bottom.t.sb set} \
        -cursor arrow
    scrollbar .pane.bottom.t.sb -command {.pane.bottom.t.text yview} -takefocus 0
    pack .pane.bottom.t.sb -side right -fill y
    pack .pane.bottom.t.text -side left -fill both -expand 1
    pack .pane.bottom.t -fill both -expand 1
}

proc ::axis::build_status {} {
    frame .info
    label .info.task_state -textvariable task_state_string -width [longest 6 [_ "ESTOP"] [_ "OFF"] [_ "ON"]] -anchor w -relief flat
    label .info.tool -textvariable tool -anchor w
    label .info.control -textvariable control_name -anchor w
    label .info.position -textvariable position -anchor e
    label .info.time -textvariable run_time -anchor e
    canvas .info.progress -width 1 -height 1 -highlightthickness 0
    pack .info.task_state -side left -padx 6
    pack .info.control -side left
    pack .info.time -side right -padx 6
    pack .info.position -side right -padx 12
    pack .info.tool -side left -padx 6 -fill x -expand 1
}

# The modal codes; the text keeps the lines that it once needed.
proc ::axis::show_codes {codes} {
    set w .pane.top.gcodes
    $w configure -state normal
    $w replace 1.0 end $codes
    $w configure -state disabled
    room_for_codes $w
}

proc ::axis::room_for_codes {w} {
    if {![winfo ismapped $w]} return
    set lines [$w count -displaylines 1.0 end]
    if {$lines > [$w cget -height]} { $w configure -height $lines }
}

# What depends on how low the screen is.
proc ::axis::arrange {} {
    set f .pane.top.tabs.fmanual
    foreach row {row1 row2} {
        if {[winfo manager $f.spindlef.$row] eq "pack"} { pack configure $f.spindlef.$row -side $::axis::spindle_side }
    }
    $f.space1 configure -height $::axis::gap
    $f.space2 configure -height $::axis::gap
    .pane.bottom.t.text configure -height $::axis::code_lines
    set space [list [font measure TkDefaultFont " "] 0]
    foreach w {feedoverride rapidoverride spinoverride} { pack configure .pane.top.$w.m -padx $space }
    foreach w {jogspeed ajogspeed maxvel} { pack configure .pane.top.$w.l1 -padx $space }
    update idletasks
    foreach book {.pane.top.tabs .pane.top.right} {
        $book compute_size
        # room for all tabs; many of them have arrows
        lassign [$book.c bbox page] - - tabs
        set has [$book.c cget -width]
        if {$tabs > $has && $tabs < 1.5 * $has} { $book configure -width [expr {[$book cget -width] + $tabs - $has}] }
    }
    if {".pane.bottom" in [.pane panes]} { .pane paneconfigure .pane.bottom -height [winfo reqheight .pane.bottom] }
}

# Menus that are higher than the screen go on beside, if possible at a separator.
proc ::axis::break_menus {{menu .menu}} {
    foreach child [winfo children $menu] { break_menus $child }
    if {$menu eq ".menu" || [$menu index end] eq "none"} return
    set last [$menu index end]
    for {set i 0} {$i <= $last} {incr i} {
        if {[$menu type $i] ni {tearoff separator} && [$menu entrycget $i -columnbreak]} { $menu entryconfigure $i -columnbreak 0 }
    }
    update idletasks
    set room [expr {[winfo screenheight .] - 8}]
    if {[winfo reqheight $menu] <= $room} return
    set top 0
    set after 0
    set tops {}
    for {set i 0} {$i <= $last} {incr i} { lappend tops [$menu yposition $i] }
    lappend tops [winfo reqheight $menu]
    for {set i 1} {$i <= $last} {incr i} {
        if {[lindex $tops $i+1] - $top > $room} {
            set at [expr {$after > 0 ? $after + 1 : $i}]
            $menu entryconfigure $at -columnbreak 1
            set top [lindex $tops $at]
            set after 0
        }
        if {[$menu type $i] eq "separator"} { set after $i }
    }
    update idletasks
}

# Windows that are made hidden and shown from the menu.
proc ::axis::show_window {w} {
    wm deiconify $w
    raise $w
    focus $w
}

proc ::axis::build_window {w title} {
    toplevel $w
    wm withdraw $w
    wm title $w $title
    wm transient $w .
    wm protocol $w WM_DELETE_WINDOW [list wm withdraw $w]
    bind $w <Key-Escape> [list wm withdraw $w]
}

proc ::axis::build {} {
    wm withdraw .
    build_menu
    build_toolbar
    build_pane
    build_status
    arrange
    build_window .about [_ "About AXIS"]
    build_window .keys [_ "AXIS Quick Reference"]
    grid .toolbar -row 0 -column 0 -columnspan 3 -sticky ew
    grid .pane -row 1 -column 0 -columnspan 3 -sticky nsew
    grid .info -row 5 -column 0 -columnspan 3 -sticky ew
    grid rowconfigure . 1 -weight 1
    grid columnconfigure . 1 -weight 1
    replace_destroy
}

# -- what is possible now ------------------------------------------------------------------

proc is_continuous {} { return [expr {$::jogincrement eq [_ "Continuous"]}] }

proc set_mode_from_tab {} {
    if {[.pane.top.tabs raise] eq "mdi"} { ensure_mdi } else { ensure_manual }
}

proc update_state {args} {
    set on {$::task_state == $::STATE_ON}
    set idle {$::interp_state == $::INTERP_IDLE}
    set file {$::taskfile ne ""}
    set ready "$on && $idle"
    state {$::task_state != $::STATE_ESTOP} .toolbar.machine_power {.menu.machine "Toggle _Machine Power"}
    state "$idle && $file" .toolbar.reload {.menu.file "_Reload"}
    state $file {.menu.file "_Save G-code as..."} {.menu.file "G-code _properties..."}
    state "$idle && $file && \$::has_editor" {.menu.file "_Edit..."}
    state $idle .toolbar.file_open {.menu.file "_Open..."} {.menu.file "_Quit"} {.menu.file "Recent _Files"} \
        .toolbar.program_blockdelete {.menu.machine "Skip lines with '_/'"} {.menu.file "Edit _tool data..."}
    state $ready .toolbar.program_run {.menu.machine "_Run program"} {.menu.file "Reload tool _data"} \
        {.menu.machine "Homin_g"} {.menu.machine "Unhoming"} {.menu.machine "_Zero coordinate system"}
    state "$on && $file" .toolbar.program_step {.menu.machine "S_tep"}
    state "$on && (\$::interp_state == \$::INTERP_READING || \$::interp_state == \$::INTERP_WAITING)" {.menu.machine "_Pause"}
    state "$on && \$::interp_state == \$::INTERP_PAUSED" {.menu.machine "Re_sume"}
    state "$on && !($idle)" .toolbar.program_pause .toolbar.program_stop {.menu.machine "Stop"}
    state {$::has_ladder} {.menu.file "_Ladder Editor..."}
    state "$ready && \$::highlight_line > 0" {.menu.machine "Ru_n from selected line"}
    state "$ready && \[::axis::can_undo\]" {.menu.machine "Undo touch off"}
    relief {$::task_state == $::STATE_ESTOP} .toolbar.machine_estop
    relief $on .toolbar.machine_power
    relief "!($idle)" .toolbar.program_run
    relief $idle .toolbar.program_stop
    relief {$::task_paused} .toolbar.program_pause
    relief {$::block_delete} .toolbar.program_blockdelete
    relief {$::optional_stop} .toolbar.program_optpause

    set f .pane.top.tabs.fmanual
    state "$ready && \$::spindledir != 0" $f.spindlef.spindleminus $f.spindlef.spindleplus
    set group [list $f.jogf.zerohome.home $f.jogf.jog.jogminus $f.jogf.jog.jogplus \
                   $f.spindlef.cw $f.spindlef.ccw $f.spindlef.stop $f.spindlef.brake $f.flood $f.mist]
    foreach letter {x y z a b c u v w} { lappend group $f.axes.axis$letter }
    state $ready {*}$group
    ::axis::joint_states $ready
    set touch "$ready && (\$::motion_mode != \$::TRAJ_MODE_FREE || \$::kinematics_type == \$::KINEMATICS_IDENTITY)"
    state $touch $f.jogf.zerohome.zero
    state "$touch && \$::tool ne {} && \$::tool ne \[_ {No tool}\]" $f.jogf.zerohome.tooltouch
    state {$::on_any_limit} $f.jogf.override
    set m .pane.top.tabs.fmdi
    state "$on && \$::queued_mdi_commands < \$::max_queued_mdi_commands" $m.command $m.go $m.history
}

# Joints: like axes; extra joints only while they are not homed.
proc ::axis::joint_states {ready} {
    set f .pane.top.tabs.fmanual.joints
    for {set j 0} {$j < $::MAX_JOINTS} {incr j} {
        state "$ready && $j ni \$::axis::homed_extra" $f.joint$j
    }
}

# Joints or axis letters, as the motion mode and the kinematics have it.
proc ::axis::show_joints {joints} {
    set f .pane.top.tabs.fmanual
    if {$joints} {
        grid remove $f.axes
        grid $f.joints
        $f.axis configure -text [_ "Joint:"]
    } else {
        grid remove $f.joints
        grid $f.axes
        $f.axis configure -text [_ "Axis:"]
    }
}

# -- recent files --------------------------------------------------------------------------

# update_recent FILE... -- the menu of recent files, newest first.
proc update_recent {args} {
    set m .menu.file.recent
    $m delete 0 end
    set n 0
    foreach file $args {
        incr n
        $m add command -label "$n: [file tail $file]" -underline 0 -command [list open_file_name $file]
    }
    $m add separator
    add_clear_recent $m
}
proc add_clear_recent {m} {
    $m add command -label [_ "Clear Recents List"] -command clear_recent_files
}

proc setval {value args} { return [val2vel $value {*}$args] }
