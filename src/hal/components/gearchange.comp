// SPDX-License-Identifier: GPL-2.0-or-later
component gearchange "Two spindle gears";
pin in bit sel "FALSE: first gear, TRUE: second gear.";
pin in float speed_in "Speed wanted.";
pin out float speed_out "Speed of the motor.";
pin in bit dir_in "Direction wanted.";
pin out bit dir_out "Direction of the motor.";
param rw float min1 = 0 "Least speed in the first gear.";
param rw float max1 = 100000 "Greatest speed in the first gear.";
param rw float min2 = 0 "Least speed in the second gear.";
param rw float max2 = 100000 "Greatest speed in the second gear.";
param rw float scale2 = 1.0 "Ratio of the second gear to the first, at least 1.";
param rw bit reverse = 0 "The second gear turns the other way.";
function _ "Updates speed and direction.";
option period no;
license "GPL";
author "Kerf developers";
;;
double speed = speed_in, sign = 1;
if(speed < 0) {
    speed = -speed;
    sign = -1;
}
if(!(scale2 >= 1)) scale2 = 1;
if(sel) {
    if(speed < min2) speed = min2;
    else if(speed > max2) speed = max2;
    speed_out = sign * speed / scale2;
    dir_out = dir_in != reverse;
} else {
    if(speed < min1) speed = min1;
    else if(speed > max1) speed = max1;
    speed_out = sign * speed;
    dir_out = dir_in;
}
