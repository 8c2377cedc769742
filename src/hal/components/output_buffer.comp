// SPDX-License-Identifier: GPL-2.0-or-later
component output_buffer "Switches a group of outputs off together";
pin in bit enable "TRUE: outputs follow inputs. FALSE: all are *off-level*.";
pin in bit off_level = 0 "Level of the outputs while not enabled.";
pin in bit in-#[32 : personality] "Inputs; their number is the personality.";
pin out bit out-#[32 : personality] "Outputs.";
function _ "Updates the outputs.";
option period no;
license "GPL";
author "Kerf developers";
;;
int i;
for(i = 0; i < personality; i++) out(i) = enable ? in(i) : off_level;
