// SPDX-License-Identifier: GPL-2.0-or-later
component timedelta "Measures the time between calls";
pin out signed jitter "Greatest deviation from the period, in ns.";
pin out signed current_jitter "Deviation of this call, without sign.";
pin out signed current_error "Deviation of this call.";
pin out signed min_ "Shortest time between calls.";
pin out signed max_ "Longest time between calls.";
pin in bit reset "TRUE: starts again.";
pin out signed out "Time since the last call.";
pin out signed err "Sum of the deviations.";
pin out float avg_err "Mean deviation.";
variable rtapi_s64 last;
variable rtapi_s64 total;
variable int first = 1;
function _ "Measures.";
see_also "latencybins(9)";
license "GPL";
author "Kerf developers";
;;
static rtapi_s64 calls;                       /* of all instances */

FUNCTION(_) {
    rtapi_s64 now = rtapi_get_time();
    if(last != 0) {
        rtapi_s32 delta = (rtapi_s32)(now - last);
        out = delta;
        total += delta - period;
        err = (rtapi_s32)total;
        if(first) {
            first = 0;
            min_ = delta;
            max_ = delta;
            jitter = 0;
        } else {
            rtapi_s32 over, under;
            if(delta < min_) min_ = delta;
            if(delta > max_) max_ = delta;
            over = (rtapi_s32)(max_ - period);
            under = (rtapi_s32)(period - min_);
            jitter = over > under ? over : under;
        }
        current_error = (rtapi_s32)(delta - period);
        current_jitter = current_error < 0 ? -current_error : current_error;
    }
    calls++;
    avg_err = (double)total / (double)calls;
    if(reset) {
        first = 1;
        last = 0;
        out = 0;
        jitter = 0;
        max_ = 0;
    } else {
        last = now;
    }
}
