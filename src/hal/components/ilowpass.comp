// SPDX-License-Identifier: GPL-2.0-or-later
component ilowpass "Low-pass filter of first order for an integer";
pin in s32 in_ "Input.";
pin out s32 out "The filtered input times *scale*.";
param rw float scale = 1024 "Factor, so that less of the fraction is lost.";
param rw float gain = 0.5 "Share of the difference that is taken in a cycle, 0 to 1.";
variable double value;
function _ "Updates the output.";
option period no;
description "Used to smooth a jog wheel: scale the jog increment down by the same factor.";
see_also "lowpass(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include "components/real_to_int.h";
;;
value += (in_ - value) * gain;
if(!isfinite(value)) value = in_;
out = (rtapi_s32)real_to_s64(floor(value * scale + 0.5));
