// SPDX-License-Identifier: GPL-2.0-or-later
component updown "Counter for two buttons";
pin in bit countup "A rising edge adds one.";
pin in bit countdown "A rising edge takes one.";
pin in bit reset "TRUE: the count becomes zero.";
pin out signed count "The count.";
param rw bit clamp "TRUE: the count stays between *min* and *max*.";
param rw bit wrap "TRUE: beyond *max* comes *min* and the other way round; wins over *clamp*.";
param rw signed max = 0x7FFFFFFF "Greatest count with *clamp* or *wrap*.";
param rw signed min = 0 "Least count with *clamp* or *wrap*.";
variable int running;
variable int was_up;
variable int was_down;
function _ "Updates the count.";
option period no;
license "GPL";
author "Kerf developers";
;;
int up = countup, down = countdown;
rtapi_s64 n = count;
if(!running) {
    running = 1;
    was_up = up;
    was_down = down;
}
if(up && !was_up) n++;
if(down && !was_down) n--;
was_up = up;
was_down = down;
if(reset) n = 0;
if(wrap) {
    if(n > max) n = min;
    else if(n < min) n = max;
} else if(clamp) {
    if(n > max) n = max;
    else if(n < min) n = min;
}
count = (rtapi_s32)n;
