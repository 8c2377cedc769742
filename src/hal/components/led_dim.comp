// SPDX-License-Identifier: GPL-2.0-or-later
component led_dim "Brightness of a LED as the eye sees it";
pin in float in_ "Brightness wanted, 0 to 1.";
pin out float out "Power for the LED, 0 to 1.";
variable double last;
function _ "Updates the output when the input changed.";
option period no;
description "The response is the lightness function of CIE 1931.";
license "GPL";
author "Kerf developers";
;;
double x = in_;
if(x != last) {
    last = x;
    if(x < 0) x = 0;
    if(x > 1) x = 1;
    if(x < 0.079996) {
        out = x / 9.033;
    } else {
        double t = (x + 0.16) / 1.16;
        out = t * t * t;
    }
}
