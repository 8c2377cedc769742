// SPDX-License-Identifier: GPL-2.0-or-later
component limit3 "Limits a value, its velocity and its acceleration";
pin in float in_ "Input.";
pin in bit enable = TRUE "FALSE: the output goes to 0 within the limits.";
pin out float out "The input within the limits.";
pin in bit load = 0 "TRUE: the output goes to the input at once; hold it for two cycles or more.";
pin in float min_ = -1e20 "Lower limit of the position.";
pin in float max_ = 1e20 "Upper limit of the position.";
pin in float maxv = 1e20 "Limit of the velocity, per second.";
pin in float maxa = 1e7 "Limit of the acceleration, per second squared.";
pin in unsigned smooth_steps = 2 "Cycles before the goal in which the approach is smoothed.";
variable double in_old;
variable double out_old;
variable double last_min;
variable double last_max;
variable double last_maxa;
function _ "Updates the output.";
description """
Follows the input without exceeding the limits, and brakes early enough for *min* and *max*. The input
is caught up with at its own velocity, so a steady movement is followed without lag.
""";
see_also "limit1(9), limit2(9), simple_tp(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
/* Position tolerance, in units of the input: below any encoder. */
#define EPSILON 1e-9

/* Where the output can go in this cycle, and where it would come to rest or
 * meet the input if it went to one end of that range. */
struct branch {
    double velocity;        /* at the end of the cycle */
    double next;            /* position at the end of the cycle */
    double stop;            /* position at rest when braking from now on */
    double meet;            /* position when the velocity of the input is reached */
    double input;           /* where the input will be by then */
};

static struct branch branch_at(double velocity, double y, double x, double in_velocity,
                               double a, double dt) {
    struct branch b;
    double t_stop = fabs(velocity / a) + dt;
    double t_meet = fabs((in_velocity - velocity) / a) - dt;
    b.velocity = velocity;
    b.next = y + velocity * dt;
    b.stop = y + velocity / 2 * t_stop;
    b.meet = b.next + (in_velocity + velocity) / 2 * t_meet;
    b.input = x + in_velocity * t_meet;
    return b;
}

static double next_position(double x, double x_old, double y, double y_old,
                            double low_limit, double high_limit, double v, double a,
                            double steps, double dt) {
    double vi = (x - x_old) / dt, vo = (y - y_old) / dt;
    struct branch low = branch_at(fmax(vo - a * dt, -v), y, x, vi, a, dt);
    struct branch high = branch_at(fmin(vo + a * dt, v), y, x, vi, a, dt);
    double goal, goal_old, goal_low, goal_high;     /* now, before, after slowing to it */
    double dv, arrive_low, arrive_high, distance, t;

#define REACHED(p) (low.next <= (p) && (p) <= high.next)
    goal = goal_old = goal_low = goal_high = high_limit;
    dv = -vo;
    arrive_low = low.stop;
    arrive_high = high.stop;
    if(high.stop > high_limit + EPSILON && !REACHED(high_limit)) {
    } else if(low.stop < low_limit - EPSILON && !REACHED(low_limit)) {
        goal = goal_old = goal_low = goal_high = low_limit;
    } else if(x >= high_limit && high.input > high.meet) {
    } else if(x <= low_limit && low.input < low.meet) {
        goal = goal_old = goal_low = goal_high = low_limit;
    } else {
        goal = x;
        goal_old = x_old;
        goal_low = low.input;
        goal_high = high.input;
        dv = vo - vi;
        arrive_low = low.meet;
        arrive_high = high.meet;
    }

    distance = y - goal_old;
    t = fabs(dv) < EPSILON ? 0 : distance / (dv / 2);
    if(REACHED(goal) && fabs(t) <= dt) return goal;
    if(arrive_high < goal_high + EPSILON) return high.next;
    if(arrive_low > goal_low - EPSILON) return low.next;
    if(fabs(t) < dt * steps) {
        double sign = t < 0 ? -1 : 1;
        double whole = trunc((t - EPSILON * sign) / dt + sign) * dt;
        double wanted = vo + dv / whole * dt;
        return fmin(high.next, fmax(low.next, y + wanted * dt));
    }
    if(goal_high + EPSILON < arrive_high && goal_old > y) return low.next;
    if(goal_low - EPSILON > arrive_low && goal_old < y) return high.next;
    return (low.next + high.next) / 2;
}

/* The greatest velocity that can be braked, by a * dt in each cycle, within a
 * distance: n whole cycles of braking follow, and the rest is spread over all. */
static double brakable(double distance, double a, double dt) {
    double unit = a * dt * dt, n = floor((sqrt(1 + 8 * distance / unit) - 1) / 2);
    return distance / dt / (n + 1) + a * dt * n / 2;
}

/* Where to go instead of `next` so that braking keeps the position limits. Only
 * the last cycles before a limit ever need it. */
static double before_limits(double next, double y, double y_old, double low_limit, double high_limit,
                            double a, double dt) {
    double v = (next - y) / dt, slowest = (y - y_old) / dt;
    if(!(y >= low_limit - EPSILON && y <= high_limit + EPSILON) || !(a > 0)) return next;
    if(v > 0) {
        double most = brakable(fmax(high_limit - y, 0), a, dt);
        return v > most + EPSILON / dt ? y + fmax(most, slowest - a * dt) * dt : next;
    }
    if(v < 0) {
        double most = brakable(fmax(y - low_limit, 0), a, dt);
        return -v > most + EPSILON / dt ? y - fmax(most, -slowest - a * dt) * dt : next;
    }
    return next;
}

FUNCTION(_) {
    double x = enable ? in_ : 0, next;
    if(!isfinite(x)) x = in_old;        /* no input: stay where it was */
    if(load) {
        x = fmin(max_, fmax(min_, x));
        next = x;
    } else {
        next = next_position(x, in_old, out, out_old, min_, max_, maxv, maxa, smooth_steps, fperiod);
        /* While the limits themselves move there is nothing to keep. */
        if(min_ == last_min && max_ == last_max && maxa == last_maxa)
            next = before_limits(next, out, out_old, min_, max_, maxa, fperiod);
    }
    last_min = min_;
    last_max = max_;
    last_maxa = maxa;
    out_old = out;
    out = next;
    in_old = x;
}
