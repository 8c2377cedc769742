// SPDX-License-Identifier: GPL-2.0-or-later
component tp "IEC 61131 TP timer: pulse at the rising edge";
pin in bit in_ "Input.";
pin out bit q "TRUE for *pt* seconds after the input rose.";
pin out float et "Elapsed time in seconds.";
param rw float pt "Length of the pulse in seconds.";
variable int was;
function _ "Updates the timer.";
description "An edge during the pulse, or in the cycle after its end, does not start a new one.";
see_also "ton(9), tof(9), oneshot(9)";
license "GPL";
author "Kerf developers";
;;
int edge = in_ && !was;
was = in_;
if(pt < 0) {
    pt = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "tp: Pulse time must be positive, resetting to 0\n");
}
if(et < 0) {
    et = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "tp: Elapsed time rolled over, resetting to 0\n");
}
if(edge || q) {
    if(et < pt) {
        q = 1;
        et += fperiod;
    } else {
        q = 0;
    }
} else {
    et = 0;
    q = 0;
}
