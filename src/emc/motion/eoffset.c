/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * eoffset.c - external offsets of the axes.
 *
 * In:     pins axis.L.eoffset-..., axis limits, the planner's position and braking distance
 * Out:    an offset per axis with a planner of its own; a hold of the path where it has to wait
 * Thread: servo
 * Method: invariant in coordinated mode, for each axis: the farthest point the path gets to
 *         when it is held from now on, plus the farthest point the offset gets to when it
 *         stops now, lie within the limits. A cycle that would break it holds the path; the
 *         offset gives way before the end of a move that leaves no room for it. Nothing is
 *         ever clamped, so speed, acceleration and jerk stay within the limits.
 */
#include <math.h>
#include "motion_priv.h"

#define SUM_EPSILON 1e-12 /* units: rounding of sums */
#define START 1e-3          /* units: a path that waits at rest is looked at as far as this */

int axis_has_no_limits(const struct axis *a) { return a->min_pos_limit == 0.0 && a->max_pos_limit == 0.0; }

void axis_apply_eoffsets(const struct motion *m, EmcPose *pose, int direction)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        *emcPoseAxis(pose, n) += direction * m->axis[n].ext_offset_tp.curr_pos;
}

void axis_zero_eoffsets(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_adopt(&m->axis[n].ext_offset_tp, 0.0, 0.0, 0.0);
        m->axis[n].old_eoffset_counts = hal_get_si32(m->pins->axis[n].eoffset_counts);
        m->axis[n].eoffset_counts_known = 1;
        hal_set_real(m->pins->axis[n].eoffset_request, 0.0);
    }
}

/* A millicycle of the offset planner's acceleration: below it an offset counts as none. */
static double eoffset_epsilon(const struct motion *m, const struct axis *a)
{
    return a->ext_offset_acc_limit * m->traj_period * m->traj_period * 0.001;
}

int axis_eoffsets_applied(const struct motion *m, EmcPose *offsets)
{
    int any = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const simple_tp_t *e = &m->axis[n].ext_offset_tp;
        *emcPoseAxis(offsets, n) = e->curr_pos;
        any |= fabs(e->curr_pos) > eoffset_epsilon(m, &m->axis[n]) || (e->enable && e->pos_cmd != e->curr_pos);
    }
    return any;
}

void phase_eoffset(struct motion *m)
{
    int accept = get_allhomed() && is_enabled(m), any = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        struct axis_pins *p = &m->pins->axis[n];
        int counts = hal_get_si32(p->eoffset_counts);
        int delta = a->eoffset_counts_known ? (int)((unsigned)counts - (unsigned)a->old_eoffset_counts) : 0;
        a->old_eoffset_counts = counts;
        a->eoffset_counts_known = 1;
        any |= fabs(a->ext_offset_tp.curr_pos) > eoffset_epsilon(m, a);
        if (!hal_get_bool(p->eoffset_enable)) {
            a->ext_offset_tp.enable = 0;
            continue;
        }
        a->ext_offset_tp.enable = 1;
        if (hal_get_bool(p->eoffset_clear)) {
            a->ext_offset_tp.pos_cmd = 0.0;
            hal_set_real(p->eoffset_request, 0.0);
            continue;
        }
        if (delta != 0 && accept) {
            double step = delta * hal_get_real(p->eoffset_scale);
            if (isfinite(step))
                a->ext_offset_tp.pos_cmd += step;
            hal_set_real(p->eoffset_request, a->ext_offset_tp.pos_cmd);
        }
    }
    hal_set_bool(m->pins->eoffset_active, any);
}

int eoffsets_moving(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].ext_offset_tp.curr_vel != 0.0)
            return 1;
    return 0;
}

void eoffsets_hand_over(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_t *e = &m->axis[n].ext_offset_tp;
        double asked = e->pos_cmd;
        simple_tp_adopt(e, e->curr_pos, 0.0, 0.0);
        e->pos_cmd = asked;
    }
}

