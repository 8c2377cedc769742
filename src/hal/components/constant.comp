// SPDX-License-Identifier: GPL-2.0-or-later
component constant "A number as a signal";
pin out float out "The value.";
param rw float value "What the output gives.";
function _ "Updates the output.";
option period no;
see_also "supply(9)";
license "GPL";
author "Kerf developers";
;;
out = value;
