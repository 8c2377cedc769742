// SPDX-License-Identifier: GPL-2.0-or-later
component or2 "Two-input OR gate";
pin in bit in0 "First input.";
pin in bit in1 "Second input.";
pin out bit out "TRUE while at least one input is TRUE.";
function _ "Updates the output.";
option period no;
see_also "and2(9), xor2(9), not(9), logic(9), lut5(9)";
license "GPL";
author "Kerf developers";
;;
out = in0 || in1;
