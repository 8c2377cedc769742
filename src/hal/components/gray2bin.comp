// SPDX-License-Identifier: GPL-2.0-or-later
component gray2bin "Gray code to binary number";
pin in unsigned in_ "Gray code.";
pin out unsigned out "Binary number.";
function _ "Updates the output.";
option period no;
see_also "bin2gray(9)";
license "GPL";
author "Kerf developers";
;;
rtapi_u32 code = in_;
int shift;
for(shift = 16; shift; shift /= 2) code ^= code >> shift;
out = code;
