/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * simple_tp.c - one-dimensional planner towards a target that may change in any cycle.
 *
 * In:     target, limits, enable                                  simple_tp.h
 * Out:    position, speed, acceleration of the next cycle
 * Thread: servo; the jerk-limited step bisects at most BISECT times
 * Method: trapezoidal: the speed from which the target can still be reached,
 *         v = -aT + sqrt(2 a e + (aT)^2). Jerk-limited: in each cycle the largest
 *         acceleration after which the target and the speed limit can still be
 *         respected. Both conditions are monotonic in it, so bisection finds it.
 */
#include <math.h>
#include "simple_tp.h"

#define BISECT 32
/* Stops are planned with this part of the jerk limit: what is left corrects the
 * difference between the continuous stop and whole cycles (at most 25 %). */
#define STOP_JERK 0.8
/* The same for acceleration, so that a stop at the limit can be corrected. */
#define STOP_ACC 0.98

void simple_tp_adopt(simple_tp_t *tp, double pos, double vel, double acc)
{
    tp->enable = 0;
    tp->curr_pos = tp->pos_cmd = pos;
    tp->curr_vel = vel;
    tp->curr_acc = acc;
    tp->curr_jerk = 0.0;
    tp->active = vel != 0.0;
}

static void trapezoidal_step(simple_tp_t *tp, double T)
{
    double dv = tp->max_acc * T, tiny = dv * T * 0.001;
    double err = tp->pos_cmd - tp->curr_pos, req = 0.0, before = tp->curr_vel;

    tp->active = 0;
    if (!tp->enable) {
        tp->pos_cmd = tp->curr_pos;
    } else if (err > tiny) {
        req = -dv + sqrt(2.0 * tp->max_acc * err + dv * dv);
        tp->active = 1;
    } else if (err < -tiny) {
        req = dv - sqrt(-2.0 * tp->max_acc * err + dv * dv);
        tp->active = 1;
    }
    req = fmax(-tp->max_vel, fmin(tp->max_vel, req));
    tp->curr_vel = fmax(before - dv, fmin(before + dv, req));
    if (tp->curr_vel != 0.0)
        tp->active = 1;
    tp->curr_pos += tp->curr_vel * T;
    if (!tp->active && tp->enable)
        tp->curr_pos = tp->pos_cmd; /* within tiny: an acceleration of 0.1 % of the limit */
    tp->curr_acc = (tp->curr_vel - before) / T;
    tp->curr_jerk = 0.0;
}

/* A stop from (v, a) with jerk j and acceleration limit amax: a falls to -peak, stays there, returns to 0. */
struct stop {
    double sign;       /* v and a are those of the mirrored problem */
    double v, a, j, peak;
    double t1, t2, t3; /* s: of the three phases */
};

static struct stop stop_of(double v, double a, double j, double amax)
{
    struct stop p = {v + a * fabs(a) / (2.0 * j) >= 0.0 ? 1.0 : -1.0, v, a, j, 0.0, 0.0, 0.0, 0.0};
    p.v *= p.sign;
    p.a *= p.sign;
    p.peak = sqrt(fmax(0.0, j * p.v + 0.5 * p.a * p.a));
    if (p.peak > amax) {
        double lim = fmax(amax, -p.a); /* the acceleration may have been higher before */
        p.peak = lim;
        p.t2 = fmax(0.0, (p.v + 0.5 * p.a * p.a / j - lim * lim / j) / lim);
    }
    p.t1 = fmax(0.0, (p.a + p.peak) / j);
    p.t3 = p.peak / j;
    return p;
}

/* Displacement after t seconds of it; at any time beyond its end: to rest. */
static double stop_way(const struct stop *p, double t)
{
    double t1 = fmin(t, p->t1), t2 = fmax(0.0, fmin(t - p->t1, p->t2)), t3 = fmax(0.0, fmin(t - p->t1 - p->t2, p->t3));
    double d = t1 * (p->v + t1 * (0.5 * p->a - p->j * t1 / 6.0));
    double v1 = p->v + t1 * (p->a - 0.5 * p->j * t1), v2 = v1 - p->peak * t2;
    d += t2 * (v1 - 0.5 * p->peak * t2);
    d += t3 * (v2 + t3 * (-0.5 * p->peak + p->j * t3 / 6.0));
    return p->sign * d;
}