void eoffsets_asked(struct motion *m, double asked[EMCMOT_MAX_AXIS])
{
    m->status->offsets_leave = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_t *e = &m->axis[n].ext_offset_tp;
        asked[n] = e->enable ? e->pos_cmd : NAN;
        if (!e->enable || !(m->status->offsets_spare >> n & 1))
            continue;
        e->pos_cmd = 0.0;
        m->status->offsets_leave |= e->curr_pos != 0.0 || e->curr_vel != 0.0;
    }
}

void eoffsets_hold(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        m->axis[n].ext_offset_tp.enable = 0;
}

void eoffsets_release(struct motion *m, const double asked[EMCMOT_MAX_AXIS])
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (!isnan(asked[n])) {
            m->axis[n].ext_offset_tp.pos_cmd = asked[n];
            m->axis[n].ext_offset_tp.enable = 1;
        }
}

int eoffset_prepare(struct axis *a)
{
    double whole = a->acc_limit + a->ext_offset_acc_limit;
    if (a->ext_offset_vel_limit <= 0.0 || a->ext_offset_acc_limit <= 0.0)
        return 0;
    a->ext_offset_tp.max_vel = a->ext_offset_vel_limit;
    a->ext_offset_tp.max_acc = a->ext_offset_acc_limit;
    a->ext_offset_tp.max_jerk = a->jerk_limit * a->ext_offset_acc_limit / whole;
    return 1;
}

void axis_step_within(simple_tp_t *tp, double lo, double hi, double T)
{
    double asked = tp->pos_cmd;
    int enabled = tp->enable;
    if (!enabled && tp->curr_vel == 0.0 && tp->curr_acc == 0.0) {
        tp->pos_cmd = tp->curr_pos;
        tp->active = 0;
        return;
    }
    if (enabled)
        tp->pos_cmd = fmax(lo, fmin(hi, asked));
    simple_tp_update(tp, T);
    if (enabled)
        tp->pos_cmd = asked;
}

struct axis_reach axis_reach_of(const simple_tp_t *tp, double T)
{
    double d = simple_tp_stop_distance(tp, T);
    struct axis_reach r = {tp->curr_pos + fmin(0.0, d), tp->curr_pos + fmax(0.0, d)};
    return r;
}

/* ---- coordinated mode ---- */

/* Where axis n of the path may get to when the path is held from now on, or, with one more
 * cycle of acceleration, from the next cycle on. */
static struct axis_reach path_reach(struct motion *m, int n, double at, int one_more)
{
    const emcmot_status_t *s = m->status;
    double T = m->traj_period, v = s->current_vel, step = fabs(at - emcPoseGetAxis(&m->path_was, n)) / T;
    double stop = s->decel_dist, goal = at + emcPoseGetAxis(&s->dtg, n), beyond;
    struct axis_reach r = {at, at};
    if (tpIsDone(&m->tp))
        return r;
    if (one_more)
        stop += 2.0 * (v + m->axis[n].acc_limit * T) * T;
    beyond = fmax(0.0, stop - s->distance_to_go);
    if (v > 0.0 && step > v) { /* an axis that goes faster than the path's measure */
        stop *= step / v;
        beyond *= step / v;
    }
    r.lo = at - stop;
    r.hi = at + stop;
    if (s->motionType != EMC_MOTION_TYPE_ARC && !s->reverse_run) { /* between here and the end of the line */
        r.lo = fmax(r.lo, fmin(at, goal) - beyond);
        r.hi = fmin(r.hi, fmax(at, goal) + beyond);
    }
    return r;
}

/* 1 when the path's way to rest takes joints out of their limits, with the offsets that there are. */
static int joints_leave(struct motion *m, const EmcPose *pose)
{
    const emcmot_status_t *s = m->status;
    double T = m->traj_period, v = s->current_vel, left = s->distance_to_go, stop = s->decel_dist + 2.0 * v * T;
    EmcPose at = *pose;
    if (tpIsDone(&m->tp))
        return 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        if (v > 0.0)
            *emcPoseAxis(&at, n) += (emcPoseGetAxis(pose, n) - emcPoseGetAxis(&m->path_was, n)) / (v * T) * stop;
        else if (left > 0.0) /* where it would go from rest */
            *emcPoseAxis(&at, n) += emcPoseGetAxis(&s->dtg, n) / left * fmin(left, START);
    }
    return offset_share_leaves(m, &at);
}

