// SPDX-License-Identifier: GPL-2.0-or-later
component clarke3 "Clarke transform of three phases to cartesian";
pin in float a "First phase.";
pin in float b "Second phase.";
pin in float c "Third phase.";
pin out float x "Component along the first phase.";
pin out float y "Component at a right angle to it.";
pin out float h "Common (homopolar) component.";
function _ "Updates the outputs.";
option period no;
see_also "clarke2(9), clarkeinv(9)";
license "GPL";
author "Kerf developers";
;;
double first = a, second = b, third = c;
x = 0.666666666666667 * first - 0.333333333333333 * (second + third);
y = 0.577350269189626 * (second - third);
h = 0.471404520791032 * (first + second + third);
