// SPDX-License-Identifier: GPL-2.0-or-later
component tristate_bit "Drives a shared bit signal while enabled";
pin in bit in_ "Input.";
pin io bit out "Set to *in* while *enable* is TRUE, else left alone.";
pin in bit enable "Drive the output.";
function _ "Updates the output.";
option period no;
see_also "tristate_float(9)";
license "GPL";
author "Kerf developers";
;;
if(enable) out = in_;
