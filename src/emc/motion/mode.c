/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * mode.c - enabling, free, teleop and coordinated mode; faults; kinematics switch; homing.
 *
 * In:     requests of the command handler, joint flags, pins
 * Out:    motionFlag, motion_state, what planners start from
 * Thread: servo
 * Method: requests are kept until the machine is at rest; joints keep their
 *         commanded position and speed over every change of mode.
 */
#include <limits.h>
#include <math.h>
#include "motion_priv.h"

#define INTERPOLATOR_CYCLES 3 /* history of the cubic beyond the newest point */
#define BRANCH_UNITS 0.1      /* units, deg: joints are aligned without the tool leaving its pose by more */

int kinematics_forward(struct motion *m, const double *joint, EmcPose *pose)
{
    double q[EMCMOT_MAX_JOINTS];
    int n = kin_joints(m);
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = j < n ? joint[j] : 0.0;
    EmcPose p = *pose;
    int r = kinematicsForward(q, &p, &m->fflags, &m->iflags);
    if (r >= 0 && !emcPoseValid(&p))
        r = -1;
    if (r >= 0)
        *pose = p;
    return r;
}

int kinematics_inverse(struct motion *m, const EmcPose *pose, double *joint)
{
    return kinematicsInverse(pose, joint, &m->iflags, &m->fflags);
}

void abort_planner(struct motion *m) { tpAbort(&m->tp); }

void fail_motion(struct motion *m)
{
    abort_planner(m);
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
}

int coord_in_position(struct motion *m)
{
    if (!tpIsDone(&m->tp))
        m->settle = 0;
    else if (m->settle < INT_MAX)
        m->settle++;
    return m->settle > INTERPOLATOR_CYCLES * m->interpolation_rate;
}

/* ---- requests ---- */

static int unhomed_refusal(struct motion *m, const char *text)
{
    if (m->kin_type == KINEMATICS_IDENTITY || get_allhomed())
        return 0;
    report_error("%s", text);
    return 1;
}

void request_free(struct motion *m)
{
    axes_abort(m, 0);
    m->internal->coordinating = m->internal->teleoperating = 0;
}

/* Homing runs in free mode only: it would wait, and go on by itself when free mode comes back. */
static void cancel_homing(struct motion *m)
{
    for (int j = 0; j < all_joints(m); j++)
        if (!get_home_is_idle(j))
            do_cancel_homing(j);
}

void request_coord(struct motion *m)
{
    m->internal->coordinating = 1;
    m->internal->teleoperating = 0;
    if (unhomed_refusal(m, "all joints must be homed before going into coordinated mode"))
        m->internal->coordinating = 0;
    else
        cancel_homing(m);
}

void request_teleop(struct motion *m)
{
    if (unhomed_refusal(m, "all joints must be homed before going into teleop mode"))
        return;
    cancel_homing(m);
    for (int j = 0; j < all_joints(m); j++)
        m->joint[j].free_tp.enable = 0;
    m->internal->teleoperating = 1;
    m->internal->coordinating = 0;
}

/* ---- transitions ---- */

static void disable(struct motion *m)
{
    tpClear(&m->tp);
    m->aligning = 0;
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        simple_tp_adopt(&jt->free_tp, jt->pos_cmd, 0.0, 0.0);
        jt->kb_jjog_active = jt->wheel_jjog_active = 0;
        if (is_active(jt)) {
            set_joint_flag(jt, EMCMOT_JOINT_INPOS_BIT, 1);
            set_joint_flag(jt, EMCMOT_JOINT_ENABLE_BIT, 0);
        }
        do_cancel_homing(j); /* also of a joint whose turn has not come */
    }
    axes_abort(m, 1);
    set_motion_flag(m, EMCMOT_MOTION_ENABLE_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_INPOS_BIT, 1);
    m->status->probing = 0;
}

