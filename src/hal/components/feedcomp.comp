// SPDX-License-Identifier: GPL-2.0-or-later
component feedcomp "Scales a value by the ratio of two speeds";
pin out float out "in * vel / feed while enabled, else in.";
pin in float in_ "Input.";
pin in bit enable "Scale.";
pin in float vel "Present speed.";
param rw float feed "Reference speed.";
function _ "Updates the output.";
option period no;
notes "A *feed* of zero gives infinity or not-a-number.";
license "GPL";
author "Kerf developers";
;;
out = enable ? in_ * (vel / feed) : in_;
