// SPDX-License-Identifier: GPL-2.0-or-later
component scale "Scale and offset of a float";
pin in float in_ "Input.";
pin in float gain "Factor.";
pin in float offset "Added after the factor.";
pin out float out "in * gain + offset.";
function _ "Updates the output.";
option period no;
see_also "invert(9), offset(9), sum2(9)";
license "GPL";
author "Kerf developers";
;;
out = in_ * gain + offset;
