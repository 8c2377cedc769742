// SPDX-License-Identifier: GPL-2.0-or-later
component filter_kalman "Kalman filter of one variable";
pin in bit debug "Prints input and output in every cycle.";
pin in bit passthrough "TRUE: the output is the input.";
pin in bit reset "TRUE: starts again.";
pin in float zk "Input.";
pin out float xk_out "Filtered input.";
param rw float Rk = 1.17549e-38 "Variance of the measurement.";
param rw float Qk = 1.17549e-38 "Variance of the process.";
variable double x;
variable double p = 1.0;
variable int index;
function _ "Updates the output.";
option post_export;
option period no;
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
POST_EXPORT() {
    index = (int)extra_arg;
    return 0;
}
FUNCTION(_) {
    if(reset) {
        x = 0;
        p = 1;
        xk_out = 0;
        return;
    }
    if(passthrough) {
        xk_out = zk;
        return;
    }
    double predicted = p + Qk, gain = predicted / (Rk + predicted);
    if(isfinite(zk) && isfinite(gain)) {
        x += gain * (zk - x);
        p = (1 - gain) * predicted;
    }
    xk_out = x;
    if(debug) rtapi_print_msg(RTAPI_MSG_ERR, "filter-kalman.%d %f %f\n", index, (double)zk, (double)xk_out);
}
