// SPDX-License-Identifier: GPL-2.0-or-later
component spindle_monitor "Spindle at speed and underspeed";
pin in bit spindle_is_on "The spindle is on.";
pin in float spindle_command "Speed wanted.";
pin in float spindle_feedback "Speed measured.";
pin out bit spindle_at_speed "The spindle has reached its speed.";
pin out bit spindle_underspeed "After that, it fell below its speed by more than the threshold.";
param rw unsigned level "State: 0 off, 1 speeding up, 2 at speed.";
param rw float threshold = 0 "Tolerance of the speed.";
function _ "Updates the outputs.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
switch(level) {
case 0:
    spindle_at_speed = 0;
    spindle_underspeed = 0;
    if(spindle_is_on) level = 1;
    break;
case 1:
    if(!spindle_is_on) {
        level = 0;
    } else if(fabs(spindle_command - spindle_feedback) < threshold) {
        level = 2;
        spindle_at_speed = 1;
    }
    break;
case 2:
    if(!spindle_is_on) level = 0;
    else if(spindle_command - spindle_feedback > threshold) spindle_underspeed = 1;
    break;
default:
    level = 0;
}
