// SPDX-License-Identifier: GPL-2.0-or-later
component safety_latch "Error latch that counts errors up and good cycles down";
pin in bit error_in = FALSE "TRUE: an error in this cycle.";
pin in signed heal = 1 "Taken from the count in a cycle without error.";
pin in signed harm = 1 "Added to the count in a cycle with an error.";
pin in bit latching = TRUE "TRUE: an error stays until *reset*.";
pin in bit reset "A rising edge clears error and count.";
pin in signed threshold = 100 "Count at which the output shows the error.";
pin in signed min = 0 "Lower end of the count.";
pin in signed max = 1000 "Upper end of the count.";
pin in bit enable = TRUE "FALSE: *error-out* follows *error-in* at once.";
pin out signed count = 0 "Present count.";
pin out bit error_out = FALSE "The error.";
pin out bit ok_out = TRUE "The opposite of *error-out*.";
variable int was_reset;
function _ "Updates count and outputs.";
option period no;
license "GPL";
author "Kerf developers";
;;
int edge = reset && !was_reset;
was_reset = reset;
if(!enable) {
    error_out = error_in;
    ok_out = !error_in;
    count = 0;
} else {
    rtapi_s64 n;
    if(edge) {
        count = 0;
        error_out = 0;
        ok_out = 1;
    }
    n = error_in ? (rtapi_s64)count + harm : (rtapi_s64)count - heal;
    if(n < min) n = min;
    if(n > max) n = max;
    count = n;
    if(n >= threshold) {
        error_out = 1;
        ok_out = 0;
    } else if(!latching) {
        error_out = 0;
        ok_out = 1;
    }
}
