// SPDX-License-Identifier: GPL-2.0-or-later
component wcomp "Window comparator";
pin in float in_ "Value.";
pin in float min_ "Low end of the window.";
pin in float max_ "High end of the window.";
pin out bit out "TRUE while the value is strictly between both ends.";
pin out bit under "TRUE while the value is at or below the low end.";
pin out bit over "TRUE while the value is at or above the high end.";
function _ "Updates the outputs.";
option period no;
see_also "comp(9), near(9)";
license "GPL";
author "Kerf developers";
;;
double x = in_;
under = x <= min_;
over = x >= max_;
out = !(under || over);
