// SPDX-License-Identifier: GPL-2.0-or-later
component xhc_hb04_util "Helpers for the xhc-hb04 pendant";
pin in bit start_or_pause "Button: each press starts, pauses or resumes.";
pin in bit is_paused "The program is paused.";
pin in bit is_idle "No program runs.";
pin in bit is_running "A program runs.";
pin out bit pause "Pause request.";
pin out bit resume "Resume request.";
pin out bit run "Run request.";
pin in s32 in0 "Counts to smooth.";
pin in s32 in1 "Counts to smooth.";
pin in s32 in2 "Counts to smooth.";
pin in s32 in3 "Counts to smooth.";
pin out s32 out0 "Smoothed and scaled *in0*.";
pin out s32 out1 "Smoothed and scaled *in1*.";
pin out s32 out2 "Smoothed and scaled *in2*.";
pin out s32 out3 "Smoothed and scaled *in3*.";
pin in float scale0 = 1.0 "Factor of output 0.";
pin in float scale1 = 1.0 "Factor of output 1.";
pin in float scale2 = 1.0 "Factor of output 2.";
pin in float scale3 = 1.0 "Factor of output 3.";
pin in float coef0 = 1.0 "Share of the new value in each cycle, output 0.";
pin in float coef1 = 1.0 "Share of the new value in each cycle, output 1.";
pin in float coef2 = 1.0 "Share of the new value in each cycle, output 2.";
pin in float coef3 = 1.0 "Share of the new value in each cycle, output 3.";
pin in float divide_by_k_in "Value to divide.";
pin out float divide_by_k_out "divide-by-k-in / k; 1e99 if k is 0.";
pin in float k = 1.0 "Divisor.";
variable double filtered[4];
variable int was;
function _ "Updates all outputs.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include "components/real_to_int.h";
;;
/* One step of the filter; a value that is not a number starts again from the input. */
static rtapi_s32 smooth(double *value, double in, double coef, double scale) {
    double share = fmin(fabs(coef), 1);
    *value += (in - *value) * share;
    if(isnan(*value)) *value = in;
    return real_to_s32(ceil(*value * scale - 0.5));
}
FUNCTION(_) {
    divide_by_k_out = k == 0 ? 1e99 : divide_by_k_in / k;
    out0 = smooth(&filtered[0], in0, coef0, scale0);
    out1 = smooth(&filtered[1], in1, coef1, scale1);
    out2 = smooth(&filtered[2], in2, coef2, scale2);
    out3 = smooth(&filtered[3], in3, coef3, scale3);
    if((start_or_pause != 0) != was) {
        was = start_or_pause != 0;
        if(was) {
            if(is_idle) {
                run = 1;
                pause = 0;
                resume = 0;
            } else if(is_running) {
                pause = 1;
                run = 0;
                resume = 0;
            } else if(is_paused) {
                resume = 1;
                run = 0;
                pause = 0;
            }
        } else {
            run = 0;
            pause = 0;
            resume = 0;
        }
    }
}
