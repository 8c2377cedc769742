// SPDX-License-Identifier: GPL-2.0-or-later
component toggle2nist "Toggle button to on and off pulses";
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
For a maintained button: pressing it sends *on* to a device that is off, releasing it sends *off* to a
device that is on. A pulse ends when the device has followed, or after *max-pulse-length* idle cycles.
""";
see_also "momentary2nist(9), toggle(9)";
license "GPL";
author "Kerf developers";
;;
unsigned needed = debounce;
if(needed < 1 || needed > 10000) needed = 2;
if(in_ && !pressed) {
    if(++cycles >= needed) {
        if(!is_on) {
            on = 1;
            off = 0;
        }
        pressed = 1;
        cycles = 0;
    }
} else if(!in_ && pressed) {
    if(++cycles >= needed) {
        if(is_on) {
            on = 0;
            off = 1;
        }
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