static void enable(struct motion *m)
{
    m->status->stop_causes = 0;
    if (m->eoffset_limited) {
        report_error("Note: Motion enabled after reaching a coordinate soft limit with active external offsets");
        m->eoffset_limited = 0;
        hal_set_bool(m->pins->eoffset_limited, 0);
    }
    axis_zero_eoffsets(m);
    tpSetPos(&m->tp, &m->status->carte_pos_cmd);
    for (int j = 0; j < all_joints(m); j++) {
        emcmot_joint_t *jt = &m->joint[j];
        simple_tp_adopt(&jt->free_tp, jt->pos_cmd, 0.0, 0.0);
        if (is_active(jt))
            set_joint_flag(jt, EMCMOT_JOINT_ENABLE_BIT, 1);
        do_cancel_homing(j); /* also of a joint whose turn has not come */
        set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 0);
    }
    if (is_teleop(m))
        axes_sync_to(m, &m->status->carte_pos_cmd);
    if (is_teleop(m) || is_coord(m))
        position_enter_cartesian(m);
    m->path_was = m->status->carte_pos_cmd;
    offset_share_find(m);
    set_motion_flag(m, EMCMOT_MOTION_ENABLE_BIT, 1);
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
}

static void enter_teleop(struct motion *m)
{
    EmcPose *pose = &m->status->carte_pos_cmd, base;
    int from_coord = is_coord(m);
    if (!from_coord)
        position_enter_cartesian(m);
    base = *pose;
    axis_apply_eoffsets(m, &base, -1);
    axes_sync_to(m, &base);
    tpSetPos(&m->tp, &base);
    set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, 1);
    set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
}

static void enter_coord(struct motion *m)
{
    EmcPose *pose = &m->status->carte_pos_cmd, base;
    if (!is_teleop(m))
        position_enter_cartesian(m);
    base = *pose;
    axis_apply_eoffsets(m, &base, -1);
    tpSetPos(&m->tp, &base);
    m->path_was = base;
    offset_share_find(m);
    m->status->overrideLimitMask = 0;
    m->settle = INT_MAX;
    set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, 1);
    set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
}

static void enter_free(struct motion *m)
{
    if (tpQueueDepth(&m->tp) != 0) /* queued while joints were still being aligned */
        tpClear(&m->tp);
    position_enter_free(m);
    set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, 0);
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
}

/* Offsets are limited in another way in the other mode: 1 while they have to stop first, where that
 * depends on the place. To free mode they need not: joint planners take over. */
static int offsets_stop_first(struct motion *m)
{
    m->offsets_wait = m->kin_type != KINEMATICS_IDENTITY && (m->internal->teleoperating || m->internal->coordinating);
    return m->offsets_wait && eoffsets_moving(m);
}

/* At rest as the mode in effect means it. */
static int may_change(struct motion *m)
{
    if (m->aligning) /* to free mode only: joint planners move already */
        return !m->internal->teleoperating && !m->internal->coordinating;
    if (offsets_stop_first(m))
        return 0;
    if (is_teleop(m)) {
        if (axes_moving(m)) {
            axes_abort(m, 0);
            return 0;
        }
        return position_at_rest(m) || eoffsets_moving(m);
    }
    return is_inpos(m) && tpQueueDepth(&m->tp) == 0;
}

/* The request for teleop or coordinated mode cannot be met, for a reason that was told. */
static int drop_request(struct motion *m)
{
    m->internal->teleoperating = m->internal->coordinating = 0;
    set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
    return 0;
}

/* Joints that inverse kinematics wants elsewhere for this pose are aligned, as those of a racked gantry; when the tool
 * would leave the pose meanwhile they stand on another branch, and going over is no business of a change of mode. */