static double stop_displacement(double v, double a, double j, double amax)
{
    struct stop p = stop_of(v, a, j, amax);
    return stop_way(&p, INFINITY);
}

/* Farthest point of that stop: beyond the final one when the brake holds longer than needed. */
static double stop_reach(double v, double a, double j, double amax)
{
    if (v > 0.0 && a < 0.0 && a * a > 2.0 * j * v) {
        double t = (-a - sqrt(a * a - 2.0 * j * v)) / j; /* v = 0 with jerk j */
        return t * (v + t * (0.5 * a + j * t / 6.0));
    }
    return stop_displacement(v, a, j, amax);
}

/* State of the mirrored problem: the target lies in the positive direction at e. */
struct approach {
    double e, v, a;      /* distance to the target, speed, acceleration now */
    double vmax, amax, j, T;
};

/* 1 when, having acceleration a1 at the end of this cycle, both limits can still be kept. */
static int allowed(const struct approach *p, double a1)
{
    double v1 = p->v + 0.5 * (p->a + a1) * p->T;
    if (v1 + a1 * fabs(a1) / (2.0 * p->j) > p->vmax)
        return 0;
    if (p->v + p->T * (p->a / 3.0 + a1 / 6.0) >
        fmax(p->vmax, p->v)) /* the cycle's mean; a lowered limit takes its time */
        return 0;
    double e1 = p->e - p->T * (p->v + p->T * (p->a / 3.0 + a1 / 6.0));
    return stop_reach(v1, a1, p->j, STOP_ACC * p->amax) <= e1;
}

