# SPDX-License-Identifier: GPL-2.0-or-later
# wheeljogpins.tcl [SCALE] - enables wheel jogging of every axis and joint that motion has.
# [HAL]HALFILE = LIB:wheeljogpins.tcl 0.1
# SCALE: machine units per count (default 1). The counts are left for other files to connect.

set wheel_scale [expr {[llength $::argv] ? [lindex $::argv 0] : 1}]
if {![string is double -strict $wheel_scale]} {
    puts stderr "wheeljogpins.tcl: the scale '$wheel_scale' is no number (machine units per count)"
    exit 1
}
foreach letter {x y z a b c u v w} { lappend wheel_owners axis.$letter }
for {set j 0} {$j <= 8} {incr j} { lappend wheel_owners joint.$j }
foreach owner $wheel_owners {
    if {![llength [hal list pin $owner.jog-enable]]} continue
    setp $owner.jog-enable 1
    setp $owner.jog-scale $wheel_scale
}
