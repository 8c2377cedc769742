// SPDX-License-Identifier: GPL-2.0-or-later
component axistest "Moves an axis to and fro for testing";
pin in bit jog_minus "TRUE: moves in negative direction.";
pin in bit jog_plus "TRUE: moves in positive direction.";
pin in bit run "TRUE: runs to and fro.";
pin in float maxvel "Velocity of the test.";
pin in float amplitude "Length of the movement.";
pin in signed dir "0: both sides of the start, 1: positive side, 2: negative side.";
pin in float position_fb "Position of the axis.";
pin out float position_cmd "Command to the axis.";
pin out bit running "The test runs.";
pin out float run_target "Not used.";
pin out float run_start "Position where the test began.";
pin out float run_low "Low end of the movement.";
pin out float run_high "High end of the movement.";
pin in signed pause = 0 "Seconds to wait at each end.";
param rw float epsilon = 0.001 "The axis is at its goal when nearer than this.";
param r float elapsed "Seconds of waiting.";
variable double timer;
variable int timer_on;
function update "Updates the command.";
see_also "steptest(9), sim_axis_hardware(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
FUNCTION(update) {
    if(timer_on) timer += fperiod;
    elapsed = timer;
    if(run) {
        if(!running) {
            running = 1;
            run_start = position_fb;
            run_high = dir == 2 ? run_start : run_start + amplitude;
            run_low = dir == 1 ? run_start : run_start - amplitude;
            position_cmd = run_low;
        }
        if(fabs(position_fb - position_cmd) < epsilon
           && (position_cmd == run_low || position_cmd == run_high)) {
            if(!timer_on) {
                timer = 0;
                timer_on = 1;
            } else if(timer >= pause) {
                timer_on = 0;
                position_cmd = position_cmd == run_low ? run_high : run_low;
            }
        }
    } else if(running) {
        position_cmd = run_start;
        if(fabs(position_fb - run_start) < epsilon) {
            running = 0;
            timer_on = 0;
        }
    } else if(jog_minus) {
        position_cmd = position_fb - 10;
    } else if(jog_plus) {
        position_cmd = position_fb + 10;
    } else {
        position_cmd = position_fb;
    }
}
