// SPDX-License-Identifier: GPL-2.0-or-later
component comp "Comparator with hysteresis";
pin in float in0 "Reference (inverting input).";
pin in float in1 "Value (non-inverting input).";
pin out bit out "TRUE when in1 is above in0 + hyst/2, FALSE when below in0 - hyst/2, else unchanged.";
pin out bit equal "TRUE while the difference is within hyst/2.";
param rw float hyst = 0.0 "Hysteresis.";
function _ "Updates the outputs.";
option period no;
see_also "wcomp(9), near(9)";
license "GPL";
author "Kerf developers";
;;
double difference = in1 - in0, half = hyst / 2;
if(difference < -half) {
    out = 0;
    equal = 0;
} else if(difference > half) {
    out = 1;
    equal = 0;
} else {
    equal = 1;
}
