// SPDX-License-Identifier: GPL-2.0-or-later
component invert "Reciprocal of a float";
pin in float in_ "Input.";
pin out float out "1 / in; an input nearer to zero than *deadband* counts as *deadband* with its sign.";
param rw float deadband "Smallest size of the input; at least 1e-12.";
function _ "Updates the output.";
option period no;
see_also "div2(9), scale(9)";
license "GPL";
author "Kerf developers";
;;
double x = in_;
if(!(deadband >= 1e-12)) deadband = 1e-12;
if(x > -deadband && x < deadband) x = x < 0 ? -deadband : deadband;
out = 1.0 / x;
