/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * position.c - position commands of the joints in each mode.
 *
 * In:     joint planners, axis planners, trajectory planner, external offsets
 * Out:    coarse_pos, pos_cmd, vel_cmd, acc_cmd, jerk_cmd of each joint; carte_pos_cmd
 * Thread: servo
 */
#include <math.h>
#include "motion_priv.h"

#define ALIGN_EPSILON 1e-9    /* units: below any encoder; larger steps are moved, not jumped */

/* ---- joint planners ---- */

static void set_joint_limits(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    struct joint_limits l = joint_motion_limits(jt);
    if (m->status->acc > 0.0 && l.acc > m->status->acc)
        l.acc = m->status->acc;
    if (l.jerk > m->status->jerk)
        l.jerk = m->status->jerk;
    jt->free_tp.max_acc = l.acc * m->joint_acc_scale[j];
    jt->free_tp.max_jerk = l.jerk;
    if (!(jt->free_tp.max_vel <= l.vel))
        jt->free_tp.max_vel = l.vel;
}

/* One cycle of joint j's planner; 1 while it moves. */
static int joint_step(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    set_joint_limits(m, j);
    simple_tp_update(&jt->free_tp, m->servo_period);
    jt->pos_cmd = jt->coarse_pos = jt->free_tp.curr_pos;
    jt->vel_cmd = jt->free_tp.curr_vel;
    jt->acc_cmd = 0.0;
    jt->jerk_cmd = jt->free_tp.curr_jerk;
    if (jt->free_tp.active) {
        set_joint_flag(jt, EMCMOT_JOINT_INPOS_BIT, 0);
        return 1;
    }
    set_joint_flag(jt, EMCMOT_JOINT_INPOS_BIT, 1);
    jt->kb_jjog_active = jt->wheel_jjog_active = 0;
    m->joint_acc_scale[j] = 1.0;
    return 0;
}

static void pose_from_joints(struct motion *m)
{
    double q[EMCMOT_MAX_JOINTS];
    emcmot_status_t *s = m->status;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].coarse_pos;
    if (m->kin_type == KINEMATICS_IDENTITY) {
        kinematics_forward(m, q, &s->carte_pos_cmd);
        s->carte_pos_cmd_ok = get_allhomed();
    } else if (m->kin_type == KINEMATICS_BOTH && get_allhomed()) {
        if (!s->carte_pos_cmd_ok)
            s->carte_pos_cmd = s->world_home;
        s->carte_pos_cmd_ok = kinematics_forward(m, q, &s->carte_pos_cmd) >= 0;
    } else {
        s->carte_pos_cmd_ok = 0;
    }
}

static void free_position(struct motion *m)
{
    int moving = 0;
    for (int j = 0; j < all_joints(m); j++) {
        if (!is_active(&m->joint[j]) || (is_extra(m, j) && get_homed(j)))
            continue;
        moving |= joint_step(m, j);
    }
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, !moving);
    if (m->status->overrideLimitMask && moving)
        m->internal->overriding = 1;
    if (m->internal->overriding && !moving) {
        m->status->overrideLimitMask = 0;
        m->internal->overriding = 0;
    }
    pose_from_joints(m);
}

/* ---- Cartesian modes ---- */

void position_enter_cartesian(struct motion *m)
{
    double q[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        q[j] = m->joint[j].pos_cmd;
        cubic_drain(&m->cubic[j]);
        cubic_add_point(&m->cubic[j], q[j]);
        m->cubic[j].need_next = 1;
    }
    m->aligning = 0;
    if (kinematics_inverse(m, &m->status->carte_pos_cmd, q) != 0)
        return; /* the first cycle in the new mode reports it */
    for (int j = 0; j < kin_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        if (!isfinite(q[j]) || fabs(q[j] - jt->pos_cmd) <= ALIGN_EPSILON)
            continue;
        m->aligning = 1;
    }
    for (int j = 0; m->aligning && j < kin_joints(m); j++) {
        m->align_to[j] = isfinite(q[j]) ? q[j] : m->joint[j].pos_cmd;
        simple_tp_adopt(&m->joint[j].free_tp, m->joint[j].pos_cmd, 0.0, 0.0);
    }
}

int position_at_rest(const struct motion *m)
{
    for (int j = 0; j < kin_joints(m); j++)
        if (!cubic_at_rest(&m->cubic[j]))
            return 0;
    return 1;
}

void position_enter_free(struct motion *m)
{
    m->aligning = 0;
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        /* speed and acceleration as differences: what the next position is compared with; a
         * trapezoidal planner counts the last cycle's mean speed, a jerk-limited one the present speed */
        double T = m->servo_period, d1 = jt->pos_cmd - m->pos_was[j][0], d2 = m->pos_was[j][0] - m->pos_was[j][1];
        double acc = (d1 - d2) / (T * T);
        set_joint_limits(m, j);
        simple_tp_adopt(&jt->free_tp, jt->pos_cmd,
                        d1 / T + (jt->free_tp.max_jerk > SIMPLE_TP_MIN_JERK ? 0.5 * acc * T : 0.0), acc);
        jt->free_tp.max_vel = joint_motion_limits(jt).vel;
        jt->kb_jjog_active = jt->wheel_jjog_active = 0;
    }
    eoffsets_hand_over(m);
}

static void align(struct motion *m)
{
    int moving = 0;
    for (int j = 0; j < kin_joints(m); j++) {
        simple_tp_t *tp = &m->joint[j].free_tp;
        tp->pos_cmd = m->align_to[j];
        tp->max_vel = joint_motion_limits(&m->joint[j]).vel;
        tp->enable = 1; /* whatever stopped it: only leaving the mode ends this */
        moving |= joint_step(m, j);
    }
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, 0);
    if (moving)
        return;
    m->aligning = 0;
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, tpIsDone(&m->tp) && tpQueueDepth(&m->tp) == 0);
    for (int j = 0; j < kin_joints(m); j++) {
        m->joint[j].free_tp.enable = 0;
        cubic_drain(&m->cubic[j]);
        cubic_add_point(&m->cubic[j], m->joint[j].pos_cmd);
        m->cubic[j].need_next = 1;
    }
}