int eoffset_path_waits(struct motion *m)
{
    EmcPose pose;
    int any = 0;
    tpGetPos(&m->tp, &pose);
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct axis *a = &m->axis[n];
        const simple_tp_t *e = &a->ext_offset_tp;
        if (e->curr_pos == 0.0 && e->curr_vel == 0.0)
            continue;
        any = 1;
        if (axis_has_no_limits(a))
            continue;
        struct axis_reach p = path_reach(m, n, emcPoseGetAxis(&pose, n), 1), o = axis_reach_of(e, m->traj_period);
        if ((o.hi > 0.0 && p.hi + o.hi > a->max_pos_limit + SUM_EPSILON) ||
            (o.lo < 0.0 && p.lo + o.lo < a->min_pos_limit - SUM_EPSILON))
            return 1;
    }
    return any && joints_leave(m, &pose);
}

/* The room the offset has beside the path: what the present move leaves at its end counts as
 * soon as giving way takes as long as the way there. */
static struct axis_reach offset_room(struct motion *m, int n, double at)
{
    const struct axis *a = &m->axis[n];
    const simple_tp_t *e = &a->ext_offset_tp;
    struct axis_reach p = path_reach(m, n, at, 1);
    double goal = at + emcPoseGetAxis(&m->status->dtg, n);
    if (m->status->motionType != EMC_MOTION_TYPE_ARC) {
        double hi = a->max_pos_limit - goal, lo = a->min_pos_limit - goal;
        double away = fmax(e->curr_pos - fmax(0.0, hi), fmin(0.0, lo) - e->curr_pos);
        double lead = away > 0.0 ? a->vel_limit * (away / e->max_vel + e->max_vel / e->max_acc) : 0.0;
        if (fabs(goal - at) <= lead) {
            p.hi = fmax(p.hi, goal);
            p.lo = fmin(p.lo, goal);
        }
    }
    double lo = a->min_pos_limit - p.lo, hi = a->max_pos_limit - p.hi;
    /* A path that is outside by itself (joints were moved under an offset) needs the offset it has. */
    struct axis_reach room = {fmin(lo, fmax(0.0, e->curr_pos)), fmax(hi, fmin(0.0, e->curr_pos))};
    return room;
}

/* One cycle of all offset planners beside the path; 1: a target is out of the room there is. */
static int step_offsets(struct motion *m, const EmcPose *path)
{
    double T = m->traj_period;
    int limited = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        simple_tp_t *e = &a->ext_offset_tp;
        if (!eoffset_prepare(a))
            continue;
        e->max_vel *= a->offset_part.vel;
        e->max_acc *= a->offset_part.acc;
        e->max_jerk *= a->offset_part.jerk;
        if (axis_has_no_limits(a)) {
            axis_step_within(e, -INFINITY, INFINITY, T);
        } else {
            struct axis_reach room = offset_room(m, n, emcPoseGetAxis(path, n));
            limited |= e->enable && (e->pos_cmd > room.hi || e->pos_cmd < room.lo);
            axis_step_within(e, room.lo, room.hi, T);
        }
    }
    return limited;
}

void eoffset_coord_step(struct motion *m, EmcPose *pose)
{
    simple_tp_t was[EMCMOT_MAX_AXIS];
    double asked[EMCMOT_MAX_AXIS];
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        was[n] = m->axis[n].ext_offset_tp;
    eoffsets_asked(m, asked);
    if (m->offsets_wait)
        eoffsets_hold(m);
    offset_share_scale(m, pose);
    m->eoffset_limited = m->path_waits | step_offsets(m, pose);
    if (eoffsets_moving(m) && offset_share_leaves(m, pose)) { /* a joint would leave its limits: stop instead */
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            m->axis[n].ext_offset_tp = was[n];
        eoffsets_hold(m);
        step_offsets(m, pose);
        m->eoffset_limited = 1;
    }
    eoffsets_release(m, asked);
    m->path_was = *pose;
    axis_apply_eoffsets(m, pose, 1);
    hal_set_bool(m->pins->eoffset_limited, m->eoffset_limited);
}
