// SPDX-License-Identifier: GPL-2.0-or-later
component modmath "Direction to turn to reach a station";
modparam dummy mod_dir = 1 "Number of instances, mod-dir.0 and up.";
pin out bit up "Turn up.";
pin out bit down "Turn down.";
pin out bit on_target = TRUE "The actual station is the desired one.";
pin in signed actual "Present station.";
pin in signed desired "Station wanted.";
pin io signed min_num = 0 "Lowest station.";
pin io signed max_num = 15 "Highest station.";
pin io bit wrap = TRUE "The station after the highest is the lowest: take the shorter way.";
function _ "Updates the outputs.";
option rtapi_app no;
option period no;
license "GPL";
author "Kerf developers";
;;
static int mod_dir = 1;
RTAPI_MP_INT(mod_dir, "number of instances");

int rtapi_app_main(void) {
    int i, r = 0;
    comp_id = hal_init("modmath");
    if(comp_id < 0) return comp_id;
    for(i = 0; !r && i < mod_dir; i++) {
        char name[HAL_NAME_LEN + 1];
        rtapi_snprintf(name, sizeof name, "mod-dir.%d", i);
        r = export(name, i);
    }
    if(r) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) {
    hal_exit(comp_id);
}

/* A station outside the range is folded into it; one below the range stays below. */
static rtapi_s64 fold(rtapi_s64 station, rtapi_s64 low, rtapi_s64 high) {
    rtapi_s64 range = high - low + 1;
    if((station >= low && station <= high) || range == 0) return station;
    return low + (station - low) % range;
}

FUNCTION(_) {
    rtapi_s64 range = (rtapi_s64)max_num - min_num + 1;
    rtapi_s64 way = fold(desired, min_num, max_num) - fold(actual, min_num, max_num);
    if(wrap) {
        if(way > range / 2) way -= range;
        if(way < -(range / 2)) way += range;
    }
    on_target = way == 0;
    up = way > 0;
    down = way < 0;
}
