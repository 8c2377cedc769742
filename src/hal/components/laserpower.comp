// SPDX-License-Identifier: GPL-2.0-or-later
component laserpower "Laser power from velocity, raster or distance to go";
pin in float min_power "Power at zero.";
pin in float max_power "Power at 100 percent and full velocity.";
pin in float req_velocity "Requested velocity.";
pin in float cur_velocity "Present velocity.";
pin in float raster_power "Power of a raster in percent.";
pin in float vector_power "Power of a vector in percent.";
pin in float distance_to_go "Distance to the end of the vector.";
pin in bit enabled "FALSE: no power.";
pin in bit raster_mode "TRUE: *raster-power* is the power.";
pin out float power "Power.";
pin out float command_power "Commanded power in percent.";
pin out float start_power "Power in percent at the start of the vector.";
pin out float start_distance "Distance to go at the start of the vector.";
pin out float vel_scale "Present velocity as a share of the requested one.";
function _ "Updates the power.";
option period no;
description """
While a vector is cut, the power goes in a straight line over the distance from that of the vector before to
that of this one.
""";
see_also "raster(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
static double last_power, last_distance;    /* of vector-power and distance-to-go */

static int is_zero(double x) {
    return fabs(x) < 0.00005;
}

FUNCTION(_) {
    vel_scale = is_zero(req_velocity) || is_zero(cur_velocity) ? 0 : fabs(cur_velocity) / fabs(req_velocity);
    if(raster_mode) {
        command_power = raster_power;
    } else {
        if(last_distance < distance_to_go || !is_zero(vector_power - last_power)) {
            start_power = isfinite(last_power) ? last_power : 0;
            start_distance = distance_to_go;
        }
        last_power = vector_power;
        last_distance = distance_to_go;
        command_power = start_power + (vector_power - start_power) * (1 - distance_to_go / start_distance);
    }
    power = !enabled || command_power < 0 ? 0
        : (max_power - min_power) * vel_scale * (command_power / 100) + min_power;
}
