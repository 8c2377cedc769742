// SPDX-License-Identifier: GPL-2.0-or-later
component moveoff "Moves joints by offsets while the program is paused";
pin in bit power_on "The machine is on.";
pin in bit move_enable "Offsets may be applied; connect it to halui.program.is-paused.";
pin in bit apply_offsets "Apply the offsets.";
pin in bit backtrack_enable = 1 "Go back the way that was recorded.";
pin in float epsilon = 0.0005 "An offset below this is zero; at least 0.0001.";
pin in float waypoint_threshold = 0.02 "Smallest way of a joint between waypoints.";
pin in float waypoint_sample_secs = 0.02 "Shortest time between waypoints.";
pin out bit warning "The offsets were switched off before they were removed.";
pin out bit offset_applied "At least one offset is not zero.";
pin out bit waypoint_limit = 0 "No more waypoints can be recorded: the joints stop.";
pin out signed waypoint_ct = 0 "Number of waypoints.";
pin out signed waypoint_percent_used = 0 "Share of the waypoints that are used.";
pin in bit dbg_waypoint_limit_test "Only 50 waypoints, for testing.";
pin out signed dbg_state "State: 0 idle, 1 moving away, 2 moving back.";
pin in float offset_in-#[9 : personality] "Offset wanted of each joint.";
pin in float pos-#[9 : personality] "Commanded position of each joint; from joint.N.motor-pos-cmd.";
pin in float fb-#[9 : personality] "Feedback of each joint.";
pin out float offset_current-#[9 : personality] "Present offset.";
pin out float pos_plusoffset-#[9 : personality] "Position with the offset, to the motor.";
pin out float fb_minusoffset-#[9 : personality] "Feedback without the offset, to joint.N.motor-pos-fb.";
pin in float offset_vel-#[9 : personality] = 10 "Velocity limit of the offset.";
pin in float offset_accel-#[9 : personality] = 100 "Acceleration limit of the offset.";
pin in float offset_min-#[9 : personality] = -1e20 "Lower limit of the offset.";
pin in float offset_max-#[9 : personality] = 1e20 "Upper limit of the offset.";
function read_inputs "Reads the requests; before the motion controller.";
function write_outputs "Moves the offsets; after it.";
option extra_setup;
description """
While *power-on*, *move-enable* and *apply-offsets* are TRUE the joints are moved by the offsets *offset-in-M*,
each within its limits of velocity and acceleration. When one of *move-enable* and *apply-offsets* goes FALSE, the
offsets are taken back, with *backtrack-enable* along the recorded waypoints.

The personality is the number of joints, 1 to 9 (0 means 3). Only one instance may be loaded.
""";
examples """
----
loadrt moveoff names=mv personality=3
addf mv.read-inputs servo-thread
addf mv.write-outputs servo-thread
----
""";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
#define JOINTS 9
#define MAX_WAYPOINTS 1000
#define TEST_WAYPOINTS 50
#define LEAST_EPSILON 0.0001
#define TIE 1e-6            /* velocities are the same within this share of a cycle's change */

enum { IDLE, MOVE_AWAY, MOVE_BACK };

static int state, next_state, moving, warned, waypoints, max_waypoints;
static double small, threshold, sample_s;
static rtapi_s64 now_ns, sampled_ns;    /* time of the thread, and of the last waypoint */
static double waypoint[MAX_WAYPOINTS][JOINTS], goal[JOINTS];

/* An offset on its way to the goal. */
static struct mover {
    double at, velocity, old_in;
} mover[JOINTS];

EXTRA_SETUP() {
    if(personality == 0) personality = 3;
    if(personality < 0 || personality > JOINTS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "moveoff: personality must be 1 to %d (the number of joints)\n", JOINTS);
        return -EINVAL;
    }
    return 0;
}

static void forget(void) {
    memset(mover, 0, sizeof mover);
    memset(goal, 0, sizeof goal);
}

static void set_goal(struct __comp_state *__comp_inst, const double *to) {
    int i;
    for(i = 0; i < personality; i++) goal[i] = to ? to[i] : 0;
}

static void goal_from_inputs(struct __comp_state *__comp_inst) {
    int i;
    for(i = 0; i < personality; i++) goal[i] = isfinite(offset_in(i)) ? offset_in(i) : goal[i];
}

static void take_parameters(struct __comp_state *__comp_inst) {
    threshold = waypoint_threshold;
    sample_s = waypoint_sample_secs;
    small = epsilon < LEAST_EPSILON ? LEAST_EPSILON : epsilon;
    max_waypoints = dbg_waypoint_limit_test ? TEST_WAYPOINTS : MAX_WAYPOINTS;
    waypoints = 0;
}

/* A new waypoint when enough time has passed and a joint has moved enough. */
static void record_waypoint(struct __comp_state *__comp_inst) {
    int i, moved = 0;
    if(waypoint_limit || (now_ns - sampled_ns) * 1e-9 < sample_s) return;
    for(i = 0; i < personality; i++) {
        double last = waypoints > 0 ? waypoint[waypoints - 1][i] : 0;
        if(fabs(offset_current(i) - last) > threshold) moved = 1;
    }
    if(!moved) return;
    sampled_ns = now_ns;
    for(i = 0; i < personality; i++) waypoint[waypoints][i] = offset_current(i);
    waypoints++;
    if(waypoints > max_waypoints - 1) waypoint_limit = 1;
}

