// SPDX-License-Identifier: GPL-2.0-or-later
component clarke2 "Clarke transform of two phases to cartesian";
pin in float a "First phase.";
pin in float b "Second phase.";
pin out float x "Component along the first phase.";
pin out float y "Component at a right angle to it.";
function _ "Updates the outputs.";
option period no;
description "For three phases whose sum is zero, so that two of them say everything.";
see_also "clarke3(9), clarkeinv(9)";
license "GPL";
author "Kerf developers";
;;
x = a;
y = 0.577350269189626 * a + 1.154700538379250 * b;
