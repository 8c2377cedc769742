// SPDX-License-Identifier: GPL-2.0-or-later
component tristate_float "Drives a shared float signal while enabled";
pin in float in_ "Input.";
pin io float out "Set to *in* while *enable* is TRUE, else left alone.";
pin in bit enable "Drive the output.";
function _ "Updates the output.";
option period no;
see_also "tristate_bit(9)";
license "GPL";
author "Kerf developers";
;;
if(enable) out = in_;
