// SPDX-License-Identifier: GPL-2.0-or-later
component limit2 "Limits a value and its velocity";
pin in float in_ "Input.";
pin out float out "The input within the limits.";
pin in bit load "TRUE: the output goes to the input at once.";
pin in float min_ = -1e20 "Lower limit; wins if both limits are crossed.";
pin in float max_ = 1e20 "Upper limit.";
pin in float maxv = 1e20 "Greatest change in a second.";
variable double last;
function _ "Updates the output.";
see_also "limit1(9), limit3(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double x = in_, step = maxv * fperiod;
if(isnan(x)) x = last;      /* not a number: stay */
if(x < min_) x = min_;
else if(x > max_) x = max_;
if(!load) {
    if(x < last - step) x = last - step;
    else if(x > last + step) x = last + step;
}
last = x;
out = x;
