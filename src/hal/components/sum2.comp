// SPDX-License-Identifier: GPL-2.0-or-later
component sum2 "Sum of two inputs, each with a gain";
pin in float in0 "First input.";
pin in float in1 "Second input.";
param rw float gain0 = 1.0 "Factor of the first input.";
param rw float gain1 = 1.0 "Factor of the second input.";
param rw float offset "Added to the sum.";
pin out float out "in0 * gain0 + in1 * gain1 + offset.";
function _ "Updates the output.";
option period no;
see_also "scale(9), weighted_sum(9), scaled_s32_sums(9)";
license "GPL";
author "Kerf developers";
;;
out = in0 * gain0 + in1 * gain1 + offset;
