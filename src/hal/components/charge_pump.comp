// SPDX-License-Identifier: GPL-2.0-or-later
component charge_pump "Square waves that show that the system runs";
pin in bit enable = TRUE "FALSE: all outputs are FALSE.";
pin out bit out "Changes in every cycle.";
pin out bit out_2 "Changes in every second cycle.";
pin out bit out_4 "Changes in every fourth cycle.";
variable unsigned cycles;
function _ "Updates the outputs.";
option singleton;
option period no;
see_also "watchdog(9)";
license "GPL";
author "Kerf developers";
;;
if(enable) {
    cycles++;
    out = cycles & 1;
    out_2 = (cycles >> 1) & 1;
    out_4 = (cycles >> 2) & 1;
} else {
    out = 0;
    out_2 = 0;
    out_4 = 0;
}
