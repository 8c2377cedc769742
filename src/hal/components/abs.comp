// SPDX-License-Identifier: GPL-2.0-or-later
component abs "Absolute value and sign of a float";
pin in float in_ "Input.";
pin out float out "Absolute value of the input.";
pin out bit sign "TRUE if the input is below zero.";
pin out bit is_positive "TRUE if the input is above 1e-6.";
pin out bit is_negative "TRUE if the input is below -1e-6.";
function _ "Updates the outputs.";
option period no;
see_also "abs_s32(9), abs_s64(9)";
license "GPL";
author "Kerf developers";
;;
double x = in_;
sign = !(x >= 0);
out = x >= 0 ? x : -x;
is_positive = x > 1e-6;
is_negative = x < -1e-6;
