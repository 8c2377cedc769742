// SPDX-License-Identifier: GPL-2.0-or-later
component toggle "Push-on, push-off from a momentary button";
pin in bit in_ "Button.";
pin io bit out "Changes each time the button is pressed.";
param rw unsigned debounce = 2 "Cycles that the button must be pressed, and released, to count (1 to 10000;
anything else becomes 2).";
variable int cycles;
variable int seen;
function _ "Updates the output.";
option period no;
see_also "toggle2nist(9), debounce(9)";
license "GPL";
author "Kerf developers";
;;
int needed;
if(debounce < 1 || debounce > 10000) debounce = 2;
needed = debounce;
if(in_) {
    if(++cycles >= needed) {
        cycles = needed;
        if(!seen) {
            out = !out;
            seen = 1;
        }
    }
} else if(--cycles <= 0) {
    cycles = 0;
    seen = 0;
}
