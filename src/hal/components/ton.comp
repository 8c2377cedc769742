// SPDX-License-Identifier: GPL-2.0-or-later
component ton "IEC 61131 TON timer: delay of the rising edge";
pin in bit in_ "Input.";
pin out bit q "TRUE once the input was TRUE for *pt* seconds.";
pin out float et "Elapsed time in seconds.";
param rw float pt "Delay in seconds.";
function _ "Updates the timer.";
see_also "tof(9), tp(9), timedelay(9)";
license "GPL";
author "Kerf developers";
;;
if(pt < 0) {
    pt = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "ton: Delay time must be positive, resetting to 0\n");
}
if(et < 0) {
    et = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "ton: Elapsed time rolled over, resetting to 0\n");
}
if(in_) {
    if(et >= pt) q = 1;
    else et += fperiod;
} else {
    et = 0;
    q = 0;
}
