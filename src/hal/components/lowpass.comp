// SPDX-License-Identifier: GPL-2.0-or-later
component lowpass "Low-pass filter of first order";
pin in float in_ "Input.";
pin out float out "out += (in - out) * gain in every cycle.";
pin in bit load "TRUE: the output goes to the input at once.";
param rw float gain "Share of the difference that is taken in a cycle, 0 to 1.";
function _ "Updates the output.";
option period no;
description """
For a time constant of T seconds and a period of P seconds the gain is 1 - exp(-P / T).
""";
see_also "ilowpass(9), biquad(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double next = out + (in_ - out) * gain;
/* Not a number or infinite: begin again from the input. */
if(load || !isfinite(next)) next = in_;
out = next;
