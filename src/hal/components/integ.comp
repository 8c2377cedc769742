// SPDX-License-Identifier: GPL-2.0-or-later
component integ "Integrator";
pin in float in_ "Input.";
pin in float gain = 1 "Factor of the input.";
pin out float out "Sum of in * gain over time.";
pin in bit reset "TRUE: the output stays as it is, within the limits or zero when zero is outside.";
pin in float max_ = 1e20 "Upper limit of the output.";
pin in float min_ = -1e20 "Lower limit of the output.";
function _ "Updates the output.";
see_also "ddt(9), sum2(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double value = 0;
if(!reset) {
    value = out + gain * in_ * fperiod;
    if(isnan(value)) value = isnan(out) ? 0 : out;
    out = value;
}
if(value > max_) out = max_;
if(value < min_) out = min_;
