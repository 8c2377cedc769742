// SPDX-License-Identifier: GPL-2.0-or-later
component hypot "Length of a vector of three components";
pin in float in0 "First component.";
pin in float in1 "Second component.";
pin in float in2 "Third component.";
pin out float out "Square root of the sum of squares.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double a = in0, b = in1, c = in2;
out = sqrt(a * a + b * b + c * c);
