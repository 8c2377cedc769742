// SPDX-License-Identifier: GPL-2.0-or-later
component bitslice "Bits of an unsigned number";
pin in unsigned in_ "The number.";
pin out bit out-##[32 : personality] "Its bits, lowest first; their number is the personality.";
function _ "Updates the outputs.";
option period no;
see_also "bitmerge(9), bitwise(9)";
license "GPL";
author "Kerf developers";
;;
int i;
for(i = 0; i < personality; i++) out(i) = (in_ >> i) & 1;
