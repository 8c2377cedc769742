// SPDX-License-Identifier: GPL-2.0-or-later
component select8 "One of eight outputs, chosen by a number";
pin in bit enable = TRUE "All outputs are FALSE while this is FALSE.";
pin in signed sel "Number of the output that is TRUE, 0 to 7.";
pin out bit out#[8] "TRUE while *enable* is TRUE and *sel* is this output's number.";
function _ "Updates the outputs.";
option period no;
see_also "demux(9)";
license "GPL";
author "Kerf developers";
;;
int i;
for(i = 0; i < 8; i++) out(i) = enable && sel == i;
