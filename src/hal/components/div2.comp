// SPDX-License-Identifier: GPL-2.0-or-later
component div2 "Quotient of two inputs";
pin in float in0 "Dividend.";
pin in float in1 "Divisor.";
pin out float out "in0 / in1; a divisor nearer to zero than *deadband* counts as *deadband* with its sign.";
param rw float deadband "Smallest size of the divisor; at least 1e-12.";
function _ "Updates the output.";
option period no;
description """
A divisor inside the deadband is reported once, until a division was possible again.
""";
see_also "mult2(9), invert(9), scale(9)";
license "GPL";
author "Kerf developers";
;;
static int reported;

FUNCTION(_) {
    double divisor = in1;
    if(!(deadband >= 1e-12)) deadband = 1e-12;
    if(divisor > -deadband && divisor < deadband) {
        int negative = divisor < 0;
        if(!reported) {
            reported = 1;
            rtapi_print_msg(RTAPI_MSG_ERR, negative
                            ? "DIV2 DIVISOR IS TOO CLOSE TO -ZERO, deadband is used\n"
                            : "DIV2 DIVISOR IS TOO CLOSE TO +ZERO, deadband is used\n");
        }
        out = in0 / (negative ? -deadband : deadband);
    } else {
        reported = 0;
        out = in0 / divisor;
    }
}
