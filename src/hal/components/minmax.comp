// SPDX-License-Identifier: GPL-2.0-or-later
component minmax "Least and greatest value of a signal";
pin in float in_ "Input.";
pin in bit reset "TRUE: both outputs follow the input.";
pin out float max "Greatest input so far.";
pin out float min "Least input so far.";
function _ "Updates the outputs.";
option period no;
license "GPL";
author "Kerf developers";
;;
double x = in_;
/* A value that is not a number is replaced by the next one that is. */
if(reset || x > max || max != max) max = x;
if(reset || x < min || min != min) min = x;
