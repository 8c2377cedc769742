// SPDX-License-Identifier: GPL-2.0-or-later
component blend "Blends two inputs";
pin in float in1 "Output for a select of 1.";
pin in float in2 "Output for a select of 0.";
pin in float select "Share of *in1*.";
pin out float out "in1 * select + in2 * (1 - select).";
param rw bit open "FALSE: select is limited to 0..1. TRUE: no limit.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
;;
double share = select;
if(!open) {
    if(share < 0) share = 0;
    if(share > 1) share = 1;
}
out = in1 * share + in2 * (1 - share);
