// SPDX-License-Identifier: GPL-2.0-or-later
component sim_spindle "Simulated spindle with index pulse";
pin in float velocity_cmd "Commanded speed.";
pin out float position_fb "Position, in revolutions with the right *scale*.";
pin io bit index_enable "TRUE: position is made zero at the next whole revolution, and this pin FALSE.";
param rw float scale = 1.0 "Factor from speed to revolutions per second.";
function _ "Updates the position.";
see_also "sim_encoder(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
double old = position_fb, next = old + velocity_cmd * fperiod * scale;
if(!isfinite(next)) next = isfinite(old) ? old : 0;
if(index_enable && floor(old) != floor(next)) {
    index_enable = 0;
    if(velocity_cmd < 0) next -= ceil(next);
    else next -= floor(next);
}
position_fb = next;
