// SPDX-License-Identifier: GPL-2.0-or-later
component sim_joint "Simulated joint: motor, encoder with index, home and limit switches that bounce";
description """
Stands for the hardware of one joint, so that a configuration can be tried without a machine and
its homing be tested under bad conditions. Add *read* before motion-controller and *write* after it:

    net j0-cmd joint.0.motor-pos-cmd  => sim-joint.0.cmd
    net j0-fb  sim-joint.0.fb         => joint.0.motor-pos-fb
    net j0-hm  sim-joint.0.home-sw    => joint.0.home-sw-in
    net j0-ix  sim-joint.0.index-enable <=> joint.0.index-enable

All places are positions of the slide, which the encoder does not know: it sits on the motor, starts at 0 where the
slide is at the start, and counts from the index once index-enable was set.""";
pin in float cmd "Motor position commanded, in the encoder's coordinates.";
pin out float fb "Position the encoder tells.";
pin out float position "True position of the slide.";
pin out float motor_position "True position of the motor, in the slide's coordinates: within the backlash.";
pin in bit enable = 1 "The motor follows; without it the slide moves with hand-vel.";
pin in float hand_vel "Speed at which somebody pushes the slide while the motor is off, units/s.";
pin in float time_constant "Lag of the drive in seconds; 0 follows exactly.";
pin io bit index_enable "The next index clears the count, and this pin.";
pin in float backlash "Play between motor and slide, units.";
pin in float index_pitch "Distance of the index pulses; 0: none.";
pin in float index_at "Place of one of them.";
pin in bit index_reset = 1 "The index clears the count; without it only the pin.";
pin out bit home_sw "Home switch.";
pin in float home_from = 1e9 "The home switch is closed from here ...";
pin in float home_to = 1e9 "... to here.";
pin out bit neg_lim_sw "Switch of the negative end.";
pin in float neg_lim_at = -1e9 "Closed at and below this.";
pin out bit pos_lim_sw "Switch of the positive end.";
pin in float pos_lim_at = 1e9 "Closed at and above this.";
pin in float hysteresis "A switch that has closed opens this much later.";
pin in float bounce_ms "Time in milliseconds that a contact bounces after each change.";
pin in float noise "Part of the cycles, 0 to 1, in which a switch reads wrongly.";
pin in s32 stuck "1: the home switch stays closed, -1: open, 0: works.";
param rw float start "Place of the slide when the component first runs.";
param rw u32 seed = 1 "Of bounce and noise.";
variable double at;
variable double slide;
variable double zero;
variable double bounce_s[3];
variable int contact[3];
variable int started;
variable unsigned random;
function read "Encoder and switches.";
function write "The motor.";
see_also "sim_home_switch(9), sim_axis_hardware(9)";
license "GPL";
author "Kerf developers";
;;
#include <math.h>

// [servo] A number from 0 to 1, the same sequence for the same seed.
static double chance(unsigned *bits)
{
    *bits = *bits * 1664525u + 1013904223u;
    return (*bits >> 8) / 16777216.0;
}

// [servo] What contact n of the joint reads; closed: where the slide is.
static int switch_reads(struct __comp_state *__comp_inst, int n, int closed, double T)
{
    if(closed != contact[n]) {
        contact[n] = closed;
        bounce_s[n] = bounce_ms * 1e-3;
    }
    int reads = contact[n];
    if(bounce_s[n] > 0) {
        bounce_s[n] -= T;
        reads = chance(&random) < 0.5;
    }
    return noise > 0 && chance(&random) < noise ? !reads : reads;
}

// [servo] Whether a zone is closed, with hysteresis while it is.
static int in_zone(double x, double from, double to, double hyst, int closed)
{
    if(closed) { from -= hyst; to += hyst; }
    return x >= from && x <= to;
}

FUNCTION(read)
{
    double T = period * 1e-9;
    if(!started) {
        started = 1;
        random = seed;
        at = slide = zero = start;
    }
    home_sw = switch_reads(__comp_inst, 0, in_zone(slide, home_from, home_to, hysteresis, contact[0]), T);
    neg_lim_sw = switch_reads(__comp_inst, 1, in_zone(slide, -INFINITY, neg_lim_at, hysteresis, contact[1]), T);
    pos_lim_sw = switch_reads(__comp_inst, 2, in_zone(slide, pos_lim_at, INFINITY, hysteresis, contact[2]), T);
    if(stuck) home_sw = stuck > 0;
    fb = at - zero;
    position = slide;
    motor_position = at;
}

FUNCTION(write)
{
    double T = period * 1e-9, was = at;
    if(!started) return;
    if(!enable) {
        at += hand_vel * T;
        slide += hand_vel * T;
    } else if(time_constant > 0) at += (cmd + zero - at) * (1.0 - exp(-T / time_constant));
    else at = cmd + zero;
    slide = fmax(at - 0.5 * backlash, fmin(at + 0.5 * backlash, slide));
    if(index_enable && index_pitch > 0) {
        double turns = floor((at - index_at) / index_pitch), before = floor((was - index_at) / index_pitch);
        if(turns != before) {
            if(index_reset) zero = index_at + index_pitch * fmax(turns, before);
            index_enable = 0;
        }
    }
}