static int on_branch(struct motion *m, const double *q)
{
    double to[EMCMOT_MAX_JOINTS], mid[EMCMOT_MAX_JOINTS];
    EmcPose pose = m->status->carte_pos_cmd, way = pose;
    int farthest = 0;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        to[j] = q[j];
    if (kinematics_inverse(m, &pose, to) != 0)
        return 1; /* the first cycle in the new mode reports it */
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        mid[j] = 0.5 * (q[j] + to[j]);
        if (fabs(to[j] - q[j]) > fabs(to[farthest] - q[farthest]))
            farthest = j;
    }
    int away = kinematics_forward(m, mid, &way) < 0;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
        away |= fabs(emcPoseGetAxis(&way, a) - emcPoseGetAxis(&pose, a)) > BRANCH_UNITS;
    if (!away)
        return 1;
    report_error("joint %d is at %g, kinematicsInverse wants it at %g for the same pose: another branch. Jog it there",
                 farthest, q[farthest], to[farthest]);
    return drop_request(m);
}

/* The pose of the joints, on the way out of free mode; 0 when there is none: reported, request dropped. */
static int pose_is_known(struct motion *m)
{
    double q[EMCMOT_MAX_JOINTS];
    if (is_teleop(m) || is_coord(m) || m->kin_type == KINEMATICS_INVERSE_ONLY)
        return 1;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].pos_cmd;
    if (kinematics_forward(m, q, &m->status->carte_pos_cmd) >= 0)
        return m->kin_type == KINEMATICS_IDENTITY || on_branch(m, q);
    report_error("kinematicsForward failed: jog the joints to positions that belong together");
    return drop_request(m);
}

static void change_mode(struct motion *m)
{
    const emcmot_internal_t *want = m->internal;
    int teleop = is_teleop(m), coord = is_coord(m);
    int to_teleop = want->teleoperating && !teleop;
    int to_coord = want->coordinating && !coord;
    int to_free = !want->teleoperating && !want->coordinating && (teleop || coord);
    m->offsets_wait = 0;
    if ((!to_teleop && !to_coord && !to_free) || !may_change(m))
        return;
    if (!to_free && !pose_is_known(m))
        return;
    if (to_teleop)
        enter_teleop(m);
    else if (to_coord)
        enter_coord(m);
    else
        enter_free(m);
}

void phase_mode(struct motion *m)
{
    if (!m->internal->enabling && is_enabled(m))
        disable(m);
    if (m->internal->enabling && !is_enabled(m))
        enable(m);
    if (is_enabled(m))
        change_mode(m);
    else if (m->internal->teleoperating != is_teleop(m) || m->internal->coordinating != is_coord(m)) {
        /* nothing moves: flags follow the requests */
        set_motion_flag(m, EMCMOT_MOTION_TELEOP_BIT, m->internal->teleoperating);
        set_motion_flag(m, EMCMOT_MOTION_COORD_BIT, m->internal->coordinating);
        set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 0);
    }
    if (!is_enabled(m))
        m->status->motion_state = EMCMOT_MOTION_DISABLED;
    else if (is_teleop(m))
        m->status->motion_state = EMCMOT_MOTION_TELEOP;
    else if (is_coord(m))
        m->status->motion_state = EMCMOT_MOTION_COORD;
    else
        m->status->motion_state = EMCMOT_MOTION_FREE;
}

/* ---- faults ---- */

static void stop_by(struct motion *m, enum emcmot_stop_cause cause)
{
    m->internal->enabling = 0;
    m->status->stop_causes |= cause;
}

/* The joint's fault stops the machine; 1: to be told, as the first one of the joint. */
static int joint_fault(struct motion *m, emcmot_joint_t *jt, enum emcmot_stop_cause cause, int *faults)
{
    set_joint_flag(jt, EMCMOT_JOINT_ERROR_BIT, 1);
    stop_by(m, cause);
    return (*faults)++ == 0;
}

