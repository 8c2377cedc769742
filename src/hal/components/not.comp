// SPDX-License-Identifier: GPL-2.0-or-later
component not "Inverter";
pin in bit in_ "Input.";
pin out bit out "TRUE while the input is FALSE.";
function _ "Updates the output.";
option period no;
see_also "and2(9), or2(9), xor2(9)";
license "GPL";
author "Kerf developers";
;;
out = !in_;
