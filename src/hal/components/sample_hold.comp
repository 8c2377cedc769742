// SPDX-License-Identifier: GPL-2.0-or-later
component sample_hold "Sample and hold of an integer";
pin in signed in_ "Input.";
pin in bit hold "The output keeps its value while this is TRUE.";
pin out signed out "Last input that was sampled.";
function _ "Updates the output.";
option period no;
license "GPL";
author "Kerf developers";
;;
if(!hold) out = in_;
