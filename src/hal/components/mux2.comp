// SPDX-License-Identifier: GPL-2.0-or-later
component mux2 "Selects one of two floats";
pin in bit sel "FALSE: in0, TRUE: in1.";
pin in float in0 "Output while *sel* is FALSE.";
pin in float in1 "Output while *sel* is TRUE.";
pin out float out "The selected input.";
function _ "Updates the output.";
option period no;
see_also "mux4(9), mux8(9), mux16(9), mux_generic(9)";
license "GPL";
author "Kerf developers";
;;
out = sel ? in1 : in0;
