// SPDX-License-Identifier: GPL-2.0-or-later
component bin2gray "Binary number to Gray code";
pin in unsigned in_ "Binary number.";
pin out unsigned out "Its Gray code.";
function _ "Updates the output.";
option period no;
see_also "gray2bin(9)";
license "GPL";
author "Kerf developers";
;;
rtapi_u32 number = in_;
out = number ^ (number >> 1);
