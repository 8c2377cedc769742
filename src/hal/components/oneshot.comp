// SPDX-License-Identifier: GPL-2.0-or-later
component oneshot "Pulse of given length after an edge";
pin in bit in_ "Trigger.";
pin in bit reset "TRUE: ends the pulse.";
pin out bit out "The pulse.";
pin out bit out_not "Inverse of *out*.";
pin in float width = 0 "Length of the pulse in seconds.";
pin out float time_left "Seconds until the pulse ends.";
param rw bit retriggerable = TRUE "An edge during the pulse starts it again.";
param rw bit rising = TRUE "A rising edge triggers.";
param rw bit falling = FALSE "A falling edge triggers.";
variable double left;
variable int was;
function _ "Updates the outputs.";
see_also "edge(9), timedelay(9)";
license "GPL";
author "Kerf developers";
;;
int now = in_, trigger;
if(reset) {
    left = 0;
    was = 0;
    out = 0;
    out_not = 1;
    return;
}
trigger = (rising && now && !was) || (falling && !now && was);
was = now;
if(left > 0) {
    if(!retriggerable) trigger = 0;
    left -= fperiod;
    if(left < 0) left = 0;
}
if(trigger) left = width;
time_left = left;
out = left > 0;
out_not = !out;
