// SPDX-License-Identifier: GPL-2.0-or-later
component multiswitch "Switch of several positions, moved by up and down buttons";
modparam dummy cfg "Number of positions of each instance, separated by commas, at most 32 instances.";
pin in bit up "A rising edge goes to the next position.";
pin in bit down "A rising edge goes to the position before.";
param rw unsigned top_position "Highest position; after it comes 0.";
param rw signed position "Present position.";
pin out bit bit-##[32 : personality] "TRUE for the present position.";
variable int was_up;
variable int was_down;
function _ "Updates the position.";
option extra_setup;
option post_export;
option count_function;
option period no;
description "Without *cfg* there is one instance of four positions.";
see_also "select8(9), radiobutton(9), updown(9)";
license "GPL";
author "Kerf developers";
;;
#define MAX_INSTANCES 32
#define DEFAULT_POSITIONS 4
static int cfg[MAX_INSTANCES];
RTAPI_MP_ARRAY_INT(cfg, MAX_INSTANCES, "number of positions of each instance");

int get_count(void) {
    int n = 0;
    if(cfg[0] == 0) cfg[0] = DEFAULT_POSITIONS;
    while(n < MAX_INSTANCES && cfg[n]) n++;
    return n;
}

EXTRA_SETUP() {
    personality = cfg[extra_arg];
    return 0;
}

POST_EXPORT() {
    top_position = (rtapi_u32)personality - 1;
    return 0;
}

FUNCTION(_) {
    int i, goes_up = up && !was_up, goes_down = down && !was_down;
    was_up = up;
    was_down = down;
    position += goes_up - goes_down;
    if(position < 0) position = (rtapi_s32)top_position;
    if((rtapi_u32)position > top_position) position = 0;
    for(i = 0; i < personality; i++) bit(i) = i == position;
}
