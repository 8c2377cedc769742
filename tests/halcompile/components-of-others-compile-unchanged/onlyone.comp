// SPDX-License-Identifier: GPL-2.0-or-later
component onlyone "Singleton with conditional and 64-bit pins";
pin in s64 in-a;
pin in u64 in-b;
pin out s64 diff;
pin out bit big if personality > 4 "Only for large personalities";
pin out float matrix-##-x[4];
variable double history[3] = 1.5;
option singleton yes;
option post_export;
function calc "Main";
license "GPL";
;;
POST_EXPORT() {
    (void)extra_arg;
    rtapi_print_msg(RTAPI_MSG_DBG, "exported as %s\n", prefix);
    return 0;
}

FUNCTION(calc) {
    int i;
    diff = in_a - (rtapi_s64)in_b;
    for(i = 0; i < 3; i++) matrix_x(i) = history[i];
    if(personality > 4) big = diff > 10;
}
