// SPDX-License-Identifier: GPL-2.0-or-later
component lut5 "Any logic function of five inputs";
pin in bit in-#[5] "Inputs.";
pin out bit out "The bit of *function* that the inputs select.";
param rw unsigned function_ "Output for each combination of inputs, see below.";
function _ "Updates the output.";
option period no;
description """
The inputs, read as a binary number with in-0 as its lowest bit, are the number of a row of the
truth table; the output is that bit of the parameter *function*. To find the parameter, add the
weights 1 << row of all rows in which the output shall be TRUE.
""";
examples """
AND of five inputs: 0x80000000. OR of five inputs: 0xfffffffe. XOR of in-0 and in-1: 0x6.
""";
see_also "and2(9), logic(9), or2(9), xor2(9)";
license "GPL";
author "Kerf developers";
;;
int i, row = 0;
for(i = 0; i < 5; i++) row |= (in(i) != 0) << i;
out = (function_ >> row) & 1;
