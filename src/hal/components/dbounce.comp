// SPDX-License-Identifier: GPL-2.0-or-later
component dbounce "Debounce filter of one input";
pin in bit in_ "Input.";
pin out bit out "The input, once it was stable for *delay* + 1 cycles.";
pin in unsigned delay = 5 "Cycles.";
variable unsigned state;
function _ "Updates the output.";
option period no;
see_also "debounce(9)";
license "GPL";
author "Kerf developers";
;;
if(in_) {
    if(state < delay) state++;
    else out = 1;
} else {
    if(state > 0) state--;
    else out = 0;
}
