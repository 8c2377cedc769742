// SPDX-License-Identifier: GPL-2.0-or-later
component withheader "A header of its own beside it, no macros";
pin in float angle;
pin out float x;
pin out float y;
param rw float radius = 1;
function _ fp;
option no_convenience_defines;
include "withheader.h";
license "GPL";
;;
*__comp_inst->x_p = __comp_inst->radius_p * PLAIN_COS(*__comp_inst->angle_p);
*__comp_inst->y_p = __comp_inst->radius_p * sin(*__comp_inst->angle_p);
