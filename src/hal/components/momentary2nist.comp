// SPDX-License-Identifier: GPL-2.0-or-later
component momentary2nist "Momentary button to on and off pulses";
pin in bit in_ "Button.";
pin in bit is_on "State of the device: TRUE while it is on.";
pin in unsigned debounce = 2 "Cycles for a press or release to count (1 to 10000, else 2).";
pin in unsigned max_pulse_length = 100 "Longest pulse in cycles.";
pin out bit on "Pulse that switches the device on.";
pin out bit off "Pulse that switches the device off.";
variable int pressed;
variable unsigned cycles;
variable unsigned idle;
function _ "Updates the outputs.";
option period no;
description """
Each press of the button sends *on* to a device that is off and *off* to one that is on. A pulse ends
when the device has followed, or after *max-pulse-length* idle cycles.
""";
see_also "toggle2nist(9), toggle(9)";
license "GPL";
author "Kerf developers";
;;
unsigned needed = debounce;
if(needed < 1 || needed > 10000) needed = 2;
if(in_ && !pressed) {
    if(++cycles >= needed) {
        on = !is_on;
        off = is_on;
        pressed = 1;
        cycles = 0;
    }
} else if(!in_ && pressed) {
    if(++cycles >= needed) {
        pressed = 0;
        cycles = 0;
    }
} else if((!is_on && off) || (is_on && on) || idle > max_pulse_length) {
    on = 0;
    off = 0;
    cycles = 0;
    idle = 0;
} else {
    cycles = 0;
    idle++;
}
