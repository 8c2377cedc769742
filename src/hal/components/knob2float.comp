// SPDX-License-Identifier: GPL-2.0-or-later
component knob2float "Counts of a knob to a float";
pin in signed counts "Counts of the knob.";
pin in bit enable "TRUE: the knob moves the output.";
pin in float scale "Output per count.";
pin out float out "Output.";
param rw float max_out = 1.0 "Upper limit of the output.";
param rw float min_out = 0.0 "Lower limit of the output.";
variable int last_counts;
variable double value;
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
rtapi_s32 delta = (rtapi_s32)((rtapi_u32)counts - (rtapi_u32)last_counts);
last_counts = counts;
if(min_out > max_out) min_out = max_out;
if(enable) {
    double next = value + delta * scale;
    /* An infinite or undefined scale must not spoil the value for ever. */
    if(isnan(next)) next = isnan(value) ? 0 : value;
    if(next < min_out) next = min_out;
    if(next > max_out) next = max_out;
    value = next;
}
out = value;
