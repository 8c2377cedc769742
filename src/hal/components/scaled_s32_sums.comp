// SPDX-License-Identifier: GPL-2.0-or-later
component scaled_s32_sums "Sum of four scaled integers";
pin in s32 in#[4] "Inputs.";
pin in float scale#[4] = 1.0 "Factor of each input.";
pin out s32 out_s "The sum, truncated.";
pin out float out_f "The sum.";
function _ "Updates the outputs.";
option period no;
see_also "sum2(9), weighted_sum(9)";
license "GPL";
author "Kerf developers";
include "components/real_to_int.h";
;;
double sum = in(0) * scale(0) + in(1) * scale(1) + in(2) * scale(2) + in(3) * scale(3);
out_f = sum;
out_s = real_to_s32(sum);