static void power_lost(struct __comp_state *__comp_inst) {
    forget();
    moving = 0;
    offset_applied = 0;
    next_state = IDLE;
}

static void move_back(struct __comp_state *__comp_inst, int backtrack) {
    int i, there = 1;
    if(!power_on) {
        power_lost(__comp_inst);
        return;
    }
    if(backtrack) {
        if(waypoints > 0) {
            for(i = 0; i < personality; i++) if(fabs(offset_current(i) - goal[i]) > small) there = 0;
            if(there) {
                set_goal(__comp_inst, waypoint[waypoints]);
                waypoints--;
            }
        } else {
            set_goal(__comp_inst, NULL);
        }
    }
    if(!offset_applied) {
        next_state = IDLE;
        moving = 0;
        forget();
    }
}

static void warn(struct __comp_state *__comp_inst) {
    int i;
    warning = !apply_offsets && offset_applied;
    if(!warning) {
        warned = 0;
        return;
    }
    if(warned) return;
    warned = 1;
    for(i = 0; i < personality; i++)
        rtapi_print_msg(RTAPI_MSG_ERR, "Index: %i, offset=%f\n", i, (double)offset_current(i));
    rtapi_print_msg(RTAPI_MSG_ERR, "apply_offsets deasserted before offsets removed moveoff.comp: WARNING\n");
}

FUNCTION(read_inputs) {
    int enable = power_on && move_enable && apply_offsets, backtrack = backtrack_enable;
    now_ns += period;
    if(state == IDLE) take_parameters(__comp_inst);
    else if(state == MOVE_AWAY) record_waypoint(__comp_inst);
    switch(state) {
    case IDLE:
        sampled_ns = now_ns;
        if(enable) {
            next_state = MOVE_AWAY;
            moving = 1;
            goal_from_inputs(__comp_inst);
        }
        break;
    case MOVE_AWAY:
        moving = 1;
        if(enable) {
            goal_from_inputs(__comp_inst);
        } else if(!power_on) {
            power_lost(__comp_inst);
        } else {
            next_state = MOVE_BACK;
            set_goal(__comp_inst, NULL);
            if(backtrack && waypoints > 0) {
                set_goal(__comp_inst, waypoint[waypoints - 1]);
                waypoint_limit = 0;
                waypoints--;
            }
        }
        break;
    default:
        move_back(__comp_inst, backtrack);
    }
    warn(__comp_inst);
}

/* One step of an offset towards `in`, within its limits. */
static void step(struct mover *m, double in, double low, double high, double v, double a, double dt) {
    double in_velocity, least_v, most_v, least, most, before = m->at;
    if(in > high) in = high;
    else if(in < low) in = low;
    in_velocity = (in - m->old_in) / dt;
    least_v = fmax(m->velocity - a * dt, -v);
    most_v = fmin(m->velocity + a * dt, v);
    least = m->at + least_v * dt;
    most = m->at + most_v * dt;
    if(in >= least && in <= most && in_velocity >= least_v && in_velocity <= most_v) {
        m->velocity = (in - m->at) / dt;
        m->at = in;
    } else {
        double ramp = in_velocity > m->velocity ? a : -a;
        double match = (in_velocity - m->velocity) / ramp;
        double est_out = m->at + 0.5 * (in_velocity + m->velocity + ramp * dt) * match;
        double est_in = m->old_in + in_velocity * match;
        double error = est_out - est_in, dp = -2 * ramp * dt * match;
        if(fabs(in_velocity - m->velocity) <= TIE * a * dt) {
            /* Nothing to match: the sign of a rounding error must not decide, or the offset creeps for ever. */
            ramp = m->at > in ? -a : a;
        } else if(fabs(error + dp * 2) < fabs(error)) {
            ramp = -ramp;
        }
        m->at = ramp < 0 ? least : most;
        m->velocity = ramp < 0 ? least_v : most_v;
    }
    m->old_in = in;
    if(!isfinite(m->at) || !isfinite(m->velocity)) {
        /* A limit was not a number: stay. */
        m->at = before;
        m->velocity = 0;
    }
}

static void write_moving(struct __comp_state *__comp_inst, double dt) {
    int i;
    for(i = 0; i < personality; i++) {
        struct mover *m = &mover[i];
        double old = m->at;
        step(m, goal[i], offset_min(i), offset_max(i), offset_vel(i), offset_accel(i), dt);
        offset_current(i) = m->at;
        fb_minusoffset(i) = fb(i) - m->at - (old - m->at);
        pos_plusoffset(i) = pos(i) + m->at;
    }
}

FUNCTION(write_outputs) {
    int i, applied = 0;
    if(!moving) {
        for(i = 0; i < personality; i++) {
            pos_plusoffset(i) = pos(i);
            offset_current(i) = 0;
            fb_minusoffset(i) = fb(i);
        }
    } else if(!(waypoint_limit && state == MOVE_AWAY)) {
        write_moving(__comp_inst, fperiod);
    }
    for(i = 0; i < personality; i++) if(fabs(offset_current(i)) > small) applied = 1;
    offset_applied = applied;
    if(!applied) {
        waypoints = 0;
        waypoint_limit = 0;
    }
    waypoint_ct = waypoints;
    waypoint_percent_used = max_waypoints ? 100 * waypoints / max_waypoints : 0;
    dbg_state = state;
    state = next_state;
}
