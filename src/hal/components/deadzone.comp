// SPDX-License-Identifier: GPL-2.0-or-later
component deadzone "Center while the input is near it";
pin in float in_ "Input.";
pin out float out "Output.";
param rw float center = 0.0 "Center of the dead zone.";
param rw float threshold = 1.0 "Width of the dead zone.";
function _ "Updates the output.";
option period no;
description """
Inside the dead zone, which reaches *threshold* / 2 to both sides of *center*, the output is
*center*. Outside the output is the input less the half width, so there is no jump.
""";
license "GPL";
author "Kerf developers";
;;
double half = threshold / 2, x = in_;
if(x < center - half) out = x + half;
else if(x > center + half) out = x - half;
else out = center;
