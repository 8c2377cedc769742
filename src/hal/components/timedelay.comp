// SPDX-License-Identifier: GPL-2.0-or-later
component timedelay "Delays of the rising and falling edge";
pin in bit in_ "Input.";
pin out bit out "The input, once it has lasted long enough.";
pin in float on_delay = 0.5 "Seconds that the input must be TRUE.";
pin in float off_delay = 0.5 "Seconds that the input must be FALSE.";
pin out float elapsed "Seconds that the present change lasts.";
variable double timer;
function _ "Updates the output.";
see_also "ton(9), tof(9), oneshot(9)";
license "GPL";
author "Kerf developers";
;;
if((in_ != 0) != (out != 0)) {
    timer += fperiod;
    elapsed = timer;
    if(in_ ? timer >= on_delay : timer >= off_delay) {
        out = in_;
        timer = 0;
    }
} else {
    timer = 0;
}
