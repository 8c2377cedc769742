/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * axis.c - axis planners of teleop mode and external offsets.
 *
 * In:     jog targets, eoffset pins, axis limits, joint limits
 * Out:    positions of nine axes with offsets
 * Thread: servo
 * Method: position and offset of an axis are two planners whose stopping points
 *         together stay within the axis' limits; in teleop the point where all
 *         axes would stop must also lie within the joints' limits.
 */
#include <math.h>
#include <string.h>
#include "motion_priv.h"

#define TELEOP_EPSILON 1e-9 /* units: rounding of forward and inverse kinematics */

static int no_limits(const struct axis *a) { return a->min_pos_limit == 0.0 && a->max_pos_limit == 0.0; }

void axis_init(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        memset(a, 0, sizeof(*a));
        a->vel_limit = a->acc_limit = 1.0;
        a->locking_joint = -1;
        a->jog_acc_scale = 1.0;
    }
}

double axis_get_vel_limit(int axis)
{
    return axis >= 0 && axis < EMCMOT_MAX_AXIS ? motion_state_.axis[axis].vel_limit : 0.0;
}

double axis_get_acc_limit(int axis)
{
    return axis >= 0 && axis < EMCMOT_MAX_AXIS ? motion_state_.axis[axis].acc_limit : 0.0;
}

double axis_get_jerk_limit(int axis)
{
    return axis >= 0 && axis < EMCMOT_MAX_AXIS ? motion_state_.axis[axis].jerk_limit : 0.0;
}

void axes_sync_to(struct motion *m, const EmcPose *pose)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_adopt(&m->axis[n].teleop_tp, emcPoseGetAxis(pose, n), 0.0, 0.0);
        m->axis[n].kb_ajog_active = m->axis[n].wheel_ajog_active = 0;
    }
}

void axes_abort(struct motion *m, int immediate)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        a->teleop_tp.enable = 0;
        if (immediate) {
            simple_tp_adopt(&a->teleop_tp, a->teleop_tp.curr_pos, 0.0, 0.0);
            a->kb_ajog_active = a->wheel_ajog_active = 0;
        }
    }
}

int axes_jogging(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].kb_ajog_active || m->axis[n].wheel_ajog_active)
            return 1;
    return 0;
}

int axes_moving(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].teleop_tp.active || m->axis[n].teleop_tp.curr_vel != 0.0)
            return 1;
    return 0;
}

int eoffsets_moving(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].ext_offset_tp.curr_vel != 0.0)
            return 1;
    return 0;
}

/* ---- external offsets ---- */

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
        double e = m->axis[n].ext_offset_tp.curr_pos;
        *emcPoseAxis(offsets, n) = e;
        any |= fabs(e) > eoffset_epsilon(m, &m->axis[n]);
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

static void eoffset_limits(struct axis *a)
{
    double whole = a->acc_limit + a->ext_offset_acc_limit;
    a->ext_offset_tp.max_vel = a->ext_offset_vel_limit;
    a->ext_offset_tp.max_acc = a->ext_offset_acc_limit;
    a->ext_offset_tp.max_jerk = whole > 0.0 ? a->jerk_limit * a->ext_offset_acc_limit / whole : 0.0;
}

/* One step towards a target within [lo, hi]; the planner's own target stays. */
static void bounded_step(simple_tp_t *tp, double lo, double hi, double T)
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

struct reach {
    double lo, hi; /* where the planner may still get to when it stops now */
};

static struct reach reach_of(const simple_tp_t *tp, double T)
{
    double d = simple_tp_stop_distance(tp, T);
    struct reach r = {tp->curr_pos + fmin(0.0, d), tp->curr_pos + fmax(0.0, d)};
    return r;
}

/* ---- coordinated mode ---- */

void axis_coord_step(struct motion *m, EmcPose *pose)
{
    double T = m->traj_period;
    m->eoffset_limited = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        simple_tp_t *e = &a->ext_offset_tp;
        double *at = emcPoseAxis(pose, n), before = e->curr_pos;
        if (a->ext_offset_vel_limit <= 0.0 || a->ext_offset_acc_limit <= 0.0)
            continue;
        eoffset_limits(a);
        if (no_limits(a))
            bounded_step(e, -INFINITY, INFINITY, T);
        else
            bounded_step(e, fmin(0.0, a->min_pos_limit - *at), fmax(0.0, a->max_pos_limit - *at), T);
        double sum = *at + e->curr_pos;
        if (!no_limits(a) && e->curr_pos != 0.0) {
            if ((sum >= a->max_pos_limit && e->curr_pos > 0.0) || (sum <= a->min_pos_limit && e->curr_pos < 0.0)) {
                double bound = e->curr_pos > 0.0 ? a->max_pos_limit : a->min_pos_limit;
                m->eoffset_limited = 1;
                /* the offset gives way; a program that is out of the limits itself is not held */
                if (e->curr_pos > 0.0)
                    e->curr_pos = fmax(0.0, fmin(e->curr_pos, bound - *at));
                else
                    e->curr_pos = fmin(0.0, fmax(e->curr_pos, bound - *at));
                e->curr_vel = (e->curr_pos - before) / T;
                e->curr_vel = fmax(-e->max_vel, fmin(e->max_vel, e->curr_vel));
                e->curr_acc = 0.0;
            }
        }
        *at += e->curr_pos;
    }
    hal_set_bool(m->pins->eoffset_limited, m->eoffset_limited);
}

