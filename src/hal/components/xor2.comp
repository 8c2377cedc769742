// SPDX-License-Identifier: GPL-2.0-or-later
component xor2 "Two-input exclusive OR gate";
pin in bit in0 "First input.";
pin in bit in1 "Second input.";
pin out bit out "TRUE while exactly one input is TRUE.";
function _ "Updates the output.";
option period no;
see_also "and2(9), or2(9), not(9), logic(9), lut5(9)";
license "GPL";
author "Kerf developers";
;;
out = in0 != in1;