/* Joint positions of a pose to the interpolators. Returns 0, or -1 after a failure, reported. */
static int feed_interpolators(struct motion *m, const EmcPose *pose)
{
    double q[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].coarse_pos;
    if (kinematics_inverse(m, pose, q) != 0) {
        report_error("kinematicsInverse failed");
        return -1;
    }
    for (int j = 0; j < kin_joints(m); j++)
        if (!isfinite(q[j])) {
            report_error("kinematicsInverse gave non-finite joint location on joint %d", j);
            return -1;
        }
    for (int j = 0; j < kin_joints(m); j++) {
        m->joint[j].coarse_pos = q[j];
        cubic_add_point(&m->cubic[j], q[j]);
    }
    return 0;
}

static void stop_on_kinematics(struct motion *m)
{
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
    m->internal->enabling = 0;
}

static void interpolate(struct motion *m)
{
    for (int j = 0; j < kin_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        jt->pos_cmd = cubic_interpolate(&m->cubic[j], &jt->vel_cmd, &jt->acc_cmd, &jt->jerk_cmd);
    }
}

static void coord_position(struct motion *m)
{
    axes_abort(m, 1);
    if (m->aligning) {
        align(m);
        return;
    }
    if (m->cubic[0].need_next) {
        EmcPose pose;
        m->path_waits = eoffset_path_waits(m);
        if (m->path_waits)
            m->status->net_feed_scale = 0.0;
        tpRunCycle(&m->tp, m->period_ns);
        tpGetPos(&m->tp, &pose);
        eoffset_coord_step(m, &pose);
        if (feed_interpolators(m, &pose) != 0) {
            stop_on_kinematics(m);
            return;
        }
        m->status->carte_pos_cmd = pose;
        m->status->carte_pos_cmd_ok = 1;
    }
    interpolate(m);
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, coord_in_position(m));
}

static void teleop_position(struct motion *m)
{
    if (m->aligning) {
        align(m);
        return;
    }
    if (m->cubic[0].need_next) {
        EmcPose pose = m->status->carte_pos_cmd;
        axis_teleop_step(m, &pose);
        if (feed_interpolators(m, &pose) != 0) {
            stop_on_kinematics(m);
            return;
        }
        m->status->carte_pos_cmd = pose;
        m->status->carte_pos_cmd_ok = 1;
    }
    interpolate(m);
    if (m->status->overrideLimitMask && axes_jogging(m))
        m->internal->overriding = 1;
    if (m->internal->overriding && !axes_moving(m)) {
        m->status->overrideLimitMask = 0;
        m->internal->overriding = 0;
    }
}

static void disabled_position(struct motion *m)
{
    m->status->carte_pos_cmd = m->status->carte_pos_fb;
    m->status->carte_pos_cmd_ok = m->status->carte_pos_fb_ok;
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        jt->pos_cmd = jt->coarse_pos = jt->pos_fb;
        jt->vel_cmd = jt->acc_cmd = jt->jerk_cmd = 0.0;
        jt->free_tp.curr_pos = jt->free_tp.pos_cmd = jt->pos_fb;
        jt->free_tp.curr_vel = jt->free_tp.curr_acc = 0.0;
    }
}

/* ---- soft limits ---- */

static void soft_limits(struct motion *m)
{
    int any = 0, first = 0;
    for (int j = 0; j < all_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        double T = m->servo_period, eps = LIMIT_EPSILON;
        if (!is_active(jt) || !get_homed(j) || (is_extra(m, j) && get_homed(j))) {
            m->joint_violated[j] = 0;
            continue;
        }
        eps += SIMPLE_TP_OVERSHOOT * fmax(jt->jerk_limit, 0.0) * T * T * T;
        int low = jt->pos_cmd < jt->min_pos_limit - eps, high = jt->pos_cmd > jt->max_pos_limit + eps;
        if ((low || high) && !m->joint_violated[j]) {
            if (low)
                report_error("Exceeded NEGATIVE soft limit (%.5f) on joint %d\n", jt->min_pos_limit, j);
            else
                report_error("Exceeded POSITIVE soft limit (%.5f) on joint %d\n", jt->max_pos_limit, j);
            first = 1;
        }
        m->joint_violated[j] = low || high;
        any |= low || high;
    }
    if (first) {
        if (m->kin_type == KINEMATICS_IDENTITY)
            report_error("Joint must be unhomed, jogged into limits, rehomed");
        else
            report_error("Hint: switch to joint mode to jog off soft limit");
        set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
    }
    if (first && is_teleop(m) && is_enabled(m))
        axes_abort(m, 0); /* later jogs lead back inside: the planners let no axis stop farther out */
    m->status->on_soft_limit = any;
}

void phase_position(struct motion *m)
{
    for (int j = 0; j < all_joints(m); j++) {
        m->pos_was[j][1] = m->pos_was[j][0];
        m->pos_was[j][0] = m->joint[j].pos_cmd;
    }
    switch (m->status->motion_state) {
    case EMCMOT_MOTION_FREE:
        free_position(m);
        break;
    case EMCMOT_MOTION_COORD:
        coord_position(m);
        break;
    case EMCMOT_MOTION_TELEOP:
        teleop_position(m);
        break;
    case EMCMOT_MOTION_DISABLED:
        disabled_position(m);
        break;
    }
    soft_limits(m);
}
