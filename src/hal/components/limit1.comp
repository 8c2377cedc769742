// SPDX-License-Identifier: GPL-2.0-or-later
component limit1 "Limits a value";
pin in float in_ "Input.";
pin out float out "The input between *min* and *max*.";
pin in float min_ = -1e20 "Lower limit.";
pin in float max_ = 1e20 "Upper limit; wins if both limits are crossed.";
function _ "Updates the output.";
option period no;
see_also "limit2(9), limit3(9)";
license "GPL";
author "Kerf developers";
;;
double x = in_;
if(x != x) return;              /* not a number: stay */
if(x < min_) x = min_;
if(x > max_) x = max_;
out = x;
