// SPDX-License-Identifier: GPL-2.0-or-later
component limit_axis "Limits that depend on the position";
pin out bit error_no_range "The feedback is in no range.";
pin out float min_output "Lower limit.";
pin out float max_output "Upper limit.";
pin in float fb "Feedback that chooses the range.";
pin out u32 current_range "Range in use.";
pin in float min_limit_##[10 : personality] "Lower limit of this range.";
pin in float max_limit_##[10 : personality] "Upper limit of this range.";
pin in float min_range_##[10 : personality] "Feedback where this range begins.";
pin in float max_range_##[10 : personality] "Feedback where this range ends.";
pin in bit enable_##[10 : personality] "This range may be used.";
pin in bit sticky_##[10 : personality] "Stay in this range while the feedback is in it, whatever others say.";
pin out bit error_range_##[10 : personality] = 1 "Begin and end of this range are in the wrong order.";
pin out bit error_limit_##[10 : personality] = 1 "The limits of this range are in the wrong order.";
function _ "Updates the limits.";
option extra_setup;
option period no;
description """
The personality is the number of ranges, 2 to 10. The first enabled range that holds the feedback
gives the limits.
""";
license "GPL";
author "Kerf developers";
;;
EXTRA_SETUP() {
    if(personality < 2) personality = 2;
    if(personality > 10) personality = 10;
    return 0;
}

FUNCTION(_) {
    int i, now = current_range;
    if(now < personality && sticky(now) && enable(now)
       && min_range(now) <= fb && fb <= max_range(now)) {
        max_output = max_limit(now);
        min_output = min_limit(now);
        return;
    }
    for(i = 0; i < personality; i++) {
        if(!enable(i)) continue;
        if(max_range(i) < min_range(i)) {
            if(!error_range(i))
                rtapi_print_msg(RTAPI_MSG_ERR, "limit_axis: Range %d: its end is below its begin\n", i);
            error_range(i) = 1;
            continue;
        }
        error_range(i) = 0;
        if(max_limit(i) < min_limit(i)) {
            if(!error_limit(i))
                rtapi_print_msg(RTAPI_MSG_ERR, "limit_axis: Range %d: upper limit below lower limit\n", i);
            error_limit(i) = 1;
            continue;
        }
        error_limit(i) = 0;
        if(min_range(i) <= fb && fb <= max_range(i)) {
            max_output = max_limit(i);
            min_output = min_limit(i);
            error_no_range = 0;
            if(i != now) {
                rtapi_print_msg(RTAPI_MSG_INFO, "limit_axis: Switching to Range %d\n", i);
                current_range = i;
            }
            return;
        }
    }
    if(!error_no_range) {
        error_no_range = 1;
        rtapi_print_msg(RTAPI_MSG_ERR, "limit_axis: No Range found corresponding to feedback\n");
    }
}