static void joint_faults(struct motion *m, int j)
{
    emcmot_joint_t *jt = &m->joint[j];
    int faults = 0;
    int overridden = m->status->overrideLimitMask >> (2 * j);
    if (!is_active(jt) || !joint_flag(jt, EMCMOT_JOINT_ENABLE_BIT))
        return;
    int high = joint_flag(jt, EMCMOT_JOINT_MAX_HARD_LIMIT_BIT) && !(overridden & 2);
    int low = joint_flag(jt, EMCMOT_JOINT_MIN_HARD_LIMIT_BIT) && !(overridden & 1);
    /* the text for the operator, then what was measured for the log */
    if (!get_homing(j) && (high || low) && joint_fault(m, jt, EMCMOT_STOP_LIMIT, &faults)) {
        report_error("joint %d on limit switch error", j);
        rtapi_print("motion: joint %d: %s limit switch at position %.5f\n", j,
                    high ? "positive" : "negative", jt->pos_fb);
    }
    if (joint_flag(jt, EMCMOT_JOINT_FAULT_BIT) && joint_fault(m, jt, EMCMOT_STOP_AMPLIFIER, &faults)) {
        report_error("joint %d amplifier fault", j);
        rtapi_print("motion: joint %d: amplifier fault at position %.5f\n", j, jt->pos_fb);
    }
    if (joint_flag(jt, EMCMOT_JOINT_FERROR_BIT) && joint_fault(m, jt, EMCMOT_STOP_FOLLOWING, &faults)) {
        report_error("joint %d following error", j);
        rtapi_print("motion: joint %d: following error %.5f, limit %.5f at velocity %.5f\n", j, jt->ferror,
                    jt->ferror_limit, jt->vel_cmd);
    }
}

void phase_faults(struct motion *m)
{
    if (is_enabled(m)) {
        if (!hal_get_bool(m->pins->enable)) {
            report_error("motion stopped by enable input");
            stop_by(m, EMCMOT_STOP_OTHER);
        }
        for (int s = 0; s < m->config_work.numSpindles; s++)
            if (m->status->spindle_status[s].fault) {
                report_error("spindle %d amplifier fault", s);
                stop_by(m, EMCMOT_STOP_OTHER);
            }
        for (int i = 0; i < m->config_work.numMiscError; i++)
            if (m->status->misc_error[i]) {
                report_error("Motion Stopped by misc error %d", i);
                stop_by(m, EMCMOT_STOP_OTHER);
            }
    }
    for (int j = 0; j < all_joints(m); j++)
        joint_faults(m, j);
}

/* ---- kinematics switch, homing, planner type ---- */

void phase_switch_kinematics(struct motion *m)
{
    if (!m->pins->switchkins_type)
        return;
    double value = hal_get_real(m->pins->switchkins_type);
    int type = fabs(value) < 1e6 ? (int)value : -1;
    if (type == m->switchkins_type || type == m->kins_failed_type)
        return;
    if (kinematicsSwitch(type) != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinematicsSwitch() FAIL<%f>\n", value);
        set_motion_flag(m, EMCMOT_MOTION_ERROR_BIT, 1);
        m->kins_failed_type = type;
        return;
    }
    m->kins_failed_type = INT_MIN;
    m->switchkins_type = type;
    double q[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].pos_cmd;
    kinematics_forward(m, q, &m->status->carte_pos_cmd);
    EmcPose base = m->status->carte_pos_cmd;
    axis_apply_eoffsets(m, &base, -1);
    tpSetPos(&m->tp, &base);
    if (is_teleop(m))
        axes_sync_to(m, &base);
}

void phase_homing(struct motion *m)
{
    if (m->status->motion_state != EMCMOT_MOTION_FREE)
        return;
    if (do_homing())
        request_teleop(m);
}

void phase_planner_type(struct motion *m)
{
    if (m->pending_planner_type < 0 || !tpIsDone(&m->tp) || tpQueueDepth(&m->tp) != 0)
        return;
    m->status->planner_type = m->pending_planner_type;
    m->pending_planner_type = -1;
}