/* ---- teleop mode ---- */

static void teleop_limits(const struct motion *m, struct axis *a)
{
    (void)m;
    if (!(a->teleop_tp.max_vel <= a->vel_limit))
        a->teleop_tp.max_vel = a->vel_limit;
    a->teleop_tp.max_acc = a->acc_limit * a->jog_acc_scale;
    a->teleop_tp.max_jerk = a->jerk_limit;
}

/* One step of axis n; the sum of position and offset can always stop within the limits. */
static void teleop_axis_step(struct motion *m, int n)
{
    struct axis *a = &m->axis[n];
    simple_tp_t *p = &a->teleop_tp, *e = &a->ext_offset_tp;
    double T = m->traj_period, lo = a->min_pos_limit, hi = a->max_pos_limit;
    int offsets = a->ext_offset_vel_limit > 0.0 && a->ext_offset_acc_limit > 0.0;
    teleop_limits(m, a);
    if (offsets)
        eoffset_limits(a);
    if (no_limits(a)) {
        bounded_step(p, -INFINITY, INFINITY, T);
        if (offsets)
            bounded_step(e, -INFINITY, INFINITY, T);
        return;
    }
    struct reach pr = reach_of(p, T), er = reach_of(e, T);
    /* never further out than where it is already bound to stop */
    bounded_step(p, fmin(lo - er.lo, pr.lo), fmax(hi - er.hi, pr.hi), T);
    pr = reach_of(p, T);
    if (offsets)
        bounded_step(e, fmin(fmin(lo - pr.lo, er.lo), 0.0), fmax(fmax(hi - pr.hi, er.hi), 0.0), T);
    double sum = p->curr_pos + e->curr_pos;
    if (e->curr_pos != 0.0 && (sum >= hi - TELEOP_EPSILON || sum <= lo + TELEOP_EPSILON))
        m->eoffset_limited = 1;
}

/* How far (sum over joints) a set of joint positions lies outside the limits of homed joints. */
static double outside(const struct motion *m, const double *q)
{
    double sum = 0.0;
    for (int j = 0; j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (!is_active(jt) || !get_homed(j))
            continue;
        if (!isfinite(q[j]))
            return INFINITY;
        sum += fmax(0.0, q[j] - jt->max_pos_limit) + fmax(0.0, jt->min_pos_limit - q[j]);
    }
    return sum;
}

/* 1 when the axes, stopped from now on, come to rest at a place the joints can be at. */
static int stop_is_reachable(struct motion *m)
{
    double q[EMCMOT_MAX_JOINTS], now[EMCMOT_MAX_JOINTS];
    EmcPose stop;
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct axis *a = &m->axis[n];
        *emcPoseAxis(&stop, n) = a->teleop_tp.curr_pos + simple_tp_stop_distance(&a->teleop_tp, m->traj_period) +
                                 a->ext_offset_tp.curr_pos;
    }
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = now[j] = m->joint[j].coarse_pos;
    if (kinematicsInverse(&stop, q, &m->iflags, &fflags) != 0)
        return 0;
    return outside(m, q) <= outside(m, now) + TELEOP_EPSILON;
}

void axis_teleop_step(struct motion *m, EmcPose *pose)
{
    simple_tp_t position[EMCMOT_MAX_AXIS], offset[EMCMOT_MAX_AXIS];
    int jogging = 0;
    m->eoffset_limited = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        position[n] = m->axis[n].teleop_tp;
        offset[n] = m->axis[n].ext_offset_tp;
        teleop_axis_step(m, n);
        jogging |= m->axis[n].teleop_tp.enable && m->axis[n].teleop_tp.active;
    }
    if (jogging && !stop_is_reachable(m)) {
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
            m->axis[n].teleop_tp = position[n];
            m->axis[n].ext_offset_tp = offset[n];
            m->axis[n].teleop_tp.enable = 0;
            teleop_axis_step(m, n);
        }
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        if (!a->teleop_tp.active) {
            a->kb_ajog_active = a->wheel_ajog_active = 0;
            a->jog_acc_scale = 1.0;
        }
        *emcPoseAxis(pose, n) = a->teleop_tp.curr_pos + a->ext_offset_tp.curr_pos;
    }
    hal_set_bool(m->pins->eoffset_limited, m->eoffset_limited);
}
