// SPDX-License-Identifier: GPL-2.0-or-later
component maj3 "Majority of three inputs";
pin in bit in1 "First input.";
pin in bit in2 "Second input.";
pin in bit in3 "Third input.";
pin out bit out "TRUE while at least two inputs are TRUE (fewer than two with *invert*).";
param rw bit invert "Inverts the output.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
;;
int majority = in1 + in2 + in3 >= 2;
out = majority != (invert != 0);
