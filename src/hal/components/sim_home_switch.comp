// SPDX-License-Identifier: GPL-2.0-or-later
component sim_home_switch "Simulated home switch and index";
pin in float cur_pos "Position of the axis.";
pin in float home_pos = 1 "Position of the switch; the axis is on it beyond this, away from zero.";
pin in float hysteresis = 0.1 "Way back until the switch opens.";
pin out bit home_sw "The switch.";
pin io bit index_enable "Made FALSE some time after it became TRUE, as by an encoder's index.";
pin in float index_delay_ms = 10 "That time in milliseconds.";
variable double timer;
variable int was_enabled;
function _ "Updates the switch.";
see_also "sim_axis_hardware(9)";
license "GPL";
author "Kerf developers";
;;
if(home_pos >= 0) {
    if(cur_pos >= home_pos) home_sw = 1;
    else if(cur_pos <= home_pos - hysteresis) home_sw = 0;
} else {
    if(cur_pos <= home_pos) home_sw = 1;
    else if(cur_pos >= home_pos + hysteresis) home_sw = 0;
}
if(timer > 0) {
    timer -= period * 1e-6;
    if(timer <= 0) {
        timer = 0;
        index_enable = 0;
        return;
    }
}
if(index_enable && !was_enabled) timer = index_delay_ms;
was_enabled = index_enable;
