// SPDX-License-Identifier: GPL-2.0-or-later
component ddt "Derivative";
pin in float in_ "Input.";
pin out float out "Change of the input in a second.";
variable double last;
function _ "Updates the output.";
see_also "integ(9)";
license "GPL";
author "Kerf developers";
;;
double x = in_;
out = (x - last) / fperiod;
last = x;
