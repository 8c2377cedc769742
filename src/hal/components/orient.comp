// SPDX-License-Identifier: GPL-2.0-or-later
component orient "Position command to stop a spindle at an angle";
pin in bit enable "TRUE: orients.";
pin in signed mode "0: the shorter way, 1: forward, 2: backward.";
pin in float position "Position of the spindle in revolutions.";
pin in float angle "Angle wanted, in degrees.";
pin out float command "Position command in revolutions, for a PID component.";
pin out float poserr "Error in degrees.";
pin out bit is_oriented "The error was within the tolerance in more than 100 cycles.";
pin in float tolerance = 0.5 "Tolerance in degrees.";
variable int was_enabled;
variable int good;
function _ "Updates the command.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
is_oriented = 0;
if(enable) {
    if(!was_enabled) {
        double turns = angle / 360.0;
        good = 0;
        if(mode == 0) command = floor(position + 0.5 - turns) + turns;
        else if(mode == 1) command = ceil(position - turns) + turns;
        else if(mode == 2) command = floor(position - turns) + turns;
    }
    poserr = (position - command) * 360.0;
    if(fabs(poserr) < tolerance && good <= 100) good++;
    is_oriented = good > 100;
}
was_enabled = enable;
