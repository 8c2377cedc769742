// SPDX-License-Identifier: GPL-2.0-or-later
component flipflop "D flip-flop";
pin in bit data_ "Value taken at a rising edge of *clk*.";
pin in bit clk "Clock.";
pin in bit set "TRUE: sets *out*, unless *reset* is TRUE.";
pin in bit reset "TRUE: clears *out*, whatever the other inputs are.";
pin io bit out "Output.";
pin io bit out_not "Inverted output.";
variable int was_clk;
function _ "Updates the outputs.";
option period no;
description """
The inputs in order of priority: *reset*, *set*, a rising edge of *clk*. The clock is watched while
*reset* or *set* is TRUE, so a clock that rose meanwhile is not seen as an edge later.
""";
license "GPL";
author "Kerf developers";
;;
int edge = clk && !was_clk;
was_clk = clk;
if(reset) {
    out = 0;
    out_not = 1;
} else if(set) {
    out = 1;
    out_not = 0;
} else if(edge) {
    out = data_;
    out_not = !data_;
}