static double best_acceleration(const struct approach *p, double da)
{
    double hi = fmax(p->a - da, fmin(p->a + da, p->amax));
    double lo = fmin(p->a + da, fmax(p->a - da, -p->amax));
    if (allowed(p, hi))
        return hi;
    if (!allowed(p, lo))
        return lo;
    for (int i = 0; i < BISECT; i++) {
        double mid = 0.5 * (lo + hi);
        if (allowed(p, mid))
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

/* Jerk of the first of three cycles that bring (e, v, a) to exactly zero. Returns 0 when a limit forbids it. */
static int last_cycles(const struct approach *p, double jmax, double *jerk)
{
    double T = p->T, unit = jmax * T, u[3], e = p->e, v = p->v, a = p->a;
    double vn = v / (unit * T), an = a / unit, en = p->e / (unit * T * T);
    double k1 = -vn - 2.5 * an;                                /* 2 u1 + u2 */
    double k2 = (6.0 * (en - 3.0 * vn - 4.5 * an) + an) / 6.0; /* 3 u1 + u2 */
    u[0] = k2 - k1;
    u[1] = k1 - 2.0 * u[0];
    u[2] = -an - u[0] - u[1];
    for (int i = 0; i < 3; i++) {
        double a1 = a + u[i] * unit;
        if (fabs(u[i]) > 1.0 || fabs(a1) > p->amax)
            return 0;
        e -= T * (v + T * (a / 3.0 + a1 / 6.0));
        v += 0.5 * (a + a1) * T;
        a = a1;
        if (fabs(v) > p->vmax)
            return 0;
    }
    *jerk = u[0] * jmax;
    return 1;
}

static struct stop jerk_limited_stop(const simple_tp_t *tp)
{
    return stop_of(tp->curr_vel, tp->curr_acc, STOP_JERK * tp->max_jerk, STOP_ACC * tp->max_acc);
}

/* A stop of a motion whose brake would turn it back (a jog reversed just before): the brake is let
 * off as planned. To go
 * for the place of the stop would brake harder still, as the motion passes it before it turns. */
static int turns_back(const simple_tp_t *tp)
{
    return !tp->enable && jerk_limited_stop(tp).sign * tp->curr_vel < 0.0;
}

/* A motion that is to stop goes to where it can, as exactly as to any target: one place for all of the stop,
 * the target it had when that lies there within the rounding to whole cycles. */
static void aim_at_stop(simple_tp_t *tp, double T)
{
    double d = simple_tp_stop_distance(tp, T), left = tp->pos_cmd - tp->curr_pos;
    double rounding = 25.0 * tp->max_jerk * T * T * T + 0.01 * fabs(d);
    if (fabs(left - d) <= rounding && left * tp->curr_vel >= 0.0)
        return;
    tp->pos_cmd = tp->curr_pos + d;
}

static void jerk_limited_step(simple_tp_t *tp, double T)
{
    double da = tp->max_jerk * T, j = STOP_JERK * tp->max_jerk;
    double tiny_v = 0.001 * da * T, tiny_p = tiny_v * T;
    double v = tp->curr_vel, a = tp->curr_acc, dir, err, a1, end_v = v + 0.5 * a * T;

    if (!tp->enable)
        aim_at_stop(tp, T);
    err = tp->pos_cmd - tp->curr_pos;
    if (fabs(end_v) <= tiny_v && fabs(a) <= da && fabs(err - T * (v + T * a / 3.0)) <= tiny_p) {
        /* at rest after this cycle, within 0.1 % of one cycle's jerk */
        tp->curr_pos = tp->pos_cmd;
        tp->curr_jerk = -a / T;
        tp->curr_vel = tp->curr_acc = 0.0;
        tp->active = 0;
        return;
    }
    dir = err >= 0.0 ? 1.0 : -1.0;
    struct approach p = {dir * err, dir * v, dir * a, tp->max_vel, tp->max_acc, j, T};
    if (last_cycles(&p, tp->max_jerk, &a1))
        a1 = a + dir * a1 * T;
    else if (turns_back(tp))
        a1 = a - copysign(j * T, a);
    else
        a1 = dir * best_acceleration(&p, da);
    tp->curr_pos += T * (v + T * (a / 3.0 + a1 / 6.0));
    tp->curr_vel = v + 0.5 * (a + a1) * T;
    tp->curr_jerk = (a1 - a) / T;
    tp->curr_acc = a1;
    tp->active = 1;
}

void simple_tp_update(simple_tp_t *tp, double period)
{
    if (tp->max_jerk > SIMPLE_TP_MIN_JERK) {
        jerk_limited_step(tp, period);
        return;
    }
    trapezoidal_step(tp, period);
}

/* Cycles of a trapezoidal stop that still move. */
static double stop_cycles(const simple_tp_t *tp, double period)
{
    double dv = tp->max_acc * period;
    return dv > 0.0 ? fmax(0.0, ceil(fabs(tp->curr_vel) / dv) - 1.0) : 0.0;
}

double simple_tp_stop_distance(const simple_tp_t *tp, double period)
{
    return simple_tp_stop_way(tp, period, INFINITY);
}

double simple_tp_stop_way(const simple_tp_t *tp, double period, double t)
{
    if (tp->max_jerk > SIMPLE_TP_MIN_JERK) {
        struct stop p = jerk_limited_stop(tp);
        return stop_way(&p, t);
    }
    double v = fabs(tp->curr_vel), dv = tp->max_acc * period, n = fmin(t / period, stop_cycles(tp, period));
    double d = (n * v - 0.5 * dv * n * (n + 1.0)) * period;
    return tp->curr_vel < 0.0 ? -d : d;
}

void simple_tp_stop_times(const simple_tp_t *tp, double period, double times[SIMPLE_TP_PHASES])
{
    times[0] = times[1] = times[2] = stop_cycles(tp, period) * period;
    if (tp->max_jerk > SIMPLE_TP_MIN_JERK) {
        struct stop p = jerk_limited_stop(tp);
        times[0] = p.t1;
        times[1] = p.t1 + p.t2;
        times[2] = p.t1 + p.t2 + p.t3;
    }
}
