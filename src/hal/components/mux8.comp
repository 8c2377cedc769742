// SPDX-License-Identifier: GPL-2.0-or-later
component mux8 "Selects one of eight floats";
pin in bit sel0 "Bit 0 of the selection.";
pin in bit sel1 "Bit 1 of the selection.";
pin in bit sel2 "Bit 2 of the selection.";
pin in float in#[8] "Inputs.";
pin out float out "The selected input.";
function _ "Updates the output.";
option period no;
see_also "mux2(9), mux4(9), mux16(9), mux_generic(9)";
license "GPL";
author "Kerf developers";
;;
out = in(sel0 + 2 * sel1 + 4 * sel2);
