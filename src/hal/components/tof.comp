// SPDX-License-Identifier: GPL-2.0-or-later
component tof "IEC 61131 TOF timer: delay of the falling edge";
pin in bit in_ "Input.";
pin out bit q "Stays TRUE for *pt* seconds after the input became FALSE.";
pin out float et "Elapsed time in seconds.";
param rw float pt "Delay in seconds.";
function _ "Updates the timer.";
see_also "ton(9), tp(9), timedelay(9)";
license "GPL";
author "Kerf developers";
;;
if(pt < 0) {
    pt = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "tof: Delay time must be positive, resetting to 0\n");
}
if(et < 0) {
    et = 0;
    rtapi_print_msg(RTAPI_MSG_WARN, "tof: Elapsed time rolled over, resetting to 0\n");
}
if(in_) {
    q = 1;
    et = 0;
} else if(et >= pt) {
    q = 0;
} else {
    et += fperiod;
}
