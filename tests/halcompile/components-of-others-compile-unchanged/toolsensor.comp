// SPDX-License-Identifier: GPL-2.0-or-later
component toolsensor
"Two functions, io pins, several instances
.B loadrt toolsensor
.RB [count=N|names=...]";

pin io  bit  index_enable;
pin in  bit  sensor;
pin out s32  trips = 0; // start value
pin out u32  trips_u;
pin io  float position.#[2];
param rw s32 limit = 3;
variable int was;
variable int64_t total;
function read nofp "Counts";
function write nofp;
license "GPLv2";
author "B. User <b@example.org>";
option period no;
;;
#include <rtapi_string.h>
FUNCTION(read) {
    if(sensor && !was) { trips++; trips_u += 1; }
    was = sensor;
    if(trips >= limit) { index_enable = 0; trips = 0; }
    position(0) += 0.5;
    *position_ptr(1) = position(0) * 2;
}

FUNCTION(write) {
    hal_s32_t *p = trips_ptr;
    rtapi_s32 v = *p;
    (void)v;
}
