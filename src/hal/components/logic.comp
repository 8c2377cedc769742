// SPDX-License-Identifier: GPL-2.0-or-later
component logic "Gates over up to 16 inputs";
pin in bit in-##[16 : personality & 0xff] "Inputs; their number is the low byte of the personality.";
pin out bit and if personality & 0x100 "TRUE while all inputs are TRUE.";
pin out bit or if personality & 0x200 "TRUE while at least one input is TRUE.";
pin out bit xor if personality & 0x400 "TRUE while an odd number of inputs is TRUE.";
pin out bit nand if personality & 0x800 "FALSE while all inputs are TRUE.";
pin out bit nor if personality & 0x1000 "TRUE while no input is TRUE.";
function _ "Updates the outputs.";
option period no;
description """
The personality of an instance says which pins it has. Add the number of inputs (0 to 16) and
one or more of

* 0x100 (256): output *and*
* 0x200 (512): output *or*
* 0x400 (1024): output *xor*
* 0x800 (2048): output *nand*
* 0x1000 (4096): output *nor*
""";
examples """
Three instances, a five-input AND, a three-input OR and a four-input gate with AND and NAND:

----
loadrt logic count=3 personality=0x105,0x203,0x904
----
""";
see_also "and2(9), or2(9), xor2(9), not(9), lut5(9)";
license "GPL";
author "Kerf developers";
;;
int i, n = personality & 0xff, number = 0;
for(i = 0; i < n; i++) number += in(i) != 0;
if(personality & 0x100) and = number == n;
if(personality & 0x200) or = number != 0;
if(personality & 0x400) xor = number & 1;
if(personality & 0x800) nand = number != n;
if(personality & 0x1000) nor = number == 0;
