// SPDX-License-Identifier: GPL-2.0-or-later
component demux "Selects one output by number or by bits";
pin in bit sel-bit-##[5] "Bits of the selection, lowest first.";
pin in unsigned sel_u32 "Number that is added to that of the bits.";
pin out bit out-##[32 : personality] "Outputs; their number is the personality.";
param rw bit bargraph = 0 "TRUE: all outputs below the selected one are on, as on a bar graph.";
function _ "Updates the outputs.";
option default_personality 32;
option period no;
description """
The selection is *sel-u32* plus the number made of the *sel-bit-NN* pins; a selection beyond the last
output selects the last.
""";
see_also "select8(9), demux_generic(9)";
license "GPL";
author "Kerf developers";
;;
int i, n = personality;
rtapi_u32 number = sel_u32;
rtapi_s32 chosen;
for(i = 0; i < 5; i++) number += (rtapi_u32)(sel_bit(i) != 0) << i;
chosen = (rtapi_s32)number;
if(chosen >= n) chosen = n - 1;
for(i = 0; i < n; i++) out(i) = bargraph ? chosen > i : chosen == i;
