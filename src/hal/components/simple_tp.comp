// SPDX-License-Identifier: GPL-2.0-or-later
component simple_tp "Trajectory planner for one axis: trapezoidal velocity profile";
pin in float target_pos "Position to go to.";
pin in float maxvel "Velocity limit, per second.";
pin in float maxaccel "Acceleration limit, per second squared.";
pin in bit enable "FALSE: slows down and stops.";
pin out float current_pos "Commanded position.";
pin out float current_vel "Commanded velocity.";
pin out bit active "TRUE while moving.";
function update "Updates position and velocity.";
see_also "limit3(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
FUNCTION(update) {
    double step = maxaccel * fperiod, tiny = step * fperiod * 0.001, request = 0, limit = maxvel;
    active = 0;
    if(!isfinite(maxaccel) || !isfinite(limit)) {
        /* Without limits there is no way to move. */
        current_vel = 0;
        return;
    }
    if(enable) {
        double error = target_pos - current_pos;
        if(error > tiny) {
            request = -step + sqrt(2.0 * maxaccel * error + step * step);
            active = 1;
        } else if(error < -tiny) {
            request = step - sqrt(-2.0 * maxaccel * error + step * step);
            active = 1;
        }
    }
    if(request > limit) request = limit;
    else if(request < -limit) request = -limit;
    if(request > current_vel + step) current_vel += step;
    else if(request < current_vel - step) current_vel -= step;
    else current_vel = request;
    if(current_vel != 0) active = 1;
    current_pos += current_vel * fperiod;
}
