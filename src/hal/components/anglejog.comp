// SPDX-License-Identifier: GPL-2.0-or-later
component anglejog "Jogs two axes at an angle";
pin in bit enable_in "TRUE: counts move.";
pin in signed counts_in "Counts of a jog wheel.";
pin in float angle_degrees_in "Direction.";
pin in signed iscale_factor = 10000 "Internal scaling, 10 to 100000; taken while not enabled.";
pin in float scale_in "Movement per count.";
pin in float max_vel "Velocity limit.";
pin in float max_accel "Acceleration limit.";
pin in float accel_fraction_in = 1 "Acceleration share for the axes together.";
pin out bit enable_out "To the axes' jog-enable.";
pin out float current_scale "Movement per count of the wheel in use.";
pin out float current_scale_out "To the axes' jog-scale: movement per output count.";
pin out signed coscounts "To the jog-counts of the first axis.";
pin out signed sincounts "To the jog-counts of the second axis.";
pin out float cos_accel_fraction "To the jog-accel-fraction of the first axis.";
pin out float sin_accel_fraction "To the jog-accel-fraction of the second axis.";
pin out bit active "TRUE while moving.";
pin out float current_angle_degrees "Direction in use; changes only while not enabled.";
pin out float current_mag "Distance along the direction.";
pin out float current_vel "Velocity along the direction.";
function _ "Updates the outputs.";
description "Only one instance may be loaded.";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
include "components/real_to_int.h";
;;
static int running, was_enabled, waiting, bogus_told;
static rtapi_s64 factor, old_counts, total;

FUNCTION(_) {
    rtapi_s64 counts, delta;
    double step = max_accel * fperiod, tiny = step * fperiod * 0.001, request = 0, limit, error, theta;
    int moving = 0, active_now;
    if(!isfinite(max_accel + max_vel + scale_in + angle_degrees_in)) {
        active = 0;                     /* nothing to move by */
        return;
    }
    if(!running) {
        running = 1;
        current_angle_degrees = angle_degrees_in;
        current_scale = scale_in;
        current_scale_out = scale_in / iscale_factor;
        factor = iscale_factor;
    }
    counts = factor * counts_in;
    if(enable_in && !was_enabled) {
        old_counts = counts;
        waiting = 1;
        total = real_to_s64(current_mag / current_scale_out);
    }
    was_enabled = enable_in;
    delta = counts - old_counts;
    old_counts = counts;
    enable_out = enable_in;
    if(delta != 0) waiting = 0;
    if(enable_in) total += delta;

    active_now = 0;
    error = total * current_scale_out - current_mag;
    if(enable_in && !waiting) {
        moving = 1;
        if(error > tiny) {
            request = -step + sqrt(2 * max_accel * error + step * step);
            active_now = 1;
        } else if(error < -tiny) {
            request = step - sqrt(-2 * max_accel * error + step * step);
            active_now = 1;
        }
    }
    if(!moving) {
        if(!enable_in) {
            int changed = 0;
            if(iscale_factor != factor) {
                if(iscale_factor >= 10 && iscale_factor <= 100000) {
                    factor = iscale_factor;
                    changed = 1;
                    bogus_told = 0;
                    rtapi_print("new ifactor=%d\n", (int)factor);
                } else if(!bogus_told) {
                    bogus_told = 1;
                    rtapi_print("BOGUS iscale_factor=%d\n", (int)iscale_factor);
                }
            }
            current_angle_degrees = angle_degrees_in;
            if(current_scale_out != scale_in || changed) {
                current_scale = scale_in;
                current_scale_out = scale_in / factor;
                total = real_to_s64(current_mag / current_scale_out);
            }
        }
        if(waiting) {
            active = active_now;
            return;
        }
    }
    limit = max_vel;
    if(request > limit) request = limit;
    else if(request < -limit) request = -limit;
    if(request > current_vel + step) current_vel += step;
    else if(request < current_vel - step) current_vel -= step;
    else current_vel = request;
    if(current_vel != 0) active_now = 1;
    active = active_now;
    current_mag += current_vel * fperiod;
    theta = current_angle_degrees * M_PI / 180;
    coscounts = real_to_s32(current_mag * cos(theta) / current_scale_out);
    sincounts = real_to_s32(current_mag * sin(theta) / current_scale_out);
    cos_accel_fraction = accel_fraction_in * cos(theta);
    sin_accel_fraction = accel_fraction_in * sin(theta);
}
