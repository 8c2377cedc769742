// SPDX-License-Identifier: GPL-2.0-or-later
component time "Run time in hours, minutes and seconds";
pin in bit start "TRUE: the time runs. Rising, it starts from zero.";
pin in bit pause = 0 "TRUE: the time stands still.";
pin out u32 seconds "Seconds, 0 to 59.";
pin out u32 minutes "Minutes, 0 to 59.";
pin out u32 hours "Hours.";
variable int was_running;
variable rtapi_s64 total_ns;
function _ "Updates the outputs.";
license "GPL";
author "Kerf developers";
;;
int running = start || pause;
if(running && !was_running) total_ns = 0;
was_running = running;
if(start && !pause) {
    rtapi_u32 s;
    total_ns += period;
    s = (rtapi_u32)(total_ns * 1e-9);
    seconds = s % 60;
    minutes = s / 60 % 60;
    hours = s / 3600;
}
