// SPDX-License-Identifier: GPL-2.0-or-later
component counted "The count comes from the module's own parameter";
pin out bit active;
pin in s32 value;
pin out s32 doubled;
modparam dummy widths "One width for each instance";
modparam int trace = 0 "Print a line for each instance";
function _;
option count_function;
option extra_setup;
license "GPL";
;;
#define MAX_COUNT 8
static int widths[MAX_COUNT] = { 0, };
RTAPI_MP_ARRAY_INT(widths, MAX_COUNT, "widths");

int get_count(void) {
    int i;
    for(i = 0; i < MAX_COUNT && widths[i]; i++) ;
    return i;
}

EXTRA_SETUP() {
    if(trace) rtapi_print_msg(RTAPI_MSG_ERR, "%s has width %d\n", prefix, widths[extra_arg]);
    return 0;
}

FUNCTION(_) {
    active = value != 0;
    doubled = 2 * value;
}
