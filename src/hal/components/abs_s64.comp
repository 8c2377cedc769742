// SPDX-License-Identifier: GPL-2.0-or-later
component abs_s64 "Absolute value and sign of a 64-bit integer";
pin in s64 in_ "Input.";
pin out s64 out "Absolute value of the input; the most negative number stays as it is.";
pin out bit sign "TRUE if the input is below zero.";
pin out bit is_positive "TRUE if the input is above zero.";
pin out bit is_negative "TRUE if the input is below zero.";
function _ "Updates the outputs.";
option period no;
see_also "abs(9), abs_s32(9)";
license "GPL";
author "Kerf developers";
;;
rtapi_s64 x = in_;
sign = x < 0;
out = x < 0 ? (rtapi_s64)(0ull - (rtapi_u64)x) : x;
is_positive = x > 0;
is_negative = x < 0;
