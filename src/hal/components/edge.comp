// SPDX-License-Identifier: GPL-2.0-or-later
component edge "Edge detector with a pulse of given length";
pin in bit in_ "Input.";
pin out bit out "TRUE for a while after an edge.";
pin out bit out_invert "Inverse of *out*.";
param rw bit both = FALSE "TRUE: both edges count.";
param rw bit in_edge = TRUE "TRUE: the falling edge counts; FALSE: the rising edge.";
param rw signed out_width_ns = 0 "Length of the pulse in ns; at least one cycle.";
param r signed time_left_ns "Time until the pulse ends.";
param r bit last_in "Input of the last cycle.";
variable int running;
function _ "Updates the outputs.";
see_also "oneshot(9)";
license "GPL";
author "Kerf developers";
;;
int now = in_, was = last_in;
if(time_left_ns > 0) time_left_ns -= period;
if(running) {
    int rising = now && !was, falling = !now && was;
    if(both ? rising || falling : in_edge ? falling : rising) {
        time_left_ns = out_width_ns;
        out = 1;
    } else if(time_left_ns > 0) {
        out = 1;
    } else {
        time_left_ns = 0;
        out = 0;
    }
}
running = 1;
last_in = now;
out_invert = !out;
