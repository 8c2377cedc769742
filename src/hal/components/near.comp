// SPDX-License-Identifier: GPL-2.0-or-later
component near "Are two values about equal?";
pin in float in1 "First value.";
pin in float in2 "Second value.";
param rw float scale = 1.0 "Greatest ratio of the values; used if above 1.";
param rw float difference = 0.0 "Greatest difference of the values.";
pin out bit out "TRUE while the ratio or the difference is within its limit.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double a = in1, b = in2;
if(a < 0) {
    a = -a;
    b = -b;
}
out = (scale > 1 && a / scale <= b && b <= a * scale) || fabs(a - b) <= difference;
