// SPDX-License-Identifier: GPL-2.0-or-later
component joyhandle "Response curve of a joystick";
pin in float in_ "Position of the stick, -1 to 1.";
pin out float out "Command.";
param rw float power = 2.0 "Exponent of the curve, at least 1 (a straight line).";
param rw float deadband = 0.0 "Positions nearer to the middle give 0; from 0 to below 1.";
param rw float scale = 1.0 "Slope: output at full deflection, less *offset*.";
param rw float offset = 0.0 "Added outside the deadband.";
param rw bit inverse = 0 "Curve steep near the middle instead of near the ends.";
function _ "Updates the output.";
option period no;
description """
Maps the position of a joystick to a command with a deadband in the middle and a curve that is fine
near the middle (or, with *inverse*, near the ends).
""";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double x = in_, size = fabs(x), p, a, b, slope, level;
if(!(power >= 1)) power = 1;
if(deadband >= 0.99) deadband = 0.99;
if(!(deadband > 0)) deadband = 0;
p = power - 1;
a = -1.0 / (pow(deadband, p) - 1);
b = 1 - a;
slope = -scale / (deadband - 1);
level = scale + offset - slope;
if(x >= 1) {
    out = scale + offset;
} else if(size <= deadband) {
    out = 0;
} else if(x <= -1) {
    out = -scale - offset;
} else {
    double y;
    if(power == 1) {
        y = slope * size + level;
    } else if(!inverse) {
        y = scale * (a * pow(size, power) + b * size) + offset;
    } else {
        /* The curve mirrored at the middle of the line. */
        double xm = (deadband + 1) / 2, ym = slope * xm + level, xi = 2 * xm - size;
        double yi = scale * (a * pow(xi, power) + b * xi) + offset;
        y = x > 0 ? 2 * ym - yi : 2 * ym + yi;
    }
    out = x > 0 ? y : -y;
}
