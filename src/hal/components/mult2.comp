// SPDX-License-Identifier: GPL-2.0-or-later
component mult2 "Product of two inputs";
pin in float in0 "First input.";
pin in float in1 "Second input.";
pin out float out "in0 * in1.";
function _ "Updates the output.";
option period no;
see_also "div2(9), invert(9), scale(9)";
license "GPL";
author "Kerf developers";
;;
out = in0 * in1;
