// SPDX-License-Identifier: GPL-2.0-or-later
component bitmerge "Bits to an unsigned number";
pin out unsigned out "The number.";
pin in bit in-##[32 : personality] "Its bits, lowest first; their number is the personality.";
function _ "Updates the output.";
option period no;
see_also "bitslice(9), bitwise(9), weighted_sum(9)";
license "GPL";
author "Kerf developers";
;;
int i;
rtapi_u32 number = 0;
for(i = 0; i < personality; i++) number |= (rtapi_u32)(in(i) != 0) << i;
out = number;
