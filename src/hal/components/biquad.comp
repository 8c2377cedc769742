// SPDX-License-Identifier: GPL-2.0-or-later
component biquad "Biquad IIR filter";
pin in float in_ "Input.";
pin out float out "Filtered input; the input while not enabled or not valid.";
pin in bit enable = 0 "A rising edge computes the filter.";
pin out bit valid = 0 "The filter could be computed.";
pin in unsigned type_ = 0 "0: coefficients as set, 1: low pass, 2: notch.";
pin in float f0 = 250.0 "Corner or notch frequency in Hz, up to half the sample rate.";
pin in float Q = 0.7071 "Quality, 0.5 to 2.";
param rw float d1 = 0.0 "Denominator coefficient.";
param rw float d2 = 0.0 "Denominator coefficient.";
param rw float n0 = 1.0 "Numerator coefficient.";
param rw float n1 = 0.0 "Numerator coefficient.";
param rw float n2 = 0.0 "Numerator coefficient.";
pin out float s1 "State.";
pin out float s2 "State.";
variable int was_enabled;
function _ "Updates the output.";
description """
Transposed direct form II. Coefficients are computed, by the bilinear transform, when *enable* rises;
with type 0 set the parameters before.
""";
see_also "lowpass(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
/* Coefficients of the wanted type; leaves valid FALSE when it cannot be. */
static void compute(struct __comp_state *__comp_inst, long period) {
    double rate = 1.0 / fperiod, w, alpha, b0, b1, a0, a1, a2;
    if(type_ == 0) {
        valid = 1;
        return;
    }
    valid = 0;
    if(f0 > rate / 2 || Q > 2 || Q < 0.5) return;
    w = 2 * 3.141592653589 * f0 / rate;
    alpha = sin(w) / (2 * Q);
    if(type_ == 1) {
        b0 = (1 - cos(w)) / 2;
        b1 = 1 - cos(w);
    } else if(type_ == 2) {
        b0 = 1;
        b1 = -2 * cos(w);
    } else {
        return;
    }
    a0 = 1 + alpha;
    a1 = -2 * cos(w);
    a2 = 1 - alpha;
    n0 = b0 / a0;
    n1 = b1 / a0;
    n2 = b0 / a0;
    d1 = a1 / a0;
    d2 = a2 / a0;
    s1 = 0;
    s2 = 0;
    valid = 1;
}

FUNCTION(_) {
    if((enable != 0) != was_enabled) {
        was_enabled = enable != 0;
        if(was_enabled) compute(__comp_inst, period);
    }
    if(!enable || !valid) {
        out = in_;
    } else {
        double x = in_, y = x * n0 + s1;
        if(!isfinite(y)) {
            s1 = 0;
            s2 = 0;
            y = isfinite(x) ? x * n0 : 0;
            x = isfinite(x) ? x : 0;
        }
        out = y;
        s1 = x * n1 - y * d1 + s2;
        s2 = x * n2 - y * d2;
    }
}
