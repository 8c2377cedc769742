// SPDX-License-Identifier: GPL-2.0-or-later
component radiobutton "One of several values, chosen by buttons";
pin in bit sel-##[32 : personality] "Rising to TRUE chooses this number; the highest that is TRUE wins.";
pin out bit out-##[32 : personality] "TRUE for the chosen number.";
pin in float input-##[32 : personality] "Value of this number.";
pin out signed selected = 0 "Chosen number.";
pin out float value "Value of the chosen number.";
function _ "Updates the outputs.";
option period no;
license "GPL";
author "Kerf developers";
;;
int i, n = personality;
for(i = 0; i < n; i++) if(sel(i)) selected = i;
for(i = 0; i < n; i++) {
    out(i) = i == selected;
    if(i == selected) value = input(i);
}
