/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * axis.c - axis planners of teleop mode.
 *
 * In:     jog targets, axis limits, joint limits
 * Out:    positions of nine axes with offsets
 * Thread: servo
 * Method: position and offset of an axis are two planners whose stopping points
 *         together stay within the axis' limits; the point where all axes would
 *         stop must also lie within the joints' limits.
 */
#include <math.h>
#include <string.h>
#include "motion_priv.h"

#define TELEOP_EPSILON 1e-9 /* units: rounding of forward and inverse kinematics */

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

/* ---- teleop mode ---- */

static void teleop_limits(struct axis *a, int offsets)
{
    double whole = a->acc_limit + a->ext_offset_acc_limit;
    if (!(a->teleop_tp.max_vel <= a->vel_limit))
        a->teleop_tp.max_vel = a->vel_limit;
    a->teleop_tp.max_acc = a->acc_limit * a->jog_acc_scale;
    a->teleop_tp.max_jerk = offsets ? a->jerk_limit * a->acc_limit / whole : a->jerk_limit;
}

/* One step of axis n; the sum of position and offset can always stop within the limits. */
static void teleop_axis_step(struct motion *m, int n)
{
    struct axis *a = &m->axis[n];
    simple_tp_t *p = &a->teleop_tp, *e = &a->ext_offset_tp;
    double T = m->traj_period, lo = a->min_pos_limit, hi = a->max_pos_limit;
    int offsets = eoffset_prepare(a);
    teleop_limits(a, offsets);
    if (axis_has_no_limits(a)) {
        axis_step_within(p, -INFINITY, INFINITY, T);
        if (offsets)
            axis_step_within(e, -INFINITY, INFINITY, T);
        return;
    }
    struct axis_reach pr = axis_reach_of(p, T), er = axis_reach_of(e, T);
    /* never further out than where it is already bound to stop */
    axis_step_within(p, fmin(lo - er.lo, pr.lo), fmax(hi - er.hi, pr.hi), T);
    pr = axis_reach_of(p, T);
    if (offsets)
        axis_step_within(e, fmin(fmin(lo - pr.lo, er.lo), 0.0), fmax(fmax(hi - pr.hi, er.hi), 0.0), T);
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
